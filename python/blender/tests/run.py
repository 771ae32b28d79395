# SPDX-License-Identifier: MIT
"""Checks of the add-on inside Blender: run.py CHECK..., under Blender's --python or with bpy.

Writes pictures into the folder of the variable MIR_CHECK_FOLDER. The add-on is the unpacked zip in
MIR_CHECK_ADDON.
"""

import importlib
import os
import sys
import time
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), os.environ["MIR_CHECK_ADDON"]]

import bpy  # noqa: E402
import mir_render  # noqa: E402


def main(names: list[str]) -> int:
    """Number of failures."""
    folder = Path(os.environ["MIR_CHECK_FOLDER"])
    folder.mkdir(parents=True, exist_ok=True)
    failures = []
    for name in names:
        began = time.process_time()
        failures += importlib.import_module(f"check_{name}").check(folder)
        print(f"check_{name}: {time.process_time() - began:.1f} s of CPU")
    for failure in failures:
        print(f"FAILED: {failure}")
    print(f"Blender {bpy.app.version_string}: {len(failures)} failures")
    return len(failures)


mir_render.register()
CHOSEN = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
count = main(CHOSEN or ["materials", "engine", "views", "preview", "lamps"])
mir_render.unregister()
sys.exit(1 if count else 0)
