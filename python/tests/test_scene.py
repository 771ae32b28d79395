# SPDX-License-Identifier: MIT
"""Scenes from arrays."""

import json

import numpy as np
import pytest

import mir


def test_a_scene_of_arrays_comes_back_from_its_file(room, small, tmp_path):
    room.save(tmp_path / "room.glb")
    again = mir.load(tmp_path / "room.glb")
    assert (again.triangles, again.meshes, again.materials) == (6, 3, 2)
    assert again.ignored == {}
    np.testing.assert_array_equal(
        mir.render(room, **small).beauty, mir.render(again, **small).beauty
    )


def test_facts_of_a_scene(room):
    low, high = room.bounds
    assert low == (-1, 0, -1) and high == (1, 2, 1)
    assert room.cameras == [""] and room.name == "room" and room.origin == (0, 0, 0)
    assert "6 triangles" in repr(room)


def test_instances(small):
    scene = mir.Scene()
    scene.add_material(specular=0.0)
    mesh = scene.add_mesh(np.eye(3), [[0, 1, 2]], place=False)
    assert scene.triangles == 0
    moved = np.eye(4)
    moved[0, 3] = 2
    scene.add_instance(mesh, np.eye(4))
    scene.add_instance(mesh, moved)
    assert scene.triangles == 2 and scene.bounds[1] == (3, 1, 1)


def test_textures_and_environment(small):
    scene = mir.Scene()
    red = np.zeros((2, 2, 3), np.uint8)
    red[..., 0] = 255
    image = scene.add_image(red)
    scene.add_material(base_color=(1, 1, 1), specular=0.0, base_color_image=image)
    square = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
    uv = [[0, 1], [1, 1], [1, 0], [0, 0]]
    scene.add_mesh(square, [[0, 1, 2], [0, 2, 3]], uv=uv)
    scene.set_environment(np.ones((2, 4, 3), np.float32))
    scene.add_camera((0, 0, 4), (0, 0, 0), fov=10)
    result = mir.render(scene, **small)
    albedo = result.albedo[12, 16]
    assert albedo[0] > 0.99 and albedo[1] == 0
    assert result.direct[12, 16, 0] > 0.5 and result.direct[12, 16, 1] == 0


def test_lights(room, small):
    dim = mir.render(room, **small).direct.mean()
    room.add_point_light((0, 1, 1), (1, 1, 1))
    room.add_spot_light((0, 1, 1), (0, -1, 0), (1, 1, 1), outer_angle=30)
    room.add_directional_light((0, -1, -1), (1, 1, 1))
    assert mir.render(room, **small).direct.mean() > dim


def test_glass_and_coverage_come_back_from_a_file(tmp_path):
    scene = mir.Scene()
    glass = {"transmission": 1.0, "thin": False, "attenuation_color": (0.5, 0.6, 0.7)}
    scene.add_material(name="glass", attenuation_distance=2.0, **glass)
    scene.add_material(name="veil", alpha=0.25, blend=True)
    scene.add_material(
        name="leaf", diffuse_transmission=0.5, diffuse_transmission_color=(0.25, 0.5, 0.125)
    )
    for material in (0, 1, 2):
        scene.add_mesh(np.eye(3), [[0, 1, 2]], material=material)
    scene.save(tmp_path / "glass.glb")
    file = (tmp_path / "glass.glb").read_bytes()
    header = json.loads(file[20 : 20 + int.from_bytes(file[12:16], "little")])
    by_name = {one["name"]: one for one in header["materials"]}
    volume = by_name["glass"]["extensions"]["KHR_materials_volume"]
    assert volume["attenuationDistance"] == 2.0
    np.testing.assert_allclose(volume["attenuationColor"], (0.5, 0.6, 0.7), rtol=1e-6)
    assert by_name["veil"]["alphaMode"] == "BLEND"
    leaf = by_name["leaf"]["extensions"]["KHR_materials_diffuse_transmission"]
    assert leaf["diffuseTransmissionFactor"] == 0.5
    assert leaf["diffuseTransmissionColorFactor"] == [0.25, 0.5, 0.125]
    assert by_name["veil"]["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.25


@pytest.mark.parametrize(
    "wrong",
    [
        {"alpha": 1.5},
        {"transmission": -0.1},
        {"clearcoat": 1.5},
        {"clearcoat_roughness": -0.5},
        {"diffuse_transmission": 2.0},
        {"diffuse_transmission_color": (0, 0, 1.5)},
        {"attenuation_color": (0, 2, 0)},
        {"attenuation_distance": 0.0},
    ],
)
def test_glass_is_checked(wrong):
    with pytest.raises(mir.Error, match=next(iter(wrong))):
        mir.Scene().add_material(**wrong)

