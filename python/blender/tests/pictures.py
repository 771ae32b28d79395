# SPDX-License-Identifier: MIT
"""Rendering to arrays."""

from pathlib import Path

import bpy
import numpy as np


def render(
    engine: str, path: Path, width: int, height: int, samples: int = 64, **options
) -> np.ndarray:
    """(h, w, 3) of linear light, the top row first; writes a float OpenEXR."""
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    if engine == "CYCLES":
        scene.cycles.samples = samples
        scene.cycles.use_denoising = False
        scene.cycles.use_adaptive_sampling = False
        scene.cycles.sample_clamp_indirect = 0.0
        scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 32
    for name, value in options.items():
        setattr(scene.mir, name, value)
    bpy.ops.render.render(write_still=True)
    return read(path)


def read(path: Path) -> np.ndarray:
    """(h, w, 3) of a file, the top row first."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, -1)[::-1, :, :3]
