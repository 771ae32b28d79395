# SPDX-License-Identifier: MIT
"""What the camera sees beside Cycles: shift, lens, textures, colours, the turn of the world."""

import math

import bpy
import numpy as np
from check_lamps import world_image
from pictures import render
from scenes import camera, empty, mesh, shader, square

_WIDTH, _HEIGHT = 48, 32


def _checked_image(size: int = 64):
    """Four colours, one in each quarter."""
    pixels = np.ones((size, size, 4), np.float32)
    half = size // 2
    pixels[:half, :half, :3] = (1, 0, 0)
    pixels[:half, half:, :3] = (0, 1, 0)
    pixels[half:, :half, :3] = (0, 0, 1)
    image = bpy.data.images.new("quarters", size, size)
    image.pixels.foreach_set(pixels.ravel())
    return image


def _shining_picture() -> None:
    """A square that shines with an image."""
    material = shader("picture", "ShaderNodeEmission")
    tree = material.node_tree
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = _checked_image()
    texture.interpolation = "Closest"
    tree.links.new(texture.outputs["Color"], tree.nodes["Emission"].inputs["Color"])
    made = square("picture", 2, material)
    layer = made.data.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])


def _texture() -> None:
    empty()
    _shining_picture()
    camera((0.2, 0.1, 3), (0.1, -0.1, 0.4), 30)


def _shift() -> None:
    _texture()
    data = bpy.context.scene.camera.data
    data.shift_x, data.shift_y = 0.25, -0.125


def _region() -> None:
    _texture()
    settings = bpy.context.scene.render
    settings.use_border = settings.use_crop_to_border = True
    settings.border_min_x, settings.border_max_x = 0.25, 0.75
    settings.border_min_y, settings.border_max_y = 0.5, 1.0


def _lens() -> None:
    _texture()
    data = bpy.context.scene.camera.data
    data.dof.use_dof = True
    data.dof.focus_distance, data.dof.aperture_fstop = 1.0, 0.1


def _portrait() -> None:
    _texture()
    bpy.context.scene.camera.data.sensor_fit = "VERTICAL"


def _mixed() -> None:
    """Two emissions, mixed, added and half see-through behind a hole."""
    empty()
    mesh("far", [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)], [(0, 1, 2, 3)],
         shader("blue", "ShaderNodeEmission", Color=(0, 0, 1, 1), Strength=0.5))  # fmt: skip
    material = shader("mixed", "ShaderNodeEmission", Color=(1, 0, 0, 1), Strength=2.0)
    tree = material.node_tree
    other = tree.nodes.new("ShaderNodeEmission")
    other.inputs["Color"].default_value = (0, 1, 0, 1)
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = 0.25
    tree.links.new(tree.nodes["Emission"].outputs[0], mix.inputs[1])
    tree.links.new(other.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    square("near", 1, material)
    square("unseen", 3, shader("clear", "ShaderNodeBsdfTransparent"), (0, 0, 1))
    camera((0, 0, 3), (0, 0, 0), 30)


def _words() -> None:
    """Two texts in a collection that is placed twice."""
    empty()
    words = bpy.data.collections.new("words")
    light = shader("light", "ShaderNodeEmission")
    for text, place in (("o", 0.0), ("XX", 0.7)):
        curve = bpy.data.curves.new(text, "FONT")
        curve.body = text
        curve.materials.append(light)
        thing = bpy.data.objects.new(text, curve)
        thing.location.x = place
        words.objects.link(thing)
    for height in (0.0, -1.0):
        holder = bpy.data.objects.new("holder", None)
        holder.instance_type, holder.instance_collection = "COLLECTION", words
        holder.location = (-0.9, height, 0)
        bpy.context.scene.collection.objects.link(holder)
    camera((0, 0, 4), (0, -0.2, 0), 40)


def _around(turn: float):
    def build() -> None:
        empty()
        world_image(turn)
        square("small", 0.01, shader("black", "ShaderNodeEmission", Strength=0.0), (0, 0, -9))
        camera((0, 0, 0), (1.4, 0.1, 0.7), 18)

    return build


VIEWS = {
    "texture": _texture,
    "shift": _shift,
    "region": _region,
    "depth of field": _lens,
    "vertical sensor": _portrait,
    "mixed shaders": _mixed,
    "texts": _words,
    "world": _around(0.0),
    "turned world": _around(math.radians(50)),
}


def _blocks(picture: np.ndarray) -> np.ndarray:
    """Means of blocks of 4 by 4 pixels: pixel filters and noise are not what is compared."""
    height, width = picture.shape[:2]
    return picture.reshape(height // 4, 4, width // 4, 4, 3).mean(axis=(1, 3))


def check(folder) -> list[str]:
    """Pictures whose mean difference is more than a few hundredths of their light."""
    failures = []
    for name, build in VIEWS.items():
        build()
        cycles = _blocks(render("CYCLES", folder / "cycles.exr", _WIDTH, _HEIGHT, 64))
        ours = _blocks(render("MIR", folder / "mir.exr", _WIDTH, _HEIGHT, luxels=64, vpls=16))
        difference = float(np.abs(ours - cycles).mean() / cycles.mean())
        print(f"{name:22} mean difference {difference:.4f} of the light")
        if not difference < 0.03:
            failures.append(f"{name}: differs by {difference:.3f}")
    return failures
