# SPDX-License-Identifier: MIT
"""Passes: which there are, and what of a result goes into them."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

from .coordinates import vectors_of_blender

_BACKGROUND_DEPTH = 1e10  # Blender's


@dataclass(frozen=True)
class Pass:
    """One that a view layer may have beside Combined."""

    option: str  # name of its switch
    name: str  # as compositor and files have it
    channels: str
    kind: str  # of Blender's sockets
    about: str
    read: Callable  # the array of a mir.Result
    layer: str = ""  # that has to be asked for


def _removed(result) -> np.ndarray:
    """Black where no VPLs light the picture: nothing is removed there."""
    return np.zeros_like(result.indirect) if result.removed is None else result.removed


PASSES = (
    Pass("normal", "Normal", "XYZ", "VECTOR", "Shading normals of the first hit",
         lambda r: vectors_of_blender(r.normal)),
    Pass("albedo", "Albedo", "RGB", "COLOR", "Reflectance of the first hit", lambda r: r.albedo),
    Pass("depth", "Depth", "Z", "VALUE", "Distance from the camera's plane, metres",
         lambda r: np.where(r.depth > 0.0, r.depth, _BACKGROUND_DEPTH)[..., None]),
    Pass("direct", "Direct", "RGB", "COLOR", "Light after one reflection", lambda r: r.direct),
    Pass("indirect", "Indirect", "RGB", "COLOR", "Light after several reflections",
         lambda r: r.indirect),
    Pass("emission", "Emission", "RGB", "COLOR", "Light of what the camera sees, the world too",
         lambda r: r.emission),
    Pass("removed", "Removed", "RGB", "COLOR",
         "What the bound takes away, in no other pass. Every luxel then gathers all VPLs",
         _removed, "removed"),
)  # fmt: skip


def chosen_passes(view_layer) -> list[Pass]:
    """Those that are switched on."""
    return [one for one in PASSES if getattr(view_layer.mir_passes, one.option)]


def extra_layers(view_layer, integrator: str) -> dict:
    """Settings of mir.render() that ask for what these passes show, where there is such light."""
    layers = [one.layer for one in chosen_passes(view_layer) if one.layer]
    return {"aov": ",".join(layers)} if layers and integrator == "vpl" else {}


def combined(result, transparent: bool) -> np.ndarray:
    """(h, w, 4) of the picture; with a transparent film the world is left out."""
    alpha = np.ones_like(result.coverage)
    color = result.beauty
    if transparent:
        alpha = np.clip(result.coverage, 0.0, 1.0)
        color = color * alpha[..., None]
    return np.concatenate([color, alpha[..., None]], axis=2)


def write(render_pass, values: np.ndarray) -> None:
    """Fills a pass of Blender, whose rows begin at the bottom."""
    pixels = np.ascontiguousarray(values[::-1], np.float32).reshape(-1, values.shape[2])
    try:
        render_pass.rect.foreach_set(pixels.ravel())
    except TypeError:  # Blender 3.4 wants a row for each pixel
        render_pass.rect.foreach_set(pixels)
