# SPDX-License-Identifier: MIT
"""Writes pairs of noisy and clean pictures for a denoiser, with the guides that it wants."""

import pathlib
import sys

import numpy as np

import mir

small = "--small" in sys.argv
size = dict(width=48, height=36) if small else dict(width=256, height=192)
folder = pathlib.Path("pairs")
folder.mkdir(exist_ok=True)

for name in ("cornell-box", "sphere"):
    clean = mir.reference(f"builtin:{name}", samples=16 if small else 1024, **size)
    for seed in range(2):
        noisy = mir.reference(f"builtin:{name}", samples=1, luxels=1, seed=seed + 1, **size)
        path = folder / f"{name}-{seed}.npz"
        np.savez_compressed(
            path,
            noisy=noisy.beauty,
            clean=clean.beauty,
            albedo=np.clip(noisy.albedo, 0, 1),
            normal=np.clip(noisy.normal, -1, 1),
        )
        print(f"{path}: relMSE {mir.compare(noisy, clean).rel_mse:.4f}")
