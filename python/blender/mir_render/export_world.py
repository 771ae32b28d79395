# SPDX-License-Identifier: MIT
"""Light from all around: the world's colour or its environment texture."""

import math

import numpy as np

from .export_image import linear_pixels
from .nodes import active_output, color_of, constant_of, source_of

_MOST_ROWS = 1024  # larger textures are averaged


def add_world(scene, world, losses) -> None:
    """Sets the environment of the scene; a black one is none."""
    if world is None:
        return
    radiance, rotation = _read(world, losses)
    if radiance is not None and radiance.max() > 0.0:
        scene.set_environment(np.maximum(radiance, 0.0), rotation=rotation)


def _plain(color) -> np.ndarray:
    return np.tile(np.array(color, np.float32), (1, 2, 1))


def _read(world, losses) -> tuple:
    """Radiance, (h, w, 3), and degrees about +y."""
    if not world.use_nodes or world.node_tree is None:
        return _plain(tuple(world.color)), 0.0
    output = active_output(world.node_tree, "OUTPUT_WORLD")
    if output is None:
        return None, 0.0
    if output.inputs["Volume"].is_linked:
        losses.add(world.name, "its volume")
    source = source_of(output.inputs["Surface"])
    if source is None:
        return None, 0.0
    node = source[0]
    if node.type != "BACKGROUND":
        losses.add(world.name, f"'{node.name}': give a Background node")
        return None, 0.0
    strength, is_all = constant_of(node.inputs["Strength"])
    if not is_all:
        losses.add(world.name, f"what feeds the strength of '{node.name}'")
    radiance, rotation = _read_color(world, node.inputs["Color"], losses)
    return radiance * np.float32(strength), rotation


def _read_color(world, socket, losses) -> tuple:
    color, is_all = constant_of(socket)
    if is_all:
        return _plain(color_of(color)), 0.0
    node, _ = source_of(socket)
    if node.type != "TEX_ENVIRONMENT" or node.image is None:
        losses.add(world.name, f"'{node.name}': the plain colour of '{socket.name}' is taken")
        return _plain(color_of(color)), 0.0
    if node.projection != "EQUIRECTANGULAR":
        losses.add(world.name, f"'{node.name}' is read as equirectangular")
    pixels = linear_pixels(node.image)
    if pixels is None:
        losses.add(node.image.name, "the image has no pixels; its file may be missing")
        return _plain((0, 0, 0)), 0.0
    return _averaged(pixels), _rotation(world, node, losses)


def _averaged(pixels: np.ndarray) -> np.ndarray:
    """The means of squares of pixels, so that no more than _MOST_ROWS remain."""
    step = math.ceil(pixels.shape[0] / _MOST_ROWS)
    rows, columns = (max(1, size // step) for size in pixels.shape[:2])
    pixels = pixels[: rows * step, : columns * step]
    return pixels.reshape(rows, step, columns, step, 3).mean(axis=(1, 3))


def _rotation(world, node, losses) -> float:
    """Degrees about +y of a Mapping node that turns about z."""
    source = source_of(node.inputs["Vector"])
    if source is None or source[0].type == "TEX_COORD":
        return 0.0
    mapping = source[0]
    if mapping.type != "MAPPING":
        losses.add(world.name, f"'{mapping.name}' does not turn the world")
        return 0.0
    turn, is_all = constant_of(mapping.inputs["Rotation"])
    if not is_all or abs(turn[0]) > 1e-6 or abs(turn[1]) > 1e-6:
        losses.add(world.name, f"'{mapping.name}' turns about z alone")
    # The node turns the direction that is looked up, so the picture turns the other way.
    return -math.degrees(turn[2])
