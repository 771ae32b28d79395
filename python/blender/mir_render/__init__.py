# SPDX-License-Identifier: MIT
"""Metropolis Instant Radiosity as a render engine of Blender."""

import platform
import sys
from pathlib import Path

bl_info = {
    "name": "mir",
    "description": "Metropolis Instant Radiosity: renders by virtual point lights",
    "author": "The mir authors",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > Render Engine",
    "category": "Render",
}

# Before Blender 4.2 add-ons have no wheels: package.sh lays the unpacked one beside this file.
_UNPACKED = Path(__file__).with_name("unpacked_wheel")
if _UNPACKED.is_dir() and str(_UNPACKED) not in sys.path:
    sys.path.append(str(_UNPACKED))


def _check_wheel():
    """Says what to do where the wheel does not fit this Blender."""
    try:
        import mir  # noqa: F401
    except ImportError as error:
        if error.name == "numpy":
            raise ImportError("mir_render: numpy is missing; install python3-numpy") from error
        raise ImportError(
            f"mir_render: its wheel is for Python 3.11 on Linux x86-64, and this Blender has Python "
            f"{platform.python_version()} on {platform.system()} {platform.machine()} ({error}); "
            "use Blender 3.4 or 4.2 to 5.0"
        ) from error


def register():
    """Makes the engine known."""
    _check_wheel()
    import bpy

    from . import engine, options, panel

    options.register()
    bpy.utils.register_class(engine.MirEngine)
    panel.register()


def unregister():
    """Takes it away."""
    import bpy

    from . import engine, options, panel

    panel.unregister()
    bpy.utils.unregister_class(engine.MirEngine)
    options.unregister()
