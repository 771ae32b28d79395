# SPDX-License-Identifier: MIT
"""Panels: options, passes, and what the last picture tells."""

import textwrap

import bpy

from . import last_render
from .passes import PASSES

# Blender's own panels of lamps, materials and worlds, which list engines by name.
_PANELS_OF_EEVEE = (
    "DATA_PT_EEVEE_light",
    "EEVEE_MATERIAL_PT_context_material",
    "EEVEE_MATERIAL_PT_surface",
    "EEVEE_WORLD_PT_surface",
)


class _RenderPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {"MIR"}

    @classmethod
    def poll(cls, context):
        """True where mir renders."""
        return context.engine in cls.COMPAT_ENGINES


class RENDER_PT_mir_options(_RenderPanel, bpy.types.Panel):
    """The ten options that matter."""

    bl_label = "mir"

    def draw(self, context):
        """Shows them; those of VPLs only where there are some."""
        options = context.scene.mir
        column = self.layout.column()
        column.use_property_split = True
        column.prop(options, "integrator")
        column.prop(options, "quality")
        light = column.column()
        light.active = options.integrator == "vpl"
        for name in ("vpls", "sampler", "bound"):
            light.prop(options, name)
        for name in ("luxels", "passes", "direct_samples", "bounces", "seed"):
            column.prop(options, name)


def _sentences(context, layout, sentences, icon: str) -> None:
    """Sentences in as many lines as the panel's width needs."""
    width = max(20, int(context.region.width / context.preferences.system.ui_scale / 8))
    column = layout.column(align=True)
    for sentence in sentences:
        for k, line in enumerate(textwrap.wrap(sentence, width)):
            column.label(text=line, icon="BLANK1" if k else icon)


class RENDER_PT_mir_losses(_RenderPanel, bpy.types.Panel):
    """What the last picture lacks."""

    bl_label = "Not as in Cycles"

    def draw(self, context):
        """Lists it."""
        lost = last_render.losses or ["nothing that was noticed"]
        _sentences(context, self.layout, lost, "DOT")
        _sentences(context, self.layout, last_render.warnings, "ERROR")


class RENDER_PT_mir_budget(_RenderPanel, bpy.types.Panel):
    """Where the light of the last picture came from."""

    bl_label = "Light Budget"

    def draw(self, context):
        """Shows its numbers."""
        for name, value in last_render.budget.items():
            row = self.layout.split(factor=0.5)
            row.label(text=name.replace("_", " "))
            row.label(text=value)


class VIEWLAYER_PT_mir_passes(_RenderPanel, bpy.types.Panel):
    """Passes beside Combined."""

    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        """Shows a switch for each."""
        for one in PASSES:
            self.layout.prop(context.view_layer.mir_passes, one.option)


_CLASSES = (
    RENDER_PT_mir_options,
    RENDER_PT_mir_losses,
    RENDER_PT_mir_budget,
    VIEWLAYER_PT_mir_passes,
)


def _panels_of_blender():
    """Those that serve every engine, and some of EEVEE's."""
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", set())
        if "BLENDER_RENDER" in engines or panel.__name__ in _PANELS_OF_EEVEE:
            yield panel


def register() -> None:
    """Shows the panels."""
    for one in _CLASSES:
        bpy.utils.register_class(one)
    for panel in _panels_of_blender():
        panel.COMPAT_ENGINES.add("MIR")


def unregister() -> None:
    """Takes them away."""
    for panel in _panels_of_blender():
        panel.COMPAT_ENGINES.discard("MIR")
    for one in reversed(_CLASSES):
        bpy.utils.unregister_class(one)
