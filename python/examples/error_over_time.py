# SPDX-License-Identifier: MIT
"""Error against time, in ten lines."""

import sys
import time

import mir

small = "--small" in sys.argv
size = dict(width=48, height=36, luxels=1) if small else dict(width=320, height=240)
truth = mir.reference("builtin:cornell-box", samples=64 if small else 1024, **size)
start = time.perf_counter()
for result in mir.progressive("builtin:cornell-box", vpls=64, passes=4 if small else 32, **size):
    error = mir.compare(result, truth)
    seconds = time.perf_counter() - start
    print(f"{seconds:7.2f} s  RMSE {error.rmse:.4f}  relMSE {error.rel_mse:.5f}")
