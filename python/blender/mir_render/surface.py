# SPDX-License-Identifier: MIT
"""What shader nodes become before they become a material of mir."""

from dataclasses import dataclass, field, replace

BLACK = (0.0, 0.0, 0.0)


@dataclass
class Surface:
    """A closure in mir's terms: a diffuse base under an interface, and light of its own."""

    base_color: tuple = (0.8, 0.8, 0.8)
    metallic: float = 0.0
    roughness: float = 1.0
    reflection: float = 0.0  # of the interface at right angles, 0..1; 0: none
    emission: tuple = BLACK  # W m^-2 sr^-1, holes counted in
    opacity: float = 1.0  # covered share
    transmission: float = 0.0  # of what passes the interface, 0..1, tinted by base_color
    ior: float = 1.5  # of what transmits
    clearcoat: float = 0.0  # weight of an interface of index 1.5 on top, 0..1
    clearcoat_roughness: float = 0.0
    absorption: tuple | None = None  # m^-1, inside of a body
    is_sheet: bool = False  # light goes straight on, whatever the mesh
    color_attribute: str | None = None
    images: dict = field(default_factory=dict)  # Blender's, by "base_color", "normal", "emission"
    lookup: dict = field(default_factory=dict)  # how mir looks into them
    mask: object = None  # an image whose alpha is the covered share


def reflection_of(ior: float) -> float:
    """Reflectance of a dielectric at right angles."""
    return ((ior - 1.0) / (ior + 1.0)) ** 2


def ior_of(reflection: float) -> float:
    """Index of refraction of an interface with this reflectance at right angles."""
    root = min(reflection, 0.98) ** 0.5
    return (1.0 + root) / (1.0 - root)


def _blend(a, b, weight: float):
    """a with 1 - weight, b with weight."""
    if isinstance(a, tuple):
        return tuple(_blend(x, y, weight) for x, y in zip(a, b))
    return a * (1.0 - weight) + b * weight


def _glass_of(main: Surface, other: Surface) -> Surface:
    """The one that says how light goes on inside."""
    return main if main.transmission > 0.0 or other.transmission == 0.0 else other


def _mixed_roughness(a: Surface, b: Surface, weight: float) -> float:
    """That of the two, or of the one that has an interface."""
    has_interface = [max(one.reflection, one.metallic, one.transmission) > 0.0 for one in (a, b)]
    if has_interface[0] == has_interface[1]:
        return _blend(a.roughness, b.roughness, weight)
    return a.roughness if has_interface[0] else b.roughness


def mixed(a: Surface, b: Surface, share: float) -> Surface:
    """One surface for two, b with this share: what mir has is mixed number by number.

    See-through parts have no colour, so they count for opacity and emission alone.
    """
    opacity = _blend(a.opacity, b.opacity, share)
    weight = b.opacity * share / opacity if opacity > 0.0 else share
    main, other = (a, b) if weight < 0.5 else (b, a)
    return replace(
        main,
        base_color=_blend(a.base_color, b.base_color, weight),
        metallic=_blend(a.metallic, b.metallic, weight),
        roughness=_mixed_roughness(a, b, weight),
        reflection=_blend(a.reflection, b.reflection, weight),
        transmission=_blend(a.transmission, b.transmission, weight),
        clearcoat=_blend(a.clearcoat, b.clearcoat, weight),
        ior=_glass_of(main, other).ior,
        is_sheet=_glass_of(main, other).is_sheet,
        emission=_blend(a.emission, b.emission, share),
        opacity=opacity,
        images={**other.images, **main.images},
        mask=main.mask or other.mask,
    )


def added(a: Surface, b: Surface) -> Surface:
    """Both at once."""
    return replace(
        mixed(a, b, 0.5),
        base_color=tuple(
            min(1.0, x * a.opacity + y * b.opacity) for x, y in zip(a.base_color, b.base_color)
        ),
        emission=tuple(x + y for x, y in zip(a.emission, b.emission)),
        opacity=max(a.opacity, b.opacity),
    )


def without_reflection(emission: tuple) -> Surface:
    """A surface that only shines."""
    return Surface(base_color=BLACK, emission=emission)
