# SPDX-License-Identifier: MIT
"""Scenes for Mitsuba 3: reads what `mir export` writes, writes XML with a PLY for each material.

Where both programs mean the same: diffuse surfaces of one colour, lamps of triangles, a camera.
"""
import json
import math
import struct

import numpy

COMPONENTS = {5121: numpy.uint8, 5123: numpy.uint16, 5125: numpy.uint32, 5126: numpy.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Unsupported(Exception):
    """The scene has something that Mitsuba would draw differently."""


def read_glb(path):
    """The JSON of a .glb and its binary chunk."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def values_of(document, binary, index):
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    kind, width = COMPONENTS[accessor["componentType"]], WIDTHS[accessor["type"]]
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    values = numpy.frombuffer(binary, kind, accessor["count"] * width, begin)
    return values.reshape(-1, width)


def check_material(material):
    surface = material["pbrMetallicRoughness"]
    specular = material.get("extensions", {}).get("KHR_materials_specular", {})
    if surface.get("metallicFactor", 1) != 0 or specular.get("specularFactor", 1) != 0:
        raise Unsupported(f"material '{material.get('name')}' is not diffuse")
    if "baseColorTexture" in surface:
        raise Unsupported(f"material '{material.get('name')}' has a texture")


def check(document):
    if document.get("extensions"):
        raise Unsupported("it has lights that are no triangles")
    if len(document.get("cameras", [])) != 1 or "perspective" not in document["cameras"][0]:
        raise Unsupported("it has not one perspective camera")
    for material in document["materials"]:
        check_material(material)


def matrix_of(node):
    return numpy.array(node["matrix"], float).reshape(4, 4).T


def triangles_by_material(document, binary):
    """Positions of the corners in world space, three rows a triangle."""
    found = {}
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        matrix = matrix_of(node)
        for part in document["meshes"][node["mesh"]]["primitives"]:
            places = values_of(document, binary, part["attributes"]["POSITION"])
            places = places @ matrix[:3, :3].T + matrix[:3, 3]
            order = values_of(document, binary, part["indices"]).reshape(-1, 3)
            if numpy.linalg.det(matrix[:3, :3]) < 0:
                order = order[:, ::-1]
            if "NORMAL" in part["attributes"]:
                raise Unsupported("it has normals of its own")
            found.setdefault(part["material"], []).append(places[order.reshape(-1)])
    return {material: numpy.concatenate(parts) for material, parts in found.items()}


def write_ply(path, corners):
    faces = numpy.empty(len(corners) // 3, [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = numpy.arange(len(corners)).reshape(-1, 3)
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(corners)}\n"
              "property float x\nproperty float y\nproperty float z\n"
              f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(header.encode() + corners.astype("<f4").tobytes() + faces.tobytes())


def numbers(values):
    return " ".join(f"{v:.9g}" for v in values)


def camera_xml(document):
    camera = document["cameras"][0]["perspective"]
    node = next(n for n in document["nodes"] if "camera" in n)
    # Mitsuba looks along +z with +x to the left.
    matrix = matrix_of(node) @ numpy.diag([-1.0, 1.0, -1.0, 1.0])
    return ('<sensor type="perspective"><string name="fov_axis" value="y"/>'
            f'<float name="fov" value="{math.degrees(camera["yfov"]):.9g}"/>'
            '<float name="near_clip" value="0.001"/><float name="far_clip" value="100000"/>'
            f'<transform name="to_world"><matrix value="{numbers(matrix.reshape(-1))}"/>'
            '</transform><film type="hdrfilm"><integer name="width" value="$width"/>'
            '<integer name="height" value="$height"/><rfilter type="box"/>'
            '<string name="pixel_format" value="rgb"/></film></sensor>')


def shape_xml(material, file):
    colour = material["pbrMetallicRoughness"].get("baseColorFactor", [1, 1, 1, 1])[:3]
    strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {})
    light = numpy.array(material.get("emissiveFactor", [0, 0, 0]))
    light = light * strength.get("emissiveStrength", 1)
    lamp = (f'<emitter type="area"><rgb name="radiance" value="{numbers(light)}"/></emitter>'
            if light.any() else "")
    return (f'<shape type="ply"><string name="filename" value="{file}"/>'
            '<boolean name="face_normals" value="true"/><bsdf type="twosided">'
            f'<bsdf type="diffuse"><rgb name="reflectance" value="{numbers(colour)}"/></bsdf>'
            f"</bsdf>{lamp}</shape>")


def convert(glb, folder):
    """Writes scene.xml and what it names. Raises Unsupported, with the reason."""
    document, binary = read_glb(glb)
    check(document)
    parts = triangles_by_material(document, binary)
    folder.mkdir(parents=True, exist_ok=True)
    lines = ['<scene version="3.0.0">', '<default name="width" value="240"/>',
             '<default name="height" value="240"/>', camera_xml(document)]
    for index, corners in sorted(parts.items()):
        file = f"material-{index}.ply"
        write_ply(folder / file, corners)
        lines.append(shape_xml(document["materials"][index], file))
    xml = folder / "scene.xml"
    xml.write_text("\n".join([*lines, "</scene>\n"]), encoding="utf-8")
    return xml
