# SPDX-License-Identifier: MIT
"""From Blender's +z up to mir's +y up. Both count in metres and are right-handed."""

import numpy as np

TURN = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], np.float64)


def to_world(matrix) -> np.ndarray:
    """mir's (4, 4) of a matrix of Blender's world."""
    return TURN @ np.array(matrix, np.float64)


def axes_of(to_world_matrix: np.ndarray) -> np.ndarray:
    """Unit x, y and z axes of an object as columns."""
    axes = to_world_matrix[:3, :3]
    return axes / np.linalg.norm(axes, axis=0)


def vectors_of_blender(vectors: np.ndarray) -> np.ndarray:
    """mir's (..., 3) in Blender's axes."""
    return np.stack([vectors[..., 0], -vectors[..., 2], vectors[..., 1]], axis=-1)
