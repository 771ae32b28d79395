# SPDX-License-Identifier: MIT
"""What materials become: glass, coverage, absorption, node groups."""

import math

import bpy
from scenes import empty, shader

from mir_render.export_material import Materials
from mir_render.export_mesh import is_closed
from mir_render.losses import Losses


class _Recorder:
    """Stands in for a scene of mir and keeps what it is given."""

    def __init__(self):
        self.materials = []

    def add_material(self, **values) -> int:
        self.materials.append(values)
        return len(self.materials) - 1


def _read(material, closed: bool = True) -> tuple[dict, list[str]]:
    """Arguments of add_material(), and what was lost."""
    scene, losses = _Recorder(), Losses()
    Materials(scene, losses).get(material, closed)
    return (scene.materials or [{}])[0], list(losses)


def _differs(name: str, read: tuple[dict, list[str]], lost: int = 0, **wanted) -> list[str]:
    values, losses = read
    failures = [] if len(losses) == lost else [f"{name}: these are lost: {losses}"]
    for key, value in wanted.items():
        got = values.get(key)
        pairs = zip(got, value) if isinstance(value, tuple) and got else [(got, value)]
        if not all(a == b or (a and b and math.isclose(a, b, rel_tol=1e-5)) for a, b in pairs):
            failures.append(f"{name}: {key} is {got}, not {value}")
    return failures


def _under(material, kind: str, **inputs):
    """The material with a node of this kind at its volume."""
    tree = material.node_tree
    node = tree.nodes.new(kind)
    for key, value in inputs.items():
        node.inputs[key].default_value = value
    output = next(one for one in tree.nodes if one.type == "OUTPUT_MATERIAL")
    tree.links.new(node.outputs[0], output.inputs["Volume"])
    return material


def _mixed(name: str, share: float, *kinds: str):
    """A material of two shader nodes."""
    material = shader(name, kinds[0])
    tree = material.node_tree
    first = tree.nodes[0]
    mix, second = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new(kinds[1])
    mix.inputs[0].default_value = share
    tree.links.new(first.outputs[0], mix.inputs[1])
    tree.links.new(second.outputs[0], mix.inputs[2])
    output = next(one for one in tree.nodes if one.type == "OUTPUT_MATERIAL")
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    return material


def check_glass() -> list[str]:
    """Glass is a body in a closed mesh and a sheet in an open one."""
    glass = shader("glass", "ShaderNodeBsdfGlass", IOR=1.4, Roughness=0.0)
    smooth = {"specular": 1.0, "ior": 1.4, "transmission": 1.0}
    failures = _differs("closed", _read(glass), **smooth, thin=False)
    failures += _differs("open", _read(glass, False), **smooth, thin=True)
    bare = shader("bare", "ShaderNodeBsdfRefraction", IOR=1.4, Roughness=0.0)
    failures += _differs("refraction", _read(bare), **{**smooth, "specular": 0.0})
    rough = shader("rough", "ShaderNodeBsdfGlass", Roughness=0.5)
    failures += _differs("rough", _read(rough), roughness=0.5)
    principled = shader("p", "ShaderNodeBsdfPrincipled", Base_Color=(0.25, 0.36, 1, 1), IOR=1.5)
    inputs = principled.node_tree.nodes[0].inputs
    weight = "Transmission Weight" if "Transmission Weight" in inputs else "Transmission"
    inputs[weight].default_value, inputs["Roughness"].default_value = 1.0, 0.0
    wanted = {"transmission": 1.0, "base_color": (0.5, 0.6, 1.0), "ior": 1.5}
    return failures + _differs("principled", _read(principled), **wanted)


def check_coverage() -> list[str]:
    """Alpha, and Transparent in a Mix, are covered shares; its colour tints a sheet."""
    veil = shader("veil", "ShaderNodeBsdfPrincipled", Alpha=0.4)
    failures = _differs("alpha", _read(veil), blend=True, alpha=0.4)
    mixed = _mixed("mixed", 0.3, "ShaderNodeBsdfTransparent", "ShaderNodeBsdfDiffuse")
    failures += _differs("mix", _read(mixed), blend=True, alpha=0.3, base_color=(0.8, 0.8, 0.8))
    tint = shader("tint", "ShaderNodeBsdfTransparent", Color=(1.0, 0.5, 0.25, 1.0))
    wanted = {"transmission": 1.0, "thin": True, "specular": 0.0, "base_color": (1.0, 0.5, 0.25)}
    return failures + _differs("tint", _read(tint), **wanted)


def check_absorption() -> list[str]:
    """A Volume Absorption node is what a body takes; other volumes are lost."""
    smooth = {"Roughness": 0.0}
    ink = _under(
        shader("ink", "ShaderNodeBsdfGlass", **smooth),
        "ShaderNodeVolumeAbsorption",
        Color=(0.0, 0.5, 1.0, 1.0),
        Density=4.0,
    )
    left = (math.exp(-1.0), math.exp(-0.5), 1.0)
    wanted = {"attenuation_color": left, "attenuation_distance": 0.25}
    failures = _differs("absorption", _read(ink), **wanted)
    failures += _differs("absorption of a sheet", _read(ink, False), lost=1)
    fog = _under(shader("fog", "ShaderNodeBsdfGlass", **smooth), "ShaderNodeVolumeScatter")
    return failures + _differs("scattering", _read(fog), lost=1)


def _group(name: str, inner):
    """A node tree with a colour and a shader socket; `inner` makes its shader node."""
    tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
    if hasattr(tree, "interface"):
        tree.interface.new_socket("Tint", in_out="INPUT", socket_type="NodeSocketColor")
        tree.interface.new_socket("Out", in_out="OUTPUT", socket_type="NodeSocketShader")
    else:
        tree.inputs.new("NodeSocketColor", "Tint")
        tree.outputs.new("NodeSocketShader", "Out")
    begin, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    node = inner(tree)
    tree.links.new(begin.outputs[0], node.inputs[0])
    tree.links.new(node.outputs[0], end.inputs[0])
    return tree


def check_groups() -> list[str]:
    """Nested groups are entered; their inputs bring values and links from outside."""

    def nested(tree):
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = paint
        return node

    empty()
    paint = _group("paint", lambda tree: tree.nodes.new("ShaderNodeBsdfDiffuse"))
    outer = _group("outer", nested)
    material = shader("grouped", "ShaderNodeBsdfDiffuse")
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = outer
    node.inputs[0].default_value = (0.1, 0.2, 0.3, 1.0)
    output = next(one for one in tree.nodes if one.type == "OUTPUT_MATERIAL")
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    failures = _differs("group, a value", _read(material), base_color=(0.1, 0.2, 0.3))
    color = tree.nodes.new("ShaderNodeRGB")
    color.outputs[0].default_value = (0.4, 0.5, 0.6, 1.0)
    tree.links.new(color.outputs[0], node.inputs[0])
    return failures + _differs("group, a link", _read(material), base_color=(0.4, 0.5, 0.6))


def check_closed() -> list[str]:
    """A cube has an inside, a square has none."""
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object.data
    bpy.ops.mesh.primitive_plane_add()
    plane = bpy.context.object.data
    return [] if is_closed(cube) and not is_closed(plane) else ["open and closed are mixed up"]


CHECKS = (check_glass, check_coverage, check_absorption, check_groups, check_closed)


def check(_folder) -> list[str]:
    """All of these."""
    empty()
    return [failure for one in CHECKS for failure in one()]
