# SPDX-License-Identifier: MIT
"""Options of a scene and passes of a view layer."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from .passes import PASSES


class MirOptions(bpy.types.PropertyGroup):
    """The ten that matter; all others have the defaults of `mir render`."""

    integrator: EnumProperty(
        name="Integrator",
        items=[
            ("vpl", "Virtual point lights", "Many small lights carry the indirect light"),
            ("path", "Path tracer", "The reference: noisy, without bias, slow"),
            ("micro", "Micro-rendering", "Indirect light gathered from discs"),
        ],
        default="vpl",
    )
    vpls: IntProperty(
        name="VPLs", default=1024, min=1, max=4000000, description="Virtual point lights wanted"
    )
    sampler: EnumProperty(
        name="Sampler",
        items=[
            ("mir", "Metropolis", "VPLs where the picture needs them"),
            ("bir", "Bidirectional", "Candidates from lamps and camera, resampled"),
            ("ir", "Instant radiosity", "Paths from the lamps alone"),
        ],
        default="mir",
    )
    luxels: IntProperty(
        name="Rays per pixel", default=4, min=1, max=64, description="More make smoother edges"
    )
    passes: IntProperty(
        name="Passes", default=1, min=1, max=65536, description="Pictures that are averaged"
    )
    direct_samples: IntProperty(
        name="Lamp samples", default=32, min=1, max=65536, description="For each pixel"
    )
    bounces: IntProperty(
        name="Bounces", default=32, min=1, max=63, description="Most reflections of light"
    )
    bound: FloatProperty(
        name="Bound",
        default=0.0,
        min=0.0,
        description="Largest geometry term of a VPL, against bright spots, 1/m2; 0: automatic",
    )
    compensate: IntProperty(
        name="Compensation",
        default=0,
        min=0,
        max=65536,
        description="Paths per pixel that bring back what the bound removed; 4 are usual",
    )
    seed: IntProperty(name="Seed", default=0, min=0, description="Of all random numbers")


def settings_of(scene) -> dict:
    """Settings of mir.render() for a scene of Blender."""
    options = scene.mir
    settings = {
        "integrator": options.integrator,
        "luxels": options.luxels,
        "direct_samples": options.direct_samples,
        "bounces": options.bounces,
        "seed": options.seed,
        "passes": options.passes,
        "allow_no_light": True,
    }
    if options.integrator == "vpl":
        settings |= {"vpls": options.vpls, "sampler": options.sampler}
        if options.bound > 0.0:
            settings["bound"] = options.bound
        if options.compensate > 0:
            settings["compensate"] = options.compensate
    if scene.render.threads_mode == "FIXED":
        settings["threads"] = scene.render.threads
    return settings


class MirPasses(bpy.types.PropertyGroup):
    """Passes beside Combined."""

    __annotations__ = {
        one.option: BoolProperty(name=one.name, description=one.about) for one in PASSES
    }


def register() -> None:
    """Gives scenes their options and view layers their passes."""
    bpy.utils.register_class(MirOptions)
    bpy.utils.register_class(MirPasses)
    bpy.types.Scene.mir = PointerProperty(type=MirOptions)
    bpy.types.ViewLayer.mir_passes = PointerProperty(type=MirPasses)


def unregister() -> None:
    """Takes them away."""
    del bpy.types.ViewLayer.mir_passes
    del bpy.types.Scene.mir
    bpy.utils.unregister_class(MirPasses)
    bpy.utils.unregister_class(MirOptions)
