# SPDX-License-Identifier: MIT
"""What there is to tell of the last picture, for panel and metadata."""

losses: list[str] = []
warnings: list[str] = []
budget: dict[str, str] = {}

_ALSO_IN_BUDGET = "caustic_luminance"  # of the statistics


def _text(value) -> str:
    if isinstance(value, (list, tuple)):
        return ", ".join(_text(one) for one in value)
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _lines(facts: dict, before: str = ""):
    """Names and texts; groups in groups are named one after the other."""
    for name, value in facts.items():
        if isinstance(value, dict):
            yield from _lines(value, f"{before}{name} ")
        else:
            yield before + name, _text(value)


def remember_losses(new_losses) -> None:
    """Begins the report of a picture."""
    losses[:] = list(new_losses)
    warnings.clear()
    budget.clear()


def remember_result(result) -> None:
    """Adds what a result tells of itself."""
    warnings[:] = result.warnings
    budget.update(_lines(result.light_budget))
    if _ALSO_IN_BUDGET in result.statistics:
        budget.update(_lines({_ALSO_IN_BUDGET: result.statistics[_ALSO_IN_BUDGET]}))


def stamp(render_result) -> None:
    """Writes the report into the metadata of Blender's picture."""
    render_result.stamp_data_add_field("mir:lost", "\n".join(losses) or "nothing")
    if warnings:
        render_result.stamp_data_add_field("mir:warnings", "\n".join(warnings))
    for name, value in budget.items():
        render_result.stamp_data_add_field(f"mir:{name}", value)
