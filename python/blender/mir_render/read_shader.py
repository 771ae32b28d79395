# SPDX-License-Identifier: MIT
"""Shader nodes to surfaces. What mir lacks goes into the list of losses."""

from dataclasses import replace

from .nodes import color_of, constant_of, input_of, source_of
from .surface import BLACK, Surface, added, mixed, reflection_of, without_reflection

# Inputs of the Principled BSDF that mir has nothing for, where they are not 0; with their names in
# Blender 3.4 and in later versions.
_LOST_WEIGHTS = (
    ("Subsurface Weight", "Subsurface"),
    ("Sheen Weight", "Sheen"),
    ("Anisotropic",),
    ("Thin Film Thickness",),
)


class ShaderReader:
    """Reads the nodes of one material."""

    def __init__(self, name: str, losses):
        self._name = name
        self._losses = losses
        self._readers = {
            "BSDF_PRINCIPLED": self._principled,
            "BSDF_DIFFUSE": self._diffuse,
            "BSDF_GLOSSY": self._glossy,
            "BSDF_METALLIC": self._glossy,
            "BSDF_GLASS": self._glass,
            "BSDF_REFRACTION": self._refraction,
            "BSDF_TRANSPARENT": self._transparent,
            "EMISSION": self._emission,
            "MIX_SHADER": self._mix,
            "ADD_SHADER": self._add,
        }

    def read(self, socket) -> Surface:
        """The surface that a shader input gets; black where nothing feeds it."""
        source = source_of(socket)
        if source is None:
            return Surface(base_color=BLACK)
        node, _ = source
        return self._readers.get(node.type, self._unknown)(node)

    def absorption(self, socket) -> tuple | None:
        """What a body takes of light, m^-1, by a Volume Absorption node; None: nothing is said."""
        source = source_of(socket)
        if source is None:
            return None
        node, _ = source
        if node.type != "VOLUME_ABSORPTION":
            self._lose(f"'{node.name}', its volume")
            return None
        density = max(0.0, self._number(node, "Density", usual=1.0))
        color = self._color(node, Surface(), "volume", "Color")
        return tuple(density * min(1.0, max(0.0, 1.0 - c)) for c in color)

    def _lose(self, what: str) -> None:
        self._losses.add(self._name, what)

    def _number(self, node, *names, usual: float = 0.0) -> float:
        socket = input_of(node, *names)
        if socket is None:
            return usual
        value, is_all = constant_of(socket)
        if not is_all:
            self._lose(f"what feeds '{socket.name}' of '{node.name}' is read as {value:.3g}")
        return float(value)

    def _color(self, node, surface: Surface, image: str, *names) -> tuple:
        """A colour; an image or a color attribute that feeds it goes into the surface."""
        socket = input_of(node, *names)
        if socket is None:
            return (1.0, 1.0, 1.0)
        value, is_all = constant_of(socket)
        if is_all:
            return color_of(value)
        source, _ = source_of(socket)
        if source.type == "TEX_IMAGE" and source.image is not None:
            self._note_mapping(source)
            surface.images[image] = source.image
            surface.lookup = self._lookup(source)
            return (1.0, 1.0, 1.0)
        if source.type == "VERTEX_COLOR" and source.layer_name and image == "base_color":
            surface.color_attribute = source.layer_name
            return (1.0, 1.0, 1.0)
        self._lose(f"what feeds '{socket.name}' of '{node.name}' is read as its plain colour")
        return color_of(value)

    def _lookup(self, node) -> dict:
        """How mir looks into the image of a node."""
        wraps = {"REPEAT": "repeat", "EXTEND": "clamp", "MIRROR": "mirror"}
        if node.extension not in wraps:
            self._lose(f"'{node.name}' goes on beyond its edges")
        return {
            "wrap": wraps.get(node.extension, "clamp"),
            "nearest": node.interpolation == "Closest",
        }

    def _note_mapping(self, node) -> None:
        source = source_of(node.inputs["Vector"])
        if source is not None and source[1].name != "UV":
            self._lose(f"'{node.name}' is placed by the UV map alone, without '{source[0].name}'")
        if node.projection != "FLAT":
            self._lose(f"'{node.name}' is placed by the UV map, not as a {node.projection.lower()}")

    def _normal(self, node, surface: Surface) -> None:
        source = source_of(node.inputs["Normal"]) if "Normal" in node.inputs else None
        if source is None:
            return
        image = None
        if source[0].type == "NORMAL_MAP" and source[0].space == "TANGENT":
            image = source_of(source[0].inputs["Color"])
        if image is not None and image[0].type == "TEX_IMAGE" and image[0].image is not None:
            surface.images["normal"] = image[0].image
        else:
            self._lose(f"'{source[0].name}' does not bend the normals of '{node.name}'")

    def _diffuse(self, node) -> Surface:
        surface = Surface()
        surface.base_color = self._color(node, surface, "base_color", "Color")
        if self._number(node, "Roughness") > 0.0:
            self._lose(f"the roughness of '{node.name}' is 0")
        self._normal(node, surface)
        return surface

    def _glossy(self, node) -> Surface:
        surface = Surface(metallic=1.0, reflection=0.04)
        surface.base_color = self._color(node, surface, "base_color", "Color", "Base Color")
        surface.roughness = self._number(node, "Roughness")
        self._normal(node, surface)
        return surface

    def _glass(self, node) -> Surface:
        surface = self._refraction(node)
        surface.reflection = reflection_of(surface.ior)
        return surface

    def _refraction(self, node) -> Surface:
        surface = Surface(transmission=1.0, ior=self._number(node, "IOR", usual=1.5))
        surface.base_color = self._color(node, surface, "base_color", "Color")
        surface.roughness = self._number(node, "Roughness")
        self._note_index(node, surface)
        self._normal(node, surface)
        return surface

    def _note_index(self, node, surface: Surface) -> None:
        if surface.ior < 1.0:
            self._lose(f"the index of refraction of '{node.name}' is 1")

    def _transparent(self, node) -> Surface:
        surface = Surface(base_color=BLACK, opacity=0.0)
        tint = self._color(node, surface, "base_color", "Color")
        if min(tint) == max(tint) and not surface.images:
            surface.opacity = min(1.0, max(0.0, 1.0 - tint[0]))
            return surface
        sheet = {"transmission": 1.0, "roughness": 0.0, "is_sheet": True}
        return replace(surface, base_color=tint, opacity=1.0, **sheet)

    def _emission(self, node) -> Surface:
        surface = without_reflection(BLACK)
        color = self._color(node, surface, "emission", "Color")
        strength = self._number(node, "Strength", usual=1.0)
        surface.emission = tuple(max(0.0, c * strength) for c in color)
        return surface

    def _principled(self, node) -> Surface:
        surface = Surface()
        surface.base_color = self._color(node, surface, "base_color", "Base Color")
        surface.metallic = self._number(node, "Metallic")
        surface.roughness = self._number(node, "Roughness")
        surface.reflection = self._reflection(node)
        strength = self._number(node, "Emission Strength")
        color = self._color(node, surface, "emission", "Emission Color", "Emission")
        self._alpha(node, surface)
        surface.emission = tuple(max(0.0, c * strength * surface.opacity) for c in color)
        self._transmission(node, surface)
        surface.clearcoat = self._number(node, "Coat Weight", "Clearcoat")
        surface.clearcoat_roughness = self._number(node, "Coat Roughness", "Clearcoat Roughness")
        self._normal(node, surface)
        for names in _LOST_WEIGHTS:
            if self._number(node, *names) != 0.0:
                self._lose(f"'{names[0]}' of '{node.name}'")
        return surface

    def _transmission(self, node, surface: Surface) -> None:
        share = self._number(node, "Transmission Weight", "Transmission")
        surface.transmission = min(1.0, max(0.0, share))
        if surface.transmission == 0.0:
            return
        surface.ior = self._number(node, "IOR", usual=1.5)
        self._note_index(node, surface)
        # Cycles tints each way through the surface by the square root.
        roots = tuple(max(0.0, c) ** 0.5 for c in surface.base_color)
        pairs = zip(surface.base_color, roots)
        surface.base_color = tuple(c + (root - c) * surface.transmission for c, root in pairs)

    def _reflection(self, node) -> float:
        """Before Blender 4.0 'Specular' alone sets it, since then it scales that of the IOR."""
        if "Specular" in node.inputs:
            return 0.08 * self._number(node, "Specular")
        level = self._number(node, "Specular IOR Level", usual=0.5)
        return 2.0 * level * reflection_of(self._number(node, "IOR", usual=1.5))

    def _alpha(self, node, surface: Surface) -> None:
        source = source_of(node.inputs["Alpha"])
        if source is not None and source[0].type == "TEX_IMAGE" and source[1].name == "Alpha":
            surface.mask = source[0].image
        else:
            surface.opacity = self._number(node, "Alpha")

    def _mix(self, node) -> Surface:
        first, second = self.read(node.inputs[1]), self.read(node.inputs[2])
        source = source_of(node.inputs[0])
        if source is not None and source[0].type == "TEX_IMAGE" and source[1].name == "Alpha":
            if first.opacity == 0.0:
                second.mask = source[0].image
                return second
        return mixed(first, second, min(1.0, max(0.0, self._number(node, node.inputs[0].name))))

    def _add(self, node) -> Surface:
        return added(self.read(node.inputs[0]), self.read(node.inputs[1]))

    def _unknown(self, node) -> Surface:
        self._lose(f"'{node.name}' is read as a diffuse surface")
        surface = Surface()
        if input_of(node, "Color", "Base Color") is not None:
            surface.base_color = self._color(node, surface, "base_color", "Color", "Base Color")
        return surface
