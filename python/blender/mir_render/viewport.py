# SPDX-License-Identifier: MIT
"""The picture in a 3D view."""

import bpy
import gpu
import mir
import numpy as np
from gpu_extras.presets import draw_texture_2d

from .coordinates import to_world
from .export_camera import CameraError, view_through
from .export_scene import add_contents
from .losses import Losses
from .options import settings_of
from .preview import Job, Preview, Step

# The first picture has one pixel for so many by so many, and little else.
_FIRST_SIZE = 4
_FIRST_LIGHT = {"vpls": 256, "caustics": 0}
_PASSES = 16  # of the last one
_OF_QUALITY = ("vpls", "luxels", "direct_samples")  # what a draft chooses for itself


def _texture_of(picture: np.ndarray) -> gpu.types.GPUTexture:
    height, width = picture.shape[:2]
    pixels = np.ascontiguousarray(picture[::-1], np.float32).ravel()
    data = gpu.types.Buffer("FLOAT", pixels.size, pixels)
    return gpu.types.GPUTexture((width, height), format="RGBA32F", data=data)


def _steps(region, region_data, settings: dict) -> list[Step]:
    """A small picture with few VPLs, one of half the size, then the whole region pass by pass."""
    if not region_data.is_perspective:
        raise CameraError("3D view: it is orthographic; mir has perspective alone")
    matrix = to_world(region_data.view_matrix.inverted())
    settings = {name: value for name, value in settings.items() if name not in _OF_QUALITY}
    settings["quality"] = "draft"
    first = _FIRST_LIGHT if settings["integrator"] == "vpl" else {}
    steps = []
    for shrunk, own in (
        (_FIRST_SIZE, {"passes": 1, **first}),
        (_FIRST_SIZE // 2, {"passes": 1}),
        (1, {"passes": _PASSES}),
    ):
        size = tuple(max(1, side // shrunk) for side in (region.width, region.height))
        view = view_through("3D view", region_data.window_matrix, matrix, size)
        width, height = view.window.whole
        steps.append(Step(view, {**settings, **own, "width": width, "height": height}))
    return steps


def _instances(depsgraph) -> list[tuple]:
    """What tells scenes apart whose objects are the same: which are placed, and where."""
    return [
        (one.object.name_full, one.show_self, one.matrix_world.copy())
        for one in depsgraph.object_instances
    ]


def _has_edits(depsgraph) -> bool:
    """True unless it was updated for what is not rendered, such as a selection."""
    return any(
        one.is_updated_geometry
        or one.is_updated_transform
        or one.is_updated_shading
        or isinstance(one.id, bpy.types.Image)
        for one in depsgraph.updates
    )


class Viewport:
    """Reads Blender's data, has them rendered, and draws what there is so far."""

    def __init__(self, redraw):
        """redraw: is called in another thread when there is something new to draw."""
        self._preview = Preview(redraw)
        self._failure = ""
        self._scene = None
        self._instances = None  # of the scene
        self._seen = None  # what the picture is of, beside the scene
        self._drawn = None  # the picture in the texture
        self._texture = None

    def __del__(self):
        """Ends the picture with its view."""
        self._preview.stop()

    @property
    def message(self) -> str:
        """A line for the view's corner."""
        return self._failure or self._preview.message

    def read(self, depsgraph) -> None:
        """Copies the scene where it changed. The next look() begins a picture."""
        instances = _instances(depsgraph)
        if not _has_edits(depsgraph) and instances == self._instances:
            return
        self._instances, self._scene, self._seen, self._failure = instances, None, None, ""
        scene = mir.Scene(depsgraph.scene_eval.name)
        try:
            add_contents(scene, depsgraph, Losses())
        except mir.Error as error:
            self._failure = str(error)
        else:
            self._scene = scene

    def look(self, context, depsgraph) -> None:
        """Begins a picture where scene, view, size or options changed."""
        region, data, scene = context.region, context.region_data, depsgraph.scene_eval
        settings, transparent = settings_of(scene), scene.render.film_transparent
        place = (region.width, region.height, data.window_matrix.copy(), data.view_matrix.copy())
        seen = (place, settings, transparent)
        if self._scene is None or seen == self._seen:
            return
        self._seen, self._failure = seen, ""
        try:
            self._preview.begin(Job(self._scene, _steps(region, data, settings), transparent))
        except CameraError as error:
            self._failure = str(error)

    def draw(self, region) -> None:
        """Fills the region with the newest picture; leaves it empty where there can be none."""
        picture = self._preview.picture
        if picture is None or self._failure:
            return
        if picture is not self._drawn:
            self._drawn, self._texture = picture, _texture_of(picture)
        gpu.state.blend_set("ALPHA_PREMULT")
        draw_texture_2d(self._texture, (0, 0), region.width, region.height)
        gpu.state.blend_set("NONE")
