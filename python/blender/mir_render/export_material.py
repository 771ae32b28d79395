# SPDX-License-Identifier: MIT
"""Materials of mir from those of Blender, each once."""

from dataclasses import dataclass

from .export_image import color_bytes, data_bytes
from .nodes import active_output
from .read_shader import ShaderReader
from .surface import Surface, ior_of


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
    for name in ("Volume", "Displacement"):
        if output.inputs[name].is_linked:
            losses.add(material.name, f"its {name.lower()}")
    return ShaderReader(material.name, losses).read(output.inputs["Surface"])


class Materials:
    """Materials and images that the scene has already, by their names in Blender."""

    def __init__(self, scene, losses):
        self._scene = scene
        self._losses = losses
        self._materials = {}
        self._images = {}

    def get(self, material) -> Material:
        """mir's material for one of Blender's, or for None."""
        name = material.name_full if material is not None else ""
        if name not in self._materials:
            self._materials[name] = self._add(name, read_surface(material, self._losses))
        return self._materials[name]

    def _add(self, name: str, surface: Surface) -> Material:
        shines = max(surface.emission) > 0.0
        if surface.opacity < 1.0:
            seen = surface.opacity >= 0.5 or (shines and surface.opacity > 0.0)
            if surface.opacity > 0.0:
                self._losses.add(name, f"its opacity is {'1' if seen else '0'}, not in between")
            if not seen and not shines:
                return Material(None)
        images = {f"{use}_image": self._image(use, one) for use, one in surface.images.items()}
        if surface.mask is not None:
            images |= self._mask(name, surface)
        images = {use: index for use, index in images.items() if index is not None}
        index = self._scene.add_material(
            name=name,
            base_color=_clamped(surface.base_color),
            metallic=min(1.0, max(0.0, surface.metallic)),
            roughness=min(1.0, max(0.0, surface.roughness)),
            specular=1.0 if surface.reflection > 0.0 else 0.0,
            ior=ior_of(surface.reflection),
            emission=surface.emission,
            emits_from_both_sides=True,
            **images,
            **(surface.lookup if images else {}),
        )
        return Material(index, len(images) > 0, surface.color_attribute)

    def _mask(self, name: str, surface: Surface) -> dict:
        """Holes where the image of the base colour has less than half its alpha."""
        if surface.images.get("base_color") != surface.mask:
            self._losses.add(name, "holes are those of the base colour's image alone")
            return {}
        return {"alpha_cutoff": 0.5}

    def _image(self, use: str, image) -> int | None:
        """Index of an image; None where it has no pixels."""
        key = (image.name_full, use == "normal")
        if key not in self._images:
            pixels = data_bytes(image) if use == "normal" else color_bytes(image)
            if pixels is None:
                self._losses.add(image.name, "the image has no pixels; its file may be missing")
            found = pixels is not None
            self._images[key] = self._scene.add_image(pixels, image.name) if found else None
        return self._images[key]
