# SPDX-License-Identifier: MIT
"""Scenes made in Blender, by functions of Blender alone."""

import math

import bpy


def empty() -> None:
    """A file without objects and with a black world."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    bpy.context.scene.world = world


def shader(name: str, kind: str, **inputs):
    """A material of one shader node; inputs have "_" for " "."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node = tree.nodes.new(kind)
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material


def diffuse(name: str, color=(0.8, 0.8, 0.8)):
    """A Lambertian material."""
    return shader(name, "ShaderNodeBsdfDiffuse", Color=(*color, 1.0))


def mesh(name: str, corners, faces, material, to_world=None):
    """An object of this mesh."""
    data = bpy.data.meshes.new(name)
    data.from_pydata(corners, [], faces)
    data.materials.append(material)
    return place(name, data, to_world)


def place(name: str, data, to_world=None):
    """An object in the scene."""
    thing = bpy.data.objects.new(name, data)
    if to_world is not None:
        thing.matrix_world = to_world
    bpy.context.scene.collection.objects.link(thing)
    return thing


def square(name: str, size: float, material, location=(0, 0, 0), rotation=(0, 0, 0)):
    """A square that faces +z before it is turned."""
    s = size / 2
    made = mesh(name, [(-s, -s, 0), (s, -s, 0), (s, s, 0), (-s, s, 0)], [(0, 1, 2, 3)], material)
    made.location, made.rotation_euler = location, rotation
    return made


def camera(location, rotation, lens: float = 50.0):
    """The scene's camera; looks along -z before it is turned."""
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    made = place("Camera", data)
    made.location, made.rotation_euler = location, rotation
    bpy.context.scene.camera = made
    return made


def lamp(kind: str, energy: float, location, rotation=(0, 0, 0), **values):
    """A lamp; shines along -z before it is turned."""
    data = bpy.data.lights.new(kind, kind)
    data.energy = energy
    for name, value in values.items():
        setattr(data, name, value)
    made = place(kind, data)
    made.location, made.rotation_euler = location, rotation
    return made


def default() -> None:
    """What Blender starts with."""
    bpy.ops.wm.read_factory_settings()


def cornell_box() -> None:
    """A box of 2 m with two blocks under a square lamp."""
    empty()
    white, red, green = (
        diffuse("white", (0.73, 0.73, 0.73)),
        diffuse("red", (0.63, 0.06, 0.05)),
        diffuse("green", (0.15, 0.48, 0.09)),
    )
    quarter = math.pi / 2
    square("floor", 2, white)
    square("ceiling", 2, white, (0, 0, 2), (math.pi, 0, 0))
    square("back", 2, white, (0, 1, 1), (quarter, 0, 0))
    square("left", 2, red, (-1, 0, 1), (0, quarter, 0))
    square("right", 2, green, (1, 0, 1), (0, -quarter, 0))
    blocks = (("tall", -0.35, 0.3, 0.3, 1.2), ("low", 0.35, -0.3, -0.3, 0.6))
    for name, x, y, turn, height in blocks:
        bpy.ops.mesh.primitive_cube_add(size=1, location=(x, y, height / 2), rotation=(0, 0, turn))
        block = bpy.context.object
        block.name, block.scale = name, (0.6, 0.6, height)
        block.data.materials.append(white)
    lamp("AREA", 30, (0, 0, 1.98), size=0.5)
    camera((0, -3.9, 1), (quarter, 0, 0), 35)


def instances(subdivisions: int = 2) -> None:
    """A thousand instances of one ball on the corners of a grid."""
    empty()
    ground = mesh(
        "grid",
        [(x * 0.4 - 6, y * 0.4, 0) for y in range(32) for x in range(32)][:1000],
        [],
        diffuse("ground"),
    )
    ground.instance_type = "VERTS"
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions, radius=0.15)
    ball = bpy.context.object
    ball.parent = ground
    orange = shader("orange", "ShaderNodeBsdfPrincipled", Base_Color=(0.8, 0.4, 0.1, 1))
    ball.data.materials.append(orange)
    for polygon in ball.data.polygons:
        polygon.use_smooth = True
    square("floor", 40, diffuse("floor", (0.5, 0.5, 0.5)), (0, 0, -0.15))
    lamp("SUN", 3, (0, 0, 5), (0.6, 0.3, 0))
    bpy.context.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.3
    camera((0, -6, 4), (1.1, 0, 0), 35)


def lamps() -> None:
    """A white wall and floor under every type of lamp."""
    empty()
    white = diffuse("white", (0.7, 0.7, 0.7))
    square("floor", 14, white)
    square("wall", 14, white, (0, 2, 0), (math.pi / 2, 0, 0))
    lamp("POINT", 60, (-3, 0.5, 1.2), shadow_soft_size=0.1, color=(1, 0.6, 0.4))
    lamp("SPOT", 300, (-1, 0, 2.5), (0.3, 0, 0), spot_size=0.8, spot_blend=0.3, shadow_soft_size=0)
    lamp("AREA", 40, (1, 0.5, 2), (0.5, 0, 0), size=0.6, color=(0.4, 0.7, 1))
    lamp("AREA", 40, (3, 0.5, 2), (0.5, 0, 0), size=0.6, shape="DISK", color=(0.5, 1, 0.5))
    lamp("SUN", 0.2, (0, 0, 5), (0.5, 0.5, 0))
    for x in (-3, -1, 1, 3):
        bpy.ops.mesh.primitive_cube_add(size=0.4, location=(x, 0.9, 0.2))
        bpy.context.object.data.materials.append(white)
    camera((0, -7, 2), (1.45, 0, 0), 32)


def glass() -> None:
    """A glass ball, a metal one and a half-transparent one in a room."""
    cornell_box()
    for block in ("tall", "low"):
        bpy.data.objects.remove(bpy.data.objects[block])
    materials = (
        shader("glass", "ShaderNodeBsdfGlass", IOR=1.45),
        shader("metal", "ShaderNodeBsdfPrincipled", Metallic=1.0, Roughness=0.2),
        shader("plastic", "ShaderNodeBsdfPrincipled", Base_Color=(0.1, 0.2, 0.7, 1), Alpha=0.4),
    )
    for x, material in zip((-0.6, 0.0, 0.6), materials):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.3, location=(x, -0.2, 0.3))
        ball = bpy.context.object
        ball.data.materials.append(material)
        for polygon in ball.data.polygons:
            polygon.use_smooth = True


SCENES = {
    "default": default,
    "cornell_box": cornell_box,
    "instances": instances,
    "lamps": lamps,
    "glass": glass,
}
