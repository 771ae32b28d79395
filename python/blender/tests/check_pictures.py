# SPDX-License-Identifier: MIT
"""Every scene, by mir and by Cycles, as pictures to look at."""

import numpy as np
from pictures import render
from scenes import SCENES

_SIZE = 320, 240


def check(folder) -> list[str]:
    """Writes NAME-mir.exr and NAME-cycles.exr; fails where one is not finite, or black."""
    failures = []
    for name, build in SCENES.items():
        build()
        for engine in ("MIR", "CYCLES"):
            picture = render(engine, folder / f"{name}-{engine.lower()}.exr", *_SIZE, samples=64)
            print(f"{name:14}{engine:8}{picture.mean():10.5f}")
            if not (np.isfinite(picture).all() and picture.mean() > 0.0):
                failures.append(f"{name}, {engine}: black, or not finite")
    return failures
