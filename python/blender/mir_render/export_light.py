# SPDX-License-Identifier: MIT
"""Lamps. Blender counts watts of the whole lamp, mir intensity, irradiance and radiance."""

import math

import numpy as np

from .coordinates import axes_of
from .light_units import AREA_INTENSITY, POINT_INTENSITY, spot_parts
from .nodes import active_output, color_of, constant_of, source_of
from .shapes import disc, icosphere, rectangle

_UNIFORM_SPREAD = math.pi - 1e-3


def _node_factor(light, losses) -> np.ndarray:
    """Colour times strength of the Emission node of a lamp with nodes."""
    if not light.use_nodes or light.node_tree is None:
        return np.ones(3)
    output = active_output(light.node_tree, "OUTPUT_LIGHT")
    source = source_of(output.inputs["Surface"]) if output is not None else None
    if source is None or source[0].type != "EMISSION":
        losses.add(light.name, "its nodes, but for one Emission")
        return np.ones(3)
    color, is_color = constant_of(source[0].inputs["Color"])
    strength, is_strength = constant_of(source[0].inputs["Strength"])
    if not (is_color and is_strength):
        losses.add(light.name, "what feeds its Emission node")
    return np.array(color_of(color)) * strength


def _watts(light, losses) -> np.ndarray:
    """Power by channel; of a sun, irradiance in W m^-2."""
    factor = _node_factor(light, losses) * np.array(light.color) * light.energy
    if hasattr(light, "exposure"):
        factor = factor * 2.0**light.exposure
    if getattr(light, "use_temperature", False):
        factor = factor * np.array(light.temperature_color)[:3]
    return np.maximum(factor, 0.0)


def _note_unlike(light, losses) -> None:
    """Losses of all kinds of lamps."""
    if not getattr(light, "normalize", True):
        losses.add(light.name, "'Normalize' is on")
    if not light.use_shadow:
        losses.add(light.name, "it casts shadows")


class Lights:
    """Puts lamps into the scene."""

    def __init__(self, scene, losses):
        self._scene = scene
        self._losses = losses

    def add(self, light, to_world: np.ndarray) -> None:
        """Adds a lamp where it stands; black ones are left out."""
        watts = _watts(light, self._losses)
        if watts.max() <= 0.0:
            return
        _note_unlike(light, self._losses)
        add = {
            "POINT": self._add_point,
            "SPOT": self._add_spot,
            "SUN": self._add_sun,
            "AREA": self._add_area,
        }
        add[light.type](light, to_world, watts)

    def _add_point(self, light, to_world, watts) -> None:
        intensity = watts * POINT_INTENSITY
        place, radius = to_world[:3, 3], light.shadow_soft_size
        if radius <= 0.0:
            self._scene.add_point_light(place, intensity, name=light.name)
            return
        corners, triangles = icosphere()
        corners = corners * radius + place
        # A convex body shows a fourth of its surface, on average over directions.
        self._add_shining(light, corners, triangles, intensity, share=0.25)

    def _add_spot(self, light, to_world, watts) -> None:
        for intensity, cos_inner in spot_parts(math.cos(light.spot_size / 2.0), light.spot_blend):
            self._scene.add_spot_light(
                to_world[:3, 3],
                -axes_of(to_world)[:, 2],
                watts * intensity,
                inner_angle=math.degrees(math.acos(cos_inner)),
                outer_angle=math.degrees(light.spot_size / 2.0),
                name=light.name,
            )
        if light.shadow_soft_size > 0.0:
            self._losses.add(light.name, "shadows are sharp: mir's spots have no radius")

    def _add_sun(self, light, to_world, watts) -> None:
        self._scene.add_directional_light(-axes_of(to_world)[:, 2], watts, name=light.name)
        if light.angle > 0.0:
            self._losses.add(light.name, "shadows are sharp: mir's suns have no angle")

    def _add_area(self, light, to_world, watts) -> None:
        sides = light.size, light.size
        if light.shape in {"RECTANGLE", "ELLIPSE"}:
            sides = light.size, light.size_y
        shape = disc if light.shape in {"DISK", "ELLIPSE"} else rectangle
        corners, triangles = shape(*sides)
        corners = corners @ to_world[:3, :3].T + to_world[:3, 3]
        self._add_shining(light, corners, triangles, watts * AREA_INTENSITY, share=1.0)
        if getattr(light, "spread", math.pi) < _UNIFORM_SPREAD:
            self._losses.add(light.name, "its spread is 180 degrees")

    def _add_shining(self, light, corners, triangles, intensity, share: float) -> None:
        """A black mesh of this intensity, W sr^-1: what is seen of its area, times radiance."""
        a, b, c = (corners[triangles[:, k]] for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0
        if area <= 0.0:
            self._losses.add(light.name, "it has no area and no light")
            return
        material = self._scene.add_material(
            name=light.name,
            base_color=(0, 0, 0),
            specular=0.0,
            emission=intensity / (share * area),
        )
        self._scene.add_mesh(corners, triangles, material=material, name=light.name)
        self._losses.add(light.name, "it is seen, and casts shadows, as the body that it is")
