# SPDX-License-Identifier: MIT
"""Scenes from OpenUSD stages: UsdGeom, UsdLux, UsdPreviewSurface. Needs usd-core."""

import math
import warnings

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdLux, UsdShade

from mir._core import Scene

_WHITE_EFFICACY = 179.0  # lm/W, as of EXR files: USD counts lights in nits


class _Reader:
    """Fills a scene from a stage."""

    def __init__(self, stage):
        self.stage = stage
        self.scene = Scene(stage.GetRootLayer().GetDisplayName())
        self.scale = UsdGeom.GetStageMetersPerUnit(stage)
        self.turn = np.eye(4)
        if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
            self.turn = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]])
        self.xforms = UsdGeom.XformCache(Usd.TimeCode.Default())
        self.materials = {}
        self.left_out = set()

    def read(self) -> Scene:
        for prim in self.stage.Traverse(Usd.TraverseInstanceProxies()):
            if UsdGeom.Imageable(prim) and self._is_hidden(prim):
                continue
            for schema, add in self._kinds():
                if prim.IsA(schema):
                    add(schema(prim))
        if self.left_out:
            warnings.warn("not read: " + ", ".join(sorted(self.left_out)), stacklevel=3)
        return self.scene

    def _kinds(self):
        return (
            (UsdGeom.Mesh, self._add_mesh),
            (UsdGeom.Camera, self._add_camera),
            (UsdLux.SphereLight, self._add_sphere),
            (UsdLux.DistantLight, self._add_distant),
            (UsdLux.RectLight, self._add_rectangle),
            (UsdLux.DomeLight, self._add_dome),
        )

    @staticmethod
    def _is_hidden(prim) -> bool:
        return UsdGeom.Imageable(prim).ComputeVisibility() == UsdGeom.Tokens.invisible

    def _to_world(self, prim) -> np.ndarray:
        """Column vectors, metres, +y up."""
        matrix = np.array(self.xforms.GetLocalToWorldTransform(prim), np.float64).T
        metres = np.diag([self.scale, self.scale, self.scale, 1.0])
        return self.turn @ metres @ matrix

    def _direction(self, prim, vector) -> np.ndarray:
        return self._to_world(prim)[:3, :3] @ np.asarray(vector, np.float64)

    def _add_mesh(self, mesh):
        points = np.asarray(mesh.GetPointsAttr().Get() or [], np.float32).reshape(-1, 3)
        counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get() or [], np.int64)
        corners = np.asarray(mesh.GetFaceVertexIndicesAttr().Get() or [], np.int64)
        triangles = _fans(counts, corners)
        if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
            triangles = triangles[:, ::-1]
        if len(triangles) == 0:
            return
        self.scene.add_mesh(
            points,
            triangles,
            material=self._material_of(mesh),
            transform=self._to_world(mesh.GetPrim()),
            name=str(mesh.GetPath()),
        )

    def _material_of(self, mesh) -> int:
        material, _ = UsdShade.MaterialBindingAPI(mesh.GetPrim()).ComputeBoundMaterial()
        colors = mesh.GetDisplayColorAttr().Get()
        key = str(material.GetPath()) if material else f"color {colors[0] if colors else None}"
        if key not in self.materials:
            values = self._preview_surface(material) if material else {"specular": 0.0}
            if not material and colors:
                values["base_color"] = _shares(colors[0])
            self.materials[key] = self.scene.add_material(name=key, **values)
        return self.materials[key]

    def _preview_surface(self, material) -> dict:
        """Values of a UsdPreviewSurface; textures are left out."""
        shader, _, _ = material.ComputeSurfaceSource()
        if not shader or shader.GetIdAttr().Get() != "UsdPreviewSurface":
            self.left_out.add(f"the surface of {material.GetPath()}")
            return {}

        def value(name, usual):
            given = shader.GetInput(name)
            if given and given.HasConnectedSource():
                self.left_out.add(f"the texture of {material.GetPath()}, {name}")
                return usual
            found = given.Get() if given else None
            return usual if found is None else found

        return {
            "base_color": _shares(value("diffuseColor", (0.18, 0.18, 0.18))),
            "emission": tuple(value("emissiveColor", (0.0, 0.0, 0.0))),
            "metallic": min(max(value("metallic", 0.0), 0.0), 1.0),
            "roughness": min(max(value("roughness", 0.5), 0.0), 1.0),
            "ior": max(value("ior", 1.5), 1.0),
        }

    def _add_camera(self, camera):
        to_world = self._to_world(camera.GetPrim())
        eye = to_world[:3, 3]
        gf = camera.GetCamera(Usd.TimeCode.Default())
        self.scene.add_camera(
            eye,
            eye - to_world[:3, 2] / np.linalg.norm(to_world[:3, 2]),
            up=to_world[:3, 1],
            fov=gf.GetFieldOfView(Gf.Camera.FOVVertical),
            aspect_ratio=gf.aspectRatio,
            name=str(camera.GetPath()),
        )

    def _radiance(self, light) -> np.ndarray:
        """W m^-2 sr^-1 of a light that is not normalised by its area."""
        intensity = light.GetIntensityAttr().Get() * 2.0 ** light.GetExposureAttr().Get()
        return np.asarray(light.GetColorAttr().Get(), np.float64) * intensity / _WHITE_EFFICACY

    def _add_sphere(self, light):
        radius = light.GetRadiusAttr().Get() * self.scale
        area = math.pi * radius * radius
        shared = light.GetNormalizeAttr().Get()
        intensity = self._radiance(light) * (0.25 if shared else area)
        place = self._to_world(light.GetPrim())[:3, 3]
        self.scene.add_point_light(place, intensity, name=str(light.GetPath()))

    def _add_distant(self, light):
        radiance = self._radiance(light)
        half = math.radians(light.GetAngleAttr().Get()) / 2.0
        shared = light.GetNormalizeAttr().Get() or half == 0.0
        irradiance = radiance if shared else radiance * math.pi * math.sin(half) ** 2
        direction = self._direction(light.GetPrim(), (0, 0, -1))
        self.scene.add_directional_light(direction, irradiance, name=str(light.GetPath()))

    def _add_rectangle(self, light):
        w, h = light.GetWidthAttr().Get() / 2.0, light.GetHeightAttr().Get() / 2.0
        to_world = self._to_world(light.GetPrim())
        radiance = self._radiance(light)
        if light.GetNormalizeAttr().Get():
            sides = np.linalg.norm(to_world[:3, :2], axis=0) * (2.0 * w, 2.0 * h)
            radiance = radiance / (sides[0] * sides[1])
        material = self.scene.add_material(
            base_color=(0, 0, 0), specular=0.0, emission=radiance, name=str(light.GetPath())
        )
        corners = np.array([[-w, -h, 0], [-w, h, 0], [w, h, 0], [w, -h, 0]], np.float32)
        self.scene.add_mesh(
            corners, [[0, 1, 2], [0, 2, 3]], material=material, transform=to_world
        )

    def _add_dome(self, light):
        if light.GetTextureFileAttr().Get():
            self.left_out.add(f"the texture of {light.GetPath()}")
            return
        self.scene.set_environment(np.tile(self._radiance(light), (1, 2, 1)))


def _shares(color) -> tuple:
    return tuple(float(c) for c in np.clip(color, 0.0, 1.0))


def _fans(counts, corners) -> np.ndarray:
    """Triangles of convex polygons."""
    triangles = []
    first = 0
    for count in counts:
        triangles += [
            (corners[first], corners[first + k], corners[first + k + 1])
            for k in range(1, count - 1)
        ]
        first += count
    return np.asarray(triangles, np.int64).reshape(-1, 3)


def from_usd(stage) -> Scene:
    """A scene from a Usd.Stage, or the name of its file.

    Read are meshes, cameras, lights (sphere, distant, rectangle, dome without a texture) and the
    values of UsdPreviewSurface; textures are not. A SphereLight becomes a point.
    """
    if isinstance(stage, str) or hasattr(stage, "__fspath__"):
        stage = Usd.Stage.Open(str(stage))
    return _Reader(stage).read()
