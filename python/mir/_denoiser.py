# SPDX-License-Identifier: MIT
"""Where a denoiser lies that came as a package for Python."""

import importlib.util
import os
import pathlib

PACKAGES = ("pyoidn", "oidn", "pyOpenImageDenoise")


def find_library() -> str:
    """The library of Open Image Denoise in an installed package.

    Empty without one, and where the environment names a library.
    """
    if os.environ.get("MIR_OIDN_LIBRARY"):
        return ""
    for package in PACKAGES:
        spec = importlib.util.find_spec(package)
        for folder in (spec and spec.submodule_search_locations) or []:
            found = sorted(pathlib.Path(folder).rglob("libOpenImageDenoise.so*"))
            if found:
                return str(found[0])
    return ""
