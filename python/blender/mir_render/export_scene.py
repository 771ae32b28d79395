# SPDX-License-Identifier: MIT
"""The evaluated depsgraph as a scene of mir."""

import mir

from .coordinates import to_world
from .export_camera import Window, add_camera
from .export_light import Lights
from .export_material import Materials
from .export_mesh import MESH_TYPES, TYPES_BESIDE_MESHES, Meshes
from .export_world import add_world

_OTHER_TYPES = {"LIGHT", "CAMERA", "EMPTY", "ARMATURE", "LATTICE", "SPEAKER"}
_RENDERED_TYPES = MESH_TYPES | TYPES_BESIDE_MESHES | _OTHER_TYPES
_RAYS = ("camera", "diffuse", "glossy", "shadow")


def export_scene(depsgraph, width: int, height: int, losses, check=lambda: None) -> tuple:
    """The scene, and the Window of its picture.

    check: is called between objects; what it raises ends the export.
    """
    scene = mir.Scene(depsgraph.scene_eval.name)
    window: Window = add_camera(scene, depsgraph, width, height, losses)
    if depsgraph.scene_eval.render.use_motion_blur:
        losses.add(scene.name, "motion blur")
    add_contents(scene, depsgraph, losses, check)
    return scene, window


def add_contents(scene, depsgraph, losses, check=lambda: None) -> None:
    """Adds world, lamps and objects: all but a camera."""
    add_world(scene, depsgraph.scene_eval.world, losses)
    meshes = Meshes(scene, Materials(scene, losses), losses)
    lights = Lights(scene, losses)
    for instance in depsgraph.object_instances:
        check()
        _add(instance, meshes, lights, losses)


def _add(instance, meshes: Meshes, lights: Lights, losses) -> None:
    source = instance.object
    if not instance.show_self:
        return
    if source.type not in _RENDERED_TYPES:
        losses.add(source.name, f"objects of type {source.type.lower()} are left out")
    elif source.type == "LIGHT":
        lights.add(source.data, to_world(instance.matrix_world))
    elif source.type in MESH_TYPES:
        _note_rays(source, losses)
        if len(source.particle_systems) > 0 and instance.show_particles:
            _note_hair(source, losses)
        meshes.add(source, to_world(instance.matrix_world))


def _note_rays(source, losses) -> None:
    hidden = [ray for ray in _RAYS if not getattr(source, f"visible_{ray}")]
    if hidden:
        losses.add(source.name, f"all rays see it, {', '.join(hidden)} too")
    if source.is_holdout or source.is_shadow_catcher:
        losses.add(source.name, "it is no holdout and no shadow catcher")


def _note_hair(source, losses) -> None:
    for system in source.particle_systems:
        if system.settings.type == "HAIR" and system.settings.render_type == "PATH":
            losses.add(source.name, f"the hair of '{system.name}'")
