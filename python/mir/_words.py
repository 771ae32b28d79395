# SPDX-License-Identifier: MIT
"""Settings as words of the command line, which has their names, values and errors."""

from mir._error import Error


def _text(name: str, value) -> str:
    if hasattr(value, "dtype") and getattr(value, "ndim", 1) == 0:
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if name == "tile" and isinstance(value, (tuple, list)):
        return "x".join(_text(name, side) for side in value)
    if hasattr(value, "__iter__"):
        return ",".join(_text(name, part) for part in value)
    if hasattr(value, "__index__"):
        return str(value.__index__())
    if hasattr(value, "__float__"):
        return repr(float(value))
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    raise Error(
        f"{name}: {type(value).__name__} is no value of a setting; give a number, a word or True",
        "invalid_argument",
        name,
    )


def words_of(settings: dict) -> list[str]:
    """Words for settings by their names; those that are None are left out."""
    return [
        f"--{name.replace('_', '-')}={_text(name, value)}"
        for name, value in settings.items()
        if value is not None
    ]
