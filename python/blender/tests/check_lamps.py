# SPDX-License-Identifier: MIT
"""Brightness of each lamp and world beside Cycles, in a scene of Lambertian surfaces."""

import math

import bpy
import numpy as np
from pictures import render
from scenes import camera, diffuse, empty, lamp, square

_MOST_DIFFERENCE = 0.01
# Cycles of 3.4 draws spots by 0.7 % darker than that of 5.0 does: mir's paths, which agree with the
# latter within 0.3 %, are brighter by 0.7 to 0.9 % there.
_MOST_DIFFERENCE_OF_OLD_SPOTS = 0.012
_ABOVE = (0.3, 0.2, 2.0)


def _world_color() -> None:
    node = bpy.context.scene.world.node_tree.nodes["Background"]
    node.inputs["Color"].default_value = (0.9, 0.6, 0.3, 1)
    node.inputs["Strength"].default_value = 0.7


def world_image(turn: float = 0.0) -> None:
    """Sixteen by eight colours around the scene, turned about z."""
    colors = np.random.default_rng(1).uniform(0, 2, (8, 16, 4)).astype(np.float32)
    pixels = np.repeat(np.repeat(colors, 16, axis=0), 16, axis=1)
    image = bpy.data.images.new("around", 256, 128, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    tree = bpy.context.scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    texture.interpolation = "Closest"
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    tree.nodes["Background"].inputs["Strength"].default_value = 1.0
    if turn != 0.0:
        mapping = tree.nodes.new("ShaderNodeMapping")
        mapping.inputs["Rotation"].default_value = (0, 0, turn)
        place = tree.nodes.new("ShaderNodeTexCoord")
        tree.links.new(place.outputs["Generated"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])


def _spot(blend: float) -> None:
    lamp("SPOT", 50, _ABOVE, (0.2, 0.1, 0), spot_size=1.2, spot_blend=blend)


LIGHTS = {
    "point": lambda: lamp("POINT", 50, _ABOVE, shadow_soft_size=0.0),
    "point, radius 0.1 m": lambda: lamp("POINT", 50, _ABOVE, shadow_soft_size=0.1),
    "spot": lambda: _spot(0.0),
    "spot, blend 0.5": lambda: _spot(0.5),
    "sun": lambda: lamp("SUN", 3, _ABOVE, (0.4, 0.3, 0)),
    "area, square": lambda: lamp("AREA", 50, _ABOVE, (0.3, 0, 0), size=0.5),
    "area, rectangle": lambda: lamp(
        "AREA", 50, _ABOVE, (0.3, 0, 0.5), shape="RECTANGLE", size=0.8, size_y=0.2
    ),
    "area, disk": lambda: lamp("AREA", 50, _ABOVE, (0.3, 0, 0), shape="DISK", size=0.5),
    "area, ellipse": lambda: lamp(
        "AREA", 50, _ABOVE, (0.3, 0, 0.5), shape="ELLIPSE", size=0.8, size_y=0.2
    ),
    "world, colour": _world_color,
    "world, image": world_image,
}


def _corner() -> None:
    """A floor, two walls and a block; the camera sees no lamp."""
    empty()
    half = math.pi / 2
    square("floor", 4, diffuse("grey", (0.6, 0.6, 0.6)))
    square("back", 4, diffuse("warm", (0.7, 0.5, 0.3)), (0, 2, 0), (half, 0, 0))
    square("left", 4, diffuse("cold", (0.3, 0.5, 0.7)), (-2, 0, 0), (0, half, 0))
    square("block", 0.8, diffuse("white", (0.8, 0.8, 0.8)), (0.3, 0.8, 0.4))
    camera((0.4, -2.2, 1.6), (0.9, 0, 0.1), 30)


def check(folder, samples: int = 600) -> list[str]:
    """What differs by more than a hundredth."""
    failures = []
    print(f"{'lamp':22}{'Cycles':>10}{'mir path':>10}{'ratio':>9}{'mir VPLs':>10}{'ratio':>9}")
    for name, add in LIGHTS.items():
        _corner()
        add()
        cycles, path, vpls = (
            float(np.mean(picture))
            for picture in (
                render("CYCLES", folder / "cycles.exr", 24, 16, samples),
                render("MIR", folder / "path.exr", 24, 16, integrator="path", luxels=16),
                render(
                    "MIR", folder / "vpls.exr", 24, 16, integrator="vpl", luxels=64,
                    direct_samples=256,
                ),
            )
        )  # fmt: skip
        print(
            f"{name:22}{cycles:10.5f}{path:10.5f}{path / cycles:9.4f}"
            f"{vpls:10.5f}{vpls / cycles:9.4f}"
        )
        is_old_spot = name.startswith("spot") and bpy.app.version < (4, 0, 0)
        most = _MOST_DIFFERENCE_OF_OLD_SPOTS if is_old_spot else _MOST_DIFFERENCE
        for integrator, mean in (("path", path), ("vpl", vpls)):
            if not abs(mean / cycles - 1.0) < most:
                failures.append(f"{name}, {integrator}: {mean:.5f}, Cycles {cycles:.5f}")
    return failures
