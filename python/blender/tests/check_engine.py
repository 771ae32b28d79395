# SPDX-License-Identifier: MIT
"""Passes, metadata, light budget, frames, edits, cancellations, memory."""

import os
import random
import statistics
import time

import bpy
import numpy as np
from pictures import read, render
from scenes import cornell_box, glass, instances, lamps

from mir_render import engine, last_render
from mir_render.passes import PASSES

_CANCELLATIONS = 50
_MOST_SECONDS = 0.2
_MOST_GROWTH = 30.0  # MiB over all cancellations and edits: what allocators keep


def resident() -> float:
    """Memory of this process, MiB."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def check_passes(folder) -> list[str]:
    """Each pass is in the file, the metadata too."""
    cornell_box()
    scene = bpy.context.scene
    for one in PASSES:
        setattr(scene.view_layers[0].mir_passes, one.option, True)
    scene.render.engine = "MIR"
    scene.render.resolution_x, scene.render.resolution_y = 32, 24
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.filepath = str(folder / "passes.exr")
    bpy.ops.render.render(write_still=True)
    header = (folder / "passes.exr").read_bytes()[:8192]
    layer = scene.view_layers[0].name
    wanted = [f"{layer}.{one.name}.{one.channels[0]}" for one in PASSES]
    wanted += [f"{layer}.Combined.R", "mir:lost", "mir:emitted_power"]
    return [f"passes.exr has no {one}" for one in wanted if one.encode() not in header]


def check_passes_add_up(folder) -> list[str]:
    """Combined is the sum of emission, direct and indirect light; where a reader is at hand."""
    try:
        import OpenImageIO as oiio
    except ImportError:
        return []
    buffer = oiio.ImageBuf(str(folder / "passes.exr"))
    names = list(buffer.spec().channelnames)
    pixels = buffer.get_pixels(oiio.FLOAT)

    def red(name):
        return pixels[..., next(i for i, n in enumerate(names) if n.endswith(f"{name}.R"))]

    parts = red("Emission") + red("Direct") + red("Indirect")
    if np.allclose(red("Combined"), parts, rtol=2e-3, atol=1e-4):
        return []
    return ["passes.exr: its parts do not add up"]


def check_removed(folder) -> list[str]:
    """Its pass has what the bound takes away, and is black where there is no bound."""
    cornell_box()
    scene = bpy.context.scene
    scene.view_layers[0].mir_passes.removed = True
    shown = {}

    def note(result, _transparent):
        shown["removed"] = removed_pass.read(result)
        return usual(result, _transparent)

    removed_pass = next(one for one in PASSES if one.option == "removed")
    usual, engine.combined = engine.combined, note
    failures = []
    try:
        for integrator, bound in (("vpl", 0.1), ("path", 0.0), ("micro", 0.0)):
            render("MIR", folder / "removed.exr", 32, 24, integrator=integrator, bound=bound)
            if (shown["removed"].mean() > 0.0) != (bound > 0.0):
                failures.append(f"{integrator}: removed is {shown['removed'].mean():.5f}")
    finally:
        engine.combined = usual
    return failures


def check_light_budget(folder) -> list[str]:
    """The panel lists where the light came from, with what glass throws on a wall."""
    glass()
    render("MIR", folder / "budget.exr", 32, 24, vpls=64)
    budget = last_render.budget
    wanted = ("emitted_power", "mean_radiance direct", "indirect_luminance", "removed_share")
    failures = [f"the light budget has no {one}" for one in wanted if one not in budget]
    if not float(budget.get("caustic_luminance", 0.0)) > 0.0:
        failures.append("the light budget has no caustics")
    return failures


def check_frames(folder) -> list[str]:
    """Frames of an animation are what is there at their time, and equal when rendered alone."""
    cornell_box()
    tall = bpy.data.objects["tall"]
    for frame, x in ((1, -0.35), (3, 0.5)):
        tall.location.x = x
        tall.keyframe_insert("location", frame=frame)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 3
    scene.frame_set(2)
    alone = render("MIR", folder / "alone.exr", 32, 24, vpls=64)
    scene.render.filepath = str(folder / "frame")
    bpy.ops.render.render(animation=True)
    first, second, third = (read(folder / f"frame000{k}.exr") for k in (1, 2, 3))
    failures = []
    if not np.array_equal(second, alone):
        failures.append("frame 2 of the animation is not frame 2 alone")
    if np.array_equal(first, third):
        failures.append("frames 1 and 3 are equal, though a block moved")
    return failures


def cancel_once(after: float) -> float:
    """Seconds from the wish to end until the end."""
    began = time.monotonic()
    usual = engine.MirEngine.stop_if_asked

    def stop_later(_self):
        if time.monotonic() > began + after:
            raise engine.Cancelled

    engine.MirEngine.stop_if_asked = stop_later
    try:
        bpy.ops.render.render()
    finally:
        engine.MirEngine.stop_if_asked = usual
    return time.monotonic() - began - after


def check_cancellations(_folder) -> list[str]:
    """Many, at any moment, end soon and keep no memory."""
    glass()
    scene = bpy.context.scene
    scene.render.engine = "MIR"
    scene.render.resolution_x, scene.render.resolution_y = 640, 480
    scene.mir.vpls, scene.mir.passes = 4096, 1000
    moments = random.Random(1)
    cancel_once(0.3)
    before = resident()
    waits = [cancel_once(moments.uniform(0.0, 0.25)) for _ in range(_CANCELLATIONS)]
    grown = resident() - before
    median, longest = statistics.median(waits), max(waits)
    print(
        f"{len(waits)} cancellations: median {median:.3f} s, longest {longest:.3f} s, "
        f"{grown:+.1f} MiB"
    )
    failures = []
    if median > _MOST_SECONDS:
        failures.append(f"half of the cancellations took more than {median:.3f} s")
    if grown > _MOST_GROWTH:
        failures.append(f"cancellations kept {grown:.1f} MiB")
    return failures


def check_edits(folder) -> list[str]:
    """Scenes edited between pictures, and other scenes in a row: right, and without a leak."""
    failures = []
    cornell_box()
    dark = render("MIR", folder / "edit.exr", 32, 24, vpls=64)
    block = bpy.data.objects["tall"]
    before = None
    for k in range(20):
        block.location.x = -0.4 + 0.04 * k
        block.modifiers.clear()
        block.modifiers.new("bevel", "BEVEL").segments = 1 + k % 4
        bpy.data.lights[0].energy = 30 + 3 * k
        bright = render("MIR", folder / "edit.exr", 32, 24, vpls=64)
        before = before or (resident() if k == 4 else None)
    grown = resident() - before
    if not 2.0 < bright.mean() / dark.mean() < 3.5:
        failures.append("a brighter lamp is not seen")
    print(f"20 edits: {grown:+.1f} MiB after the fifth")
    if grown > _MOST_GROWTH:
        failures.append(f"edits kept {grown:.1f} MiB")
    for build in (lamps, instances):
        build()
        if not render("MIR", folder / "row.exr", 32, 24, vpls=64).mean() > 0.0:
            failures.append(f"{build.__name__} after another scene is black")
    if not any("shadows are sharp" in one for one in last_render.losses):
        failures.append("the sun's angle is not in the list of losses")
    return failures


CHECKS = (
    check_passes,
    check_passes_add_up,
    check_removed,
    check_light_budget,
    check_frames,
    check_edits,
    check_cancellations,
)


def check(folder) -> list[str]:
    """All of these."""
    return [failure for one in CHECKS for failure in one(folder)]
