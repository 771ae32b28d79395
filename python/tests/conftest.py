# SPDX-License-Identifier: MIT
"""Scenes and settings that tests share."""

import os
import pathlib

import numpy as np
import pytest

import mir

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = {"width": 32, "height": 24, "vpls": 32, "luxels": 1, "direct_samples": 4}


@pytest.fixture
def small():
    """Settings of a picture that takes a moment."""
    return dict(SMALL)


@pytest.fixture
def room():
    """A floor, a wall and a lamp, from arrays."""
    scene = mir.Scene("room")
    grey = scene.add_material(base_color=(0.5, 0.5, 0.5), specular=0.0)
    lamp = scene.add_material(base_color=(0, 0, 0), specular=0.0, emission=(10, 10, 10))
    square = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)
    floor = np.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], np.float32)
    wall = np.array([[-1, 0, -1], [1, 0, -1], [1, 2, -1], [-1, 2, -1]], np.float32)
    light = np.array([[-0.2, 1.5, -0.2], [0.2, 1.5, -0.2], [0.2, 1.5, 0.2], [-0.2, 1.5, 0.2]])
    scene.add_mesh(floor, square, material=grey)
    scene.add_mesh(wall, square, material=grey)
    scene.add_mesh(light, square, material=lamp)
    scene.add_camera((0, 1, 4), (0, 0.7, 0), fov=40)
    return scene


@pytest.fixture
def program():
    """The program mir, where it was built."""
    path = pathlib.Path(os.environ.get("MIR_PROGRAM", ROOT / "build/cpu/bin/mir"))
    if not path.exists():
        pytest.skip(f"the program is not built ({path})")
    return path
