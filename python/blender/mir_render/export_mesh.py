# SPDX-License-Identifier: MIT
"""Meshes: evaluated objects to arrays, each mesh once, and its instances."""

from dataclasses import dataclass

import numpy as np

MESH_TYPES = {"MESH", "META"}
# The dependency graph hands out their surfaces beside them, as objects of type MESH.
TYPES_BESIDE_MESHES = {"CURVE", "SURFACE", "FONT"}


@dataclass
class Corners:
    """Arrays of a mesh by corners of its polygons."""

    positions: np.ndarray  # (corners, 3), metres, of the object
    triangles: np.ndarray  # (triangles, 3), indices of corners
    slots: np.ndarray  # (triangles,), material slots
    normals: np.ndarray | None  # (corners, 3); None: flat
    uv: np.ndarray | None  # (corners, 2), the top of an image is 0
    colors: np.ndarray | None  # (corners, 3), linear, 0..1


def _read(collection, name: str, width: int, dtype) -> np.ndarray:
    values = np.empty(len(collection) * width, dtype)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def _corner_normals(mesh) -> np.ndarray | None:
    if not _read(mesh.polygons, "use_smooth", 1, bool).any():
        return None
    if hasattr(mesh, "corner_normals"):
        normals = _read(mesh.corner_normals, "vector", 3, np.float32)
    else:
        mesh.calc_normals_split()
        normals = _read(mesh.loops, "normal", 3, np.float32)
    normals[~(np.linalg.norm(normals, axis=1) > 0)] = (0, 0, 1)
    return normals


def _corner_uv(mesh) -> np.ndarray | None:
    layers = mesh.uv_layers
    layer = next((one for one in layers if one.active_render), None)
    if layer is None:
        return None
    uv = _read(layer.data, "uv", 2, np.float32)
    uv[:, 1] = 1 - uv[:, 1]
    return uv


def _corner_colors(mesh, vertices: np.ndarray, attribute: str | None) -> np.ndarray | None:
    layer = mesh.color_attributes.get(attribute) if attribute else None
    if layer is None or len(layer.data) == 0:
        return None
    colors = _read(layer.data, "color", 4, np.float32)[:, :3]
    return np.clip(colors[vertices] if layer.domain == "POINT" else colors, 0, 1)


def is_closed(mesh) -> bool:
    """True when each edge lies between two polygons: the mesh has an inside."""
    uses = np.bincount(_read(mesh.loops, "edge_index", 1, np.int32), minlength=len(mesh.edges))
    return len(uses) > 0 and bool((uses == 2).all())


def corners_of(mesh, color_attribute: str | None = None) -> Corners | None:
    """Arrays of an evaluated mesh; None without triangles."""
    mesh.calc_loop_triangles()
    if len(mesh.loop_triangles) == 0:
        return None
    points = _read(mesh.vertices, "co", 3, np.float32)
    vertices = _read(mesh.loops, "vertex_index", 1, np.int32)
    return Corners(
        points[vertices],
        _read(mesh.loop_triangles, "loops", 3, np.int32),
        _read(mesh.loop_triangles, "material_index", 1, np.int32),
        _corner_normals(mesh),
        _corner_uv(mesh),
        _corner_colors(mesh, vertices, color_attribute),
    )


def _used(corners: Corners, chosen: np.ndarray) -> dict:
    """Arguments of add_mesh() for these triangles and the corners that they use."""
    triangles = corners.triangles[chosen]
    used = np.zeros(len(corners.positions), bool)
    used[triangles] = True
    places = np.cumsum(used, dtype=np.int32) - 1

    def rows(values):
        return None if values is None else values[used]

    return {
        "vertices": corners.positions[used],
        "indices": places[triangles],
        "normals": rows(corners.normals),
        "uv": rows(corners.uv),
        "colors": rows(corners.colors),
    }


class Meshes:
    """Meshes that the scene has already, by what they were made of."""

    def __init__(self, scene, materials, losses):
        self._scene = scene
        self._materials = materials
        self._losses = losses
        self._parts = {}

    def add(self, source, to_world: np.ndarray) -> None:
        """Places an evaluated object; its mesh is read the first time only."""
        if abs(np.linalg.det(to_world[:3, :3])) < 1e-18:
            return
        key = self._key(source)
        if key not in self._parts:
            self._parts[key] = self._read_parts(source)
        for part in self._parts[key]:
            self._scene.add_instance(part, to_world)

    @staticmethod
    def _key(source) -> tuple:
        # Instances that are no meshes take turns in one object of Blender's.
        shape = source.data if source.type == "MESH" else source.original
        names = tuple(s.material.name_full if s.material else "" for s in source.material_slots)
        return shape.as_pointer(), names

    def _read_parts(self, source) -> list[int]:
        """Indices of mir's meshes, one for each material slot in use."""
        mesh = source.to_mesh()
        if mesh is None:
            return []
        slots = [slot.material for slot in source.material_slots] or [None]
        closed = is_closed(mesh)
        chosen = [self._materials.get(material, closed) for material in slots]
        attribute = next((one.color_attribute for one in chosen if one.color_attribute), None)
        corners = corners_of(mesh, attribute)
        source.to_mesh_clear()
        if corners is None:
            return []
        corners.slots = np.clip(corners.slots, 0, len(chosen) - 1)
        return [
            self._add_part(source.name, corners, slot, chosen[slot])
            for slot in np.unique(corners.slots)
            if chosen[slot].index is not None
        ]

    def _add_part(self, name: str, corners: Corners, slot: int, material) -> int:
        arrays = _used(corners, corners.slots == slot)
        if not material.color_attribute:
            arrays["colors"] = None
        if not material.has_images:
            arrays["uv"] = None
        elif arrays["uv"] is None:
            self._losses.add(name, "it has no UV map, so its images are not shown")
        return self._scene.add_mesh(material=material.index, place=False, name=name, **arrays)
