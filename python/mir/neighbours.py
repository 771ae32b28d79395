# SPDX-License-Identifier: MIT
"""Scenes from meshes of other packages: trimesh, Open3D, PyVista. None of them is needed."""

import numpy as np

from mir._core import Scene
from mir._error import Error


def _package_of(thing) -> str:
    return type(thing).__module__.split(".")[0]


def _lit(scene: Scene) -> Scene:
    """With light from all around: meshes of others bring none."""
    scene.set_environment(np.ones((1, 2, 3), np.float32))
    return scene


def _linear(color) -> tuple:
    """Linear Rec. 709 of sRGB, three of 0..1."""
    c = np.clip(np.asarray(color, np.float64)[:3], 0.0, 1.0)
    return tuple(np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4))


def _trimesh_color(mesh) -> tuple:
    visual = mesh.visual
    if visual.kind == "texture":
        factor = getattr(visual.material, "main_color", (204, 204, 204))
    elif visual.defined:
        factor = visual.main_color
    else:
        return (0.8, 0.8, 0.8)
    return _linear(np.asarray(factor) / 255.0)


def from_trimesh(thing) -> Scene:
    """A scene from a trimesh.Trimesh or trimesh.Scene, in the light of a grey sky."""
    scene = Scene("trimesh")
    parts = thing.geometry if hasattr(thing, "geometry") else {"mesh": thing}
    placed = {}
    for name, mesh in parts.items():
        if not hasattr(mesh, "faces"):
            continue
        material = scene.add_material(name=name, base_color=_trimesh_color(mesh), specular=0.0)
        placed[name] = scene.add_mesh(
            np.asarray(mesh.vertices),
            np.asarray(mesh.faces),
            material=material,
            name=name,
            place=not hasattr(thing, "graph"),
        )
    if hasattr(thing, "graph"):
        for node in thing.graph.nodes_geometry:
            transform, name = thing.graph[node]
            if name in placed:
                scene.add_instance(placed[name], np.asarray(transform))
    return _lit(scene)


def from_open3d(mesh) -> Scene:
    """A scene from an open3d.geometry.TriangleMesh, in the light of a grey sky."""
    scene = Scene("open3d")
    colored = mesh.has_vertex_colors()
    scene.add_material(base_color=(1.0, 1.0, 1.0) if colored else (0.8, 0.8, 0.8), specular=0.0)
    scene.add_mesh(
        np.asarray(mesh.vertices),
        np.asarray(mesh.triangles),
        normals=np.asarray(mesh.vertex_normals) if mesh.has_vertex_normals() else None,
        colors=np.asarray(mesh.vertex_colors) if colored else None,
    )
    return _lit(scene)


def from_pyvista(mesh) -> Scene:
    """A scene from a pyvista.PolyData, in the light of a grey sky."""
    surface = mesh.extract_surface() if not hasattr(mesh, "regular_faces") else mesh
    surface = surface.triangulate()
    scene = Scene("pyvista")
    scene.add_material(specular=0.0)
    scene.add_mesh(np.asarray(surface.points), np.asarray(surface.faces).reshape(-1, 4)[:, 1:])
    return _lit(scene)


_READERS = {"trimesh": from_trimesh, "open3d": from_open3d, "pyvista": from_pyvista}


def scene_from(thing) -> Scene:
    """A scene from what one of these packages made, or one that OpenUSD did (mir.usd)."""
    package = _package_of(thing)
    if package == "pxr":
        from mir.usd import from_usd

        return from_usd(thing)
    if package not in _READERS:
        raise Error(
            f"scene: {type(thing).__name__} is no scene; give a mir.Scene, the name of a file, or a "
            "mesh of trimesh, Open3D or PyVista",
            "invalid_argument",
            "scene",
        )
    return _READERS[package](thing)
