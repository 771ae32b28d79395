# SPDX-License-Identifier: MIT
"""Materials of mir from those of Blender, each once."""

import math
from dataclasses import dataclass

import numpy as np

from .export_image import color_bytes, data_bytes
from .nodes import active_output
from .read_shader import ShaderReader
from .surface import Surface, ior_of, reflection_of


@dataclass
class Material:
    """A material that the scene has."""

    index: int | None  # None: nothing is seen of it
    has_images: bool = False
    color_attribute: str | None = None


def _clamped(color) -> tuple:
    return tuple(min(1.0, max(0.0, float(c))) for c in color)


def read_surface(material, losses) -> Surface:
    """What a material's nodes say; that of no material is grey and diffuse, as in Cycles."""
    if material is None:
        return Surface()
    if not material.use_nodes or material.node_tree is None:
        return Surface(base_color=tuple(material.diffuse_color)[:3])
    output = active_output(material.node_tree, "OUTPUT_MATERIAL")
    if output is None:
        return Surface(base_color=(0.0, 0.0, 0.0))
    if output.inputs["Displacement"].is_linked:
        losses.add(material.name, "its displacement")
    reader = ShaderReader(material.name, losses)
    surface = reader.read(output.inputs["Surface"])
    surface.absorption = reader.absorption(output.inputs["Volume"])
    return surface


class Materials:
    """Materials and images that the scene has already, by their names in Blender."""

    def __init__(self, scene, losses):
        self._scene = scene
        self._losses = losses
        self._materials = {}
        self._images = {}

    def get(self, material, is_closed: bool = True) -> Material:
        """mir's material for one of Blender's, or for None; glass is a body in closed meshes."""
        name = material.name_full if material is not None else ""
        key = (name, is_closed)
        if key not in self._materials:
            surface = read_surface(material, self._losses)
            self._materials[key] = self._add(name, surface, is_closed)
            if surface.transmission == 0.0:
                self._materials[name, not is_closed] = self._materials[key]
        return self._materials[key]

    def _add(self, name: str, surface: Surface, is_closed: bool) -> Material:
        if surface.opacity <= 0.0:
            return Material(None)
        images = {
            f"{use}_image": self._image(use, one, one == surface.mask)
            for use, one in surface.images.items()
        }
        images = {use: index for use, index in images.items() if index is not None}
        index = self._scene.add_material(
            name=name,
            base_color=_clamped(surface.base_color),
            metallic=min(1.0, max(0.0, surface.metallic)),
            roughness=min(1.0, max(0.0, surface.roughness)),
            emission=tuple(surface.emission),
            emits_from_both_sides=True,
            **self._coverage(name, surface),
            **self._interface(name, surface, is_closed),
            **images,
            **(surface.lookup if images else {}),
        )
        return Material(index, len(images) > 0, surface.color_attribute)

    def _coverage(self, name: str, surface: Surface) -> dict:
        """How much of the surface is there."""
        has_mask = surface.mask is not None
        if has_mask and surface.images.get("base_color") != surface.mask:
            self._losses.add(name, "holes are those of the base colour's image alone")
            has_mask = False
        if surface.opacity >= 1.0 and not has_mask:
            return {}
        return {"blend": True, "alpha": min(1.0, surface.opacity)}

    def _interface(self, name: str, surface: Surface, is_closed: bool) -> dict:
        """How it reflects at right angles, and how light goes on behind that."""
        is_body = surface.transmission > 0.0 and is_closed and not surface.is_sheet
        if surface.absorption is not None and not is_body:
            self._losses.add(name, "its volume: it is no closed mesh of glass")
        if surface.transmission == 0.0:
            specular = 1.0 if surface.reflection > 0.0 else 0.0
            values = {"specular": specular, "ior": ior_of(surface.reflection)}
            if surface.clearcoat > 0.0:
                values["clearcoat"] = min(1.0, surface.clearcoat)
                values["clearcoat_roughness"] = min(1.0, max(0.0, surface.clearcoat_roughness))
            return values
        if surface.clearcoat > 0.0:
            self._losses.add(name, "its coat: glass has none")
        ior = max(1.0, surface.ior)
        most = reflection_of(ior)
        values = {
            "specular": min(1.0, surface.reflection / most) if most > 0.0 else 0.0,
            "ior": ior,
            "transmission": min(1.0, surface.transmission),
            "thin": not is_body,
        }
        if is_body and surface.absorption is not None and max(surface.absorption) > 0.0:
            distance = 1.0 / max(surface.absorption)
            values["attenuation_color"] = tuple(math.exp(-a * distance) for a in surface.absorption)
            values["attenuation_distance"] = distance
        return values

    def _image(self, use: str, image, has_alpha: bool) -> int | None:
        """Index of an image; None where it has no pixels."""
        key = (image.name_full, use == "normal", has_alpha)
        if key not in self._images:
            pixels = data_bytes(image) if use == "normal" else color_bytes(image)
            if pixels is None:
                self._losses.add(image.name, "the image has no pixels; its file may be missing")
            found = pixels is not None
            if found and not has_alpha:
                pixels = np.ascontiguousarray(pixels[..., :3])
            self._images[key] = self._scene.add_image(pixels, image.name) if found else None
        return self._images[key]
