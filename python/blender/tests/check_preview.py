# SPDX-License-Identifier: MIT
"""The thread behind the 3D view's picture: what it shows, restarts, its end."""

import threading
import time

import bpy
import mir
import numpy as np
from scenes import cornell_box

from mir_render.coordinates import to_world
from mir_render.export_camera import view_through
from mir_render.export_scene import add_contents, export_scene
from mir_render.losses import Losses
from mir_render.passes import combined
from mir_render.preview import Job, Preview, Step

_SIZE = 48, 32
_RESTARTS = 20
_MOST_SECONDS = 0.05  # that the interface waits for a restart


def _view(size: tuple):
    """Through the scene's camera, as a 3D view has its matrices."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    camera = depsgraph.scene_eval.camera
    projection = camera.calc_matrix_camera(depsgraph, x=size[0], y=size[1])
    return view_through("view", projection, to_world(camera.matrix_world), size)


def _step(passes: int, size: tuple = _SIZE) -> Step:
    view = _view(size)
    width, height = view.window.whole
    return Step(view, {"vpls": 64, "passes": passes, "width": width, "height": height})


def _scene() -> mir.Scene:
    scene = mir.Scene("preview")
    add_contents(scene, bpy.context.evaluated_depsgraph_get(), Losses())
    return scene


def check_picture() -> list[str]:
    """Its last picture is that of F12, and each is told."""
    cornell_box()
    bpy.context.scene.camera.data.shift_x = 0.2
    depsgraph = bpy.context.evaluated_depsgraph_get()
    scene, window = export_scene(depsgraph, *_SIZE, Losses())
    width, height = window.whole
    wanted = mir.render(scene, vpls=64, passes=2, width=width, height=height)
    told = []
    preview = Preview(lambda: told.append(preview.message))
    preview.begin(Job(_scene(), [_step(1, (12, 8)), _step(2)]))
    preview.wait()
    failures = []
    if told != ["Pass 1 of 1", "Pass 1 of 2", "Pass 2 of 2"]:
        failures.append(f"the preview told {told}")
    if not np.array_equal(preview.picture, window.cut(combined(wanted, False))):
        failures.append("the preview is not the picture of F12")
    return failures


def check_restarts() -> list[str]:
    """Many in a row: none waits, and the last one wins."""
    cornell_box()
    scene, waits = _scene(), []
    threads = threading.active_count()
    preview = Preview(lambda: None)
    for k in range(_RESTARTS):
        began = time.monotonic()
        preview.begin(Job(scene, [_step(1000, (160, 120))] if k < _RESTARTS - 1 else [_step(1)]))
        waits.append(time.monotonic() - began)
        time.sleep(0.01 * (k % 5))
    preview.wait()
    print(f"{_RESTARTS} restarts: longest {max(waits):.3f} s")
    failures = []
    if preview.picture is None or preview.picture.shape[:2] != _SIZE[::-1]:
        failures.append("the last job was not rendered")
    if sorted(waits)[_RESTARTS // 2] > _MOST_SECONDS:
        failures.append(f"restarts of the preview waited for {max(waits):.3f} s")
    if threading.active_count() != threads:
        failures.append("the preview left a thread")
    return failures


def check_end() -> list[str]:
    """It ends when it is stopped, and when nobody looks any more; failures are told."""
    cornell_box()
    failures = []

    def gone():
        raise ReferenceError

    for name, redraw in (("stopped", lambda: None), ("gone", gone)):
        preview = Preview(redraw)
        preview.begin(Job(_scene(), [_step(60000, (160, 120))]))
        if name == "stopped":
            preview.stop()
        began = time.monotonic()
        preview.wait()
        print(f"preview {name}: ended after {time.monotonic() - began:.2f} s")
    preview = Preview(lambda: None)
    view = _view(_SIZE)
    preview.begin(Job(_scene(), [Step(view, {"passes": 1, "width": 1 << 30, "height": 1})]))
    preview.wait()
    if "width" not in preview.message:
        failures.append(f"a failure of the preview is told as '{preview.message}'")
    return failures


CHECKS = (check_picture, check_restarts, check_end)


def check(_folder) -> list[str]:
    """All of these."""
    return [failure for one in CHECKS for failure in one()]
