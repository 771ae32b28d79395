# SPDX-License-Identifier: MIT
"""Meshes of other packages, with the packages themselves."""

import importlib

import numpy as np
import pytest

import mir

pytestmark = pytest.mark.extended


def package(name):
    """A package, or a skipped test: some want libraries of a desktop that is not there."""
    try:
        return importlib.import_module(name)
    except (ImportError, OSError) as error:
        pytest.skip(f"{name} cannot be imported ({error})")


def check_picture(thing, small):
    result = mir.render(thing, **small)
    assert result.coverage.max() > 0.99
    assert result.beauty.mean() > 0.0


def test_trimesh(small):
    trimesh = package("trimesh")
    check_picture(trimesh.creation.icosphere(), small)
    scene = trimesh.Scene()
    moved = np.eye(4)
    moved[0, 3] = 3
    scene.add_geometry(trimesh.creation.box(), geom_name="box")
    scene.add_geometry(trimesh.creation.box(), geom_name="other", transform=moved)
    check_picture(scene, small)


def test_open3d(small):
    open3d = package("open3d")
    torus = open3d.geometry.TriangleMesh.create_torus()
    torus.compute_vertex_normals()
    check_picture(torus, small)


def test_hosts_with_an_embree_of_their_own_are_not_disturbed(small):
    open3d = package("open3d")
    box = open3d.t.geometry.TriangleMesh.create_box()
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(box)
    ray = open3d.core.Tensor([[0.5, 0.5, 5, 0, 0, -1]], dtype=open3d.core.Dtype.Float32)
    before = scene.cast_rays(ray)["t_hit"].item()
    wanted = mir.render("builtin:sphere", accel="embree", **small).beauty
    assert scene.cast_rays(ray)["t_hit"].item() == before == pytest.approx(4.0)
    again = mir.render("builtin:sphere", accel="embree", **small).beauty
    np.testing.assert_array_equal(again, wanted)


def test_pyvista(small):
    pyvista = package("pyvista")
    check_picture(pyvista.Sphere(), small)


def test_arrays_of_torch(small):
    torch = package("torch")
    scene = mir.Scene()
    scene.add_material()
    scene.add_mesh(torch.eye(3), torch.tensor([[0, 1, 2]]))
    assert scene.triangles == 1
    beauty = mir.render("builtin:sphere", **small).beauty
    tensor = torch.from_dlpack(beauty)
    assert tensor.data_ptr() == beauty.__array_interface__["data"][0]


STAGE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Mesh "Floor" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-100, -100, 0), (100, -100, 0), (100, 100, 0), (-100, 100, 0)]
    rel material:binding = </Red>
}
def Material "Red"
{
    token outputs:surface.connect = </Red/Shader.outputs:surface>
    def Shader "Shader"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0.5, 0, 0)
        float inputs:roughness = 1
        token outputs:surface
    }
}
def DistantLight "Sun"
{
    float inputs:intensity = 1790
    float inputs:angle = 0
}
def Camera "View"
{
    double3 xformOp:translate = (0, 0, 500)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def test_usd(small, tmp_path):
    usd = package("pxr.Usd")
    path = tmp_path / "floor.usda"
    path.write_text(STAGE)
    stage = usd.Stage.Open(str(path))
    check_picture(stage, small)
    from mir.usd import from_usd

    scene = from_usd(path)
    low, high = scene.bounds
    assert low == pytest.approx((-1, 0, -1)) and high == pytest.approx((1, 0, 1))
    # Seen from straight above, the floor sends back 0.5 / pi of 10 W m^-2, and a little in its lobe.
    light = mir.render(scene, **small).beauty[12, 16]
    assert light[0] == pytest.approx(0.5 / np.pi * 10, rel=0.2) and light[1] < 0.2
