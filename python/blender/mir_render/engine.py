# SPDX-License-Identifier: MIT
"""The render engine: F12, its progress and its end."""

import weakref

import bpy
import mir

from . import last_render
from .export_camera import CameraError
from .export_scene import export_scene
from .losses import Losses
from .options import settings_of
from .passes import chosen_passes, combined, extra_layers, write
from .viewport import Viewport


class Cancelled(Exception):
    """The user pressed Esc."""


def _redraw_of(engine: weakref.ref):
    """Asks a 3D view to draw again, from any thread. A view that is gone has no engine."""

    def redraw() -> None:
        alive = engine()
        if alive is not None:
            alive.tag_redraw()

    return redraw


class MirEngine(bpy.types.RenderEngine):
    """Metropolis Instant Radiosity."""

    bl_idname = "MIR"
    bl_label = "mir"
    bl_use_preview = False
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False

    _viewport = None  # of the engine that a 3D view has for itself

    def update_render_passes(self, scene=None, renderlayer=None):
        """Names the passes for the compositor."""
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        for one in chosen_passes(renderlayer):
            self.register_pass(
                scene, renderlayer, one.name, len(one.channels), one.channels, one.kind
            )

    def render(self, depsgraph):
        """Renders one view layer of one frame."""
        try:
            self._render(depsgraph)
        except Cancelled:
            pass
        except (mir.Error, CameraError) as error:
            self.error_set(str(error))

    def view_update(self, context, depsgraph):
        """Begins again where something changed."""
        if self._viewport is None:
            self._viewport = Viewport(_redraw_of(weakref.ref(self)))
        self._viewport.read(depsgraph)

    def view_draw(self, context, depsgraph):
        """Shows what there is so far."""
        self._viewport.look(context, depsgraph)
        self.update_stats("", self._viewport.message)
        self.bind_display_space_shader(depsgraph.scene)
        self._viewport.draw(context.region)
        self.unbind_display_space_shader()

    def stop_if_asked(self) -> None:
        """Ends the picture once Esc was pressed."""
        if self.test_break():
            raise Cancelled

    def _render(self, depsgraph) -> None:
        losses = Losses()
        self.update_stats("", "reading the scene")
        scale = depsgraph.scene_eval.render.resolution_percentage / 100.0
        width = max(1, int(depsgraph.scene_eval.render.resolution_x * scale))
        height = max(1, int(depsgraph.scene_eval.render.resolution_y * scale))
        scene, window = export_scene(depsgraph, width, height, losses, self.stop_if_asked)
        last_render.remember_losses(losses)
        settings = settings_of(depsgraph.scene_eval)
        passes = settings["passes"]
        settings |= extra_layers(depsgraph.view_layer_eval, settings["integrator"])
        settings |= {"width": window.whole[0], "height": window.whole[1]}

        def tell(progress):
            self.stop_if_asked()
            self.update_stats("", progress.stage)
            self.update_progress((progress.passes + (progress.share or 0.0)) / passes)

        for result in mir.progressive(scene, progress=tell, **settings):
            self._show(depsgraph, result, window)
            self.stop_if_asked()

    def _show(self, depsgraph, result, window) -> None:
        """Puts what there is so far into Blender's picture."""
        last_render.remember_result(result)
        layer_name = depsgraph.view_layer_eval.name
        picture = self.begin_result(0, 0, window.width, window.height, layer=layer_name)
        passes = picture.layers[0].passes
        transparent = depsgraph.scene_eval.render.film_transparent
        write(passes["Combined"], window.cut(combined(result, transparent)))
        for one in chosen_passes(depsgraph.view_layer_eval):
            write(passes[one.name], window.cut(one.read(result)))
        last_render.stamp(self.get_result())
        self.end_result(picture)
