# SPDX-License-Identifier: MIT
"""Images of Blender as arrays."""

import numpy as np


def linear_of_srgb(values: np.ndarray) -> np.ndarray:
    """Linear values of sRGB ones."""
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def srgb_of_linear(values: np.ndarray) -> np.ndarray:
    """sRGB values of linear ones."""
    high = 1.055 * np.maximum(values, 0.0031308) ** (1 / 2.4) - 0.055
    return np.where(values <= 0.0031308, values * 12.92, high)


def _stored(image) -> np.ndarray | None:
    """(h, w, 4) of float32 as stored, the top row first; None where there are no pixels."""
    width, height = image.size
    if width == 0 or height == 0 or image.channels == 0:
        return None
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1]
    if image.channels < 3:
        pixels = np.repeat(pixels[..., :1], 3, axis=2)
    if pixels.shape[2] == 3:
        pixels = np.concatenate([pixels, np.ones_like(pixels[..., :1])], axis=2)
    return pixels


def _is_encoded(image) -> bool:
    """True when stored values are sRGB's: pixels of float images are linear."""
    return not image.is_float and image.colorspace_settings.name == "sRGB"


def linear_pixels(image) -> np.ndarray | None:
    """(h, w, 3) of linear light."""
    stored = _stored(image)
    if stored is None:
        return None
    return linear_of_srgb(stored[..., :3]) if _is_encoded(image) else stored[..., :3]


def color_bytes(image) -> np.ndarray | None:
    """(h, w, 4) of uint8: sRGB and alpha."""
    stored = _stored(image)
    if stored is None:
        return None
    color = stored[..., :3] if _is_encoded(image) else srgb_of_linear(stored[..., :3])
    return _bytes_of(np.concatenate([color, stored[..., 3:]], axis=2))


def data_bytes(image) -> np.ndarray | None:
    """(h, w, 4) of uint8 as stored: normals and the like."""
    stored = _stored(image)
    return None if stored is None else _bytes_of(stored)


def _bytes_of(shares: np.ndarray) -> np.ndarray:
    return np.rint(np.clip(shares, 0, 1) * 255).astype(np.uint8)
