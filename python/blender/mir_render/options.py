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
    quality: EnumProperty(
        name="Quality",
        items=[
            ("draft", "Draft", "A look"),
            ("good", "Good", "What one shows"),
            ("final", "Final", "About eight times the time of good"),
        ],
        default="good",
    )
    vpls: IntProperty(
        name="VPLs",
        default=0,
        min=0,
        max=4000000,
        description="Virtual point lights wanted; 0: by the quality",
    )
    sampler: EnumProperty(
        name="Sampler",
        items=[
            ("auto", "Automatic", "By the number of VPLs"),
            ("mir", "Metropolis", "VPLs where the picture needs them"),
            ("bir", "Bidirectional", "Candidates from lamps and camera, resampled"),
            ("ir", "Instant radiosity", "Paths from the lamps alone"),
        ],
        default="auto",
    )
    luxels: IntProperty(
        name="Rays per pixel",
        default=0,
        min=0,
        max=64,
        description="More make smoother edges; 0: by the quality",
    )
    passes: IntProperty(
        name="Passes", default=1, min=1, max=65536, description="Pictures that are averaged"
    )
    direct_samples: IntProperty(
        name="Lamp samples",
        default=0,
        min=0,
        max=65536,
        description="For each pixel; 0: by the quality",
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
    seed: IntProperty(name="Seed", default=0, min=0, description="Of all random numbers")


def settings_of(scene) -> dict:
    """Settings of mir.render() for a scene of Blender."""
    options = scene.mir
    settings = {
        "integrator": options.integrator,
        "quality": options.quality,
        "bounces": options.bounces,
        "seed": options.seed,
        "passes": options.passes,
        "allow_no_light": True,
    }
    chosen = ["luxels", "direct_samples"]
    if options.integrator == "vpl":
        chosen += ["vpls", "bound"]
        if options.sampler != "auto":
            settings["sampler"] = options.sampler
    settings |= {name: getattr(options, name) for name in chosen if getattr(options, name) > 0}
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
