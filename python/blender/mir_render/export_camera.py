# SPDX-License-Identifier: MIT
"""Cameras. mir has no shift: a larger symmetric picture is made, and a window cut out of it."""

import math
from dataclasses import dataclass

import numpy as np

from .coordinates import axes_of, to_world

_NARROWEST, _WIDEST = 1.0, 170.0


class CameraError(Exception):
    """A camera that mir cannot look through."""


@dataclass(frozen=True)
class Window:
    """The part of the whole picture that Blender asks for; pixels, rows from the top."""

    whole: tuple  # width, height of what mir renders
    left: int
    top: int
    width: int
    height: int

    def cut(self, image: np.ndarray) -> np.ndarray:
        """The window of an image of the whole."""
        return image[self.top : self.top + self.height, self.left : self.left + self.width]


def _span(size: int, shift: float) -> tuple:
    """Pixels of a symmetric side that holds one shifted by this share of its half; the start.

    Rounds to whole pixels.
    """
    more = round(abs(shift) * size)
    return size + more, (more if shift > 0 else 0)


def window_of(width: int, height: int, projection) -> Window:
    """The window for a picture of this size through this projection matrix."""
    whole_width, left = _span(width, projection[0][2])
    whole_height, bottom = _span(height, projection[1][2])
    top = whole_height - height - bottom
    return Window((whole_width, whole_height), left, top, width, height)


def _cropped(window: Window, settings) -> Window:
    """The window of a render region that is cut out; without cutting, the whole frame is made."""
    if not (settings.use_border and settings.use_crop_to_border):
        return window
    left, right = (
        int(share * window.width) for share in (settings.border_min_x, settings.border_max_x)
    )
    bottom, top = (
        int(share * window.height) for share in (settings.border_min_y, settings.border_max_y)
    )
    return Window(
        window.whole,
        window.left + left,
        window.top + window.height - top,
        right - left,
        top - bottom,
    )


def _lens(camera, matrix: np.ndarray, losses) -> dict:
    """Thin lens of the camera's f-stop; none without depth of field."""
    dof = camera.dof
    if not dof.use_dof:
        return {}
    distance = dof.focus_distance
    if dof.focus_object is not None:
        away = to_world(dof.focus_object.matrix_world)[:3, 3] - matrix[:3, 3]
        distance = float(-axes_of(matrix)[:, 2] @ away)
    if dof.aperture_blades > 0 or dof.aperture_ratio != 1.0:
        losses.add(camera.name, "its aperture is round")
    return {
        "lens_radius": camera.lens * 1e-3 / (2.0 * dof.aperture_fstop),
        "focus_distance": max(distance, 1e-3),
    }


@dataclass(frozen=True)
class View:
    """What a camera of mir sees, and the window of its picture."""

    position: np.ndarray
    axes: np.ndarray  # unit x, y and z as columns; it looks along -z
    fov: float  # vertical, of the whole picture, degrees
    window: Window

    def add_to(self, scene, **more) -> int:
        """Adds its camera; returns the index."""
        target = self.position - self.axes[:, 2]
        return scene.add_camera(self.position, target, up=self.axes[:, 1], fov=self.fov, **more)


def view_through(name: str, projection, to_world_matrix: np.ndarray, size: tuple) -> View:
    """The view of a perspective matrix from this place, for a picture of width and height."""
    window = window_of(*size, projection)
    fov = math.degrees(2.0 * math.atan(window.whole[1] / size[1] / projection[1][1]))
    if not _NARROWEST <= fov <= _WIDEST:
        raise CameraError(
            f"{name}: the field of view with its shift is {fov:.3g} degrees; mir has 1 to 170"
        )
    return View(to_world_matrix[:3, 3], axes_of(to_world_matrix), fov, window)


def add_camera(scene, depsgraph, width: int, height: int, losses) -> Window:
    """Adds the scene's camera; returns the window of its picture."""
    settings = depsgraph.scene_eval.render
    source = depsgraph.scene_eval.camera
    if source is None or source.type != "CAMERA":
        raise CameraError("the scene has no camera; add one")
    camera = source.data
    if camera.type != "PERSP":
        raise CameraError(f"{source.name}: it is {camera.type.lower()}; mir has perspective alone")
    if settings.pixel_aspect_x != settings.pixel_aspect_y:
        losses.add(source.name, "pixels are square")
    projection = source.calc_matrix_camera(depsgraph, x=width, y=height)
    matrix = to_world(source.matrix_world)
    view = view_through(source.name, projection, matrix, (width, height))
    view.add_to(scene, name=source.name, **_lens(camera, matrix, losses))
    return _cropped(view.window, settings)
