# SPDX-License-Identifier: MIT
"""Meshes of lamps: corners and triangles."""

import math

import numpy as np


def rectangle(width: float, height: float) -> tuple:
    """In the plane of x and y, its front towards -z."""
    x, y = width / 2.0, height / 2.0
    corners = np.array([[-x, -y, 0], [-x, y, 0], [x, y, 0], [x, -y, 0]], np.float64)
    return corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def disc(width: float, height: float, sides: int = 64) -> tuple:
    """An ellipse in the plane of x and y, its front towards -z."""
    angles = -2.0 * math.pi * np.arange(sides) / sides
    rim = np.stack([np.cos(angles) * width / 2, np.sin(angles) * height / 2, 0 * angles], axis=1)
    first = np.arange(1, sides - 1)
    return rim, np.stack([0 * first, first, first + 1], axis=1).astype(np.int32)


def icosphere() -> tuple:
    """A sphere of radius 1 in 80 triangles, fronts outside."""
    g = (1.0 + math.sqrt(5.0)) / 2.0
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g)]
    corners += [(0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11)]
    faces += [(1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8)]
    faces += [(3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9)]
    faces += [(4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    corners = np.array(corners, np.float64)
    a, b, c = (corners[np.array(faces)[:, k]] for k in range(3))
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    soup = np.concatenate([np.stack(part, axis=1) for part in parts]).reshape(-1, 3)
    soup /= np.linalg.norm(soup, axis=1, keepdims=True)
    return soup, np.arange(len(soup), dtype=np.int32).reshape(-1, 3)
