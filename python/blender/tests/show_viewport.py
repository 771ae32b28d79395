# SPDX-License-Identifier: MIT
"""Checks the picture in a 3D view: run it under Blender's --python where it has a display.

The add-on is the unpacked zip in MIR_CHECK_ADDON; the picture of the window goes into the folder of
MIR_CHECK_FOLDER. Blender ends with 1 where the view does not show what it should, and otherwise
while the preview still renders.
"""

import os
import sys
import traceback
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), os.environ["MIR_CHECK_ADDON"]]

import bpy  # noqa: E402
import mir_render  # noqa: E402
import numpy as np  # noqa: E402
from scenes import camera, shader, square  # noqa: E402

from mir_render.preview import Preview  # noqa: E402

_FOLDER = Path(os.environ["MIR_CHECK_FOLDER"])
_STEP_SECONDS = 0.5
_MOST_STEPS = 240


def _scene():
    """A wall that shines red fills the camera's picture; returns its emission node."""
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    material = shader("wall", "ShaderNodeEmission", Color=(1, 0, 0, 1))
    square("wall", 20, material)
    camera((0, 0, 5), (0, 0, 0))
    bpy.context.scene.render.engine = "MIR"
    return material.node_tree.nodes["Emission"]


def _middle() -> np.ndarray:
    """Mean colour in the middle of the 3D view, as the screen shows it."""
    window = bpy.context.window_manager.windows[0]
    area = next(one for one in window.screen.areas if one.type == "VIEW_3D")
    path = _FOLDER / "viewport.png"
    with bpy.context.temp_override(window=window):
        bpy.ops.screen.screenshot(filepath=str(path))
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    x, y = area.x + area.width // 2, area.y + area.height // 3
    return pixels.reshape(height, width, 4)[y - 4 : y + 4, x - 4 : x + 4, :3].mean(axis=(0, 1))


def _is(color: np.ndarray, channel: int) -> bool:
    return color[channel] > 0.5 and np.delete(color, channel).max() < 0.25


def _story():
    """Steps between which Blender draws; what fails ends it."""
    _FOLDER.mkdir(parents=True, exist_ok=True)
    emission = _scene()
    for area in bpy.context.window_manager.windows[0].screen.areas:
        if area.type == "VIEW_3D":
            area.spaces.active.shading.type = "RENDERED"
            area.spaces.active.overlay.show_overlays = False
            area.spaces.active.region_3d.view_perspective = "CAMERA"
    for channel, name in ((0, "red"), (1, "green")):
        yield
        while not _is(_middle(), channel):
            yield
        print(f"the 3D view is {name}")
        begun = _begun
        bpy.data.objects["wall"].select_set(channel == 0)
        yield
        yield
        if begun != _begun:
            raise AssertionError("a selection began the picture again")
        emission.inputs["Color"].default_value = (0, 1, 0, 1)


def _count_pictures() -> None:
    """Counts in _begun how often a picture is begun."""
    begin = Preview.begin

    def counted(preview, job) -> None:
        global _begun
        _begun += 1
        begin(preview, job)

    Preview.begin = counted


def _run():
    """Goes on with the story; a timer of Blender's."""
    global _steps
    _steps += 1
    try:
        if _steps > _MOST_STEPS:
            raise TimeoutError(f"the middle of the 3D view is {_middle()}")
        next(_STORY)
    except StopIteration:
        print("3D view: 0 failures")
        bpy.ops.wm.quit_blender()
        return None
    except Exception:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)
    return _STEP_SECONDS


mir_render.register()
_count_pictures()
_steps = _begun = 0
_STORY = _story()
bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(_run, first_interval=_STEP_SECONDS)
