# SPDX-License-Identifier: MIT
"""Cancellations while the ray structures of a million triangles are built."""

import random
import statistics

import bpy
from check_engine import cancel_once, resident
from scenes import instances

_CANCELLATIONS = 12
_MOST_SECONDS = 1.0
_MOST_GROWTH = 30.0  # MiB: what allocators keep


def _many_triangles() -> None:
    """A thousand instances of a ball of 1 280 triangles."""
    instances(subdivisions=4)
    scene = bpy.context.scene
    scene.render.engine = "MIR"
    scene.render.resolution_x, scene.render.resolution_y = 320, 240


def check(_folder) -> list[str]:
    """They end soon, at any moment, whatever the structure is."""
    failures = []
    moments = random.Random(2)
    for name, options in (
        ("shafts", {"integrator": "vpl", "vpls": 4096, "luxels": 4}),
        ("Embree", {"integrator": "path", "vpls": 0, "luxels": 4}),
    ):
        _many_triangles()
        for key, value in options.items():
            setattr(bpy.context.scene.mir, key, value)
        cancel_once(3.0)
        before = resident()
        waits = [cancel_once(moments.uniform(0.0, 3.0)) for _ in range(_CANCELLATIONS)]
        grown = resident() - before
        median, longest = statistics.median(waits), max(waits)
        print(
            f"{len(waits)} cancellations of builds, {name}: median {median:.2f} s, "
            f"longest {longest:.2f} s, {grown:+.1f} MiB"
        )
        if median > _MOST_SECONDS:
            failures.append(f"{name}: half of the cancellations took more than {median:.2f} s")
        if grown > _MOST_GROWTH:
            failures.append(f"{name}: cancellations kept {grown:.1f} MiB")
    return failures
