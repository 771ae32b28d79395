# SPDX-License-Identifier: MIT
"""Light of Blender's lamps per watt, measured beside Cycles; tests/check_lamps.py keeps it.

Cycles changed between 3.4 and the oldest Blender that takes extensions, 4.2.
"""

import math

import bpy

IS_OLD = bpy.app.version < (4, 2, 0)

POINT_INTENSITY = 1.0 / (4.0 * math.pi)  # W sr^-1
AREA_INTENSITY = 0.25 if IS_OLD else 1.0 / math.pi  # W sr^-1 along the axis


def _power(intensity: float, cos_outer: float, cos_inner: float) -> float:
    """Of a spot of mir, over 2 pi: its edge is the square of a step, with a mean of 1/3."""
    return intensity * ((1.0 - cos_inner) + (cos_inner - cos_outer) / 3.0)


def _old_spot(cos_outer: float, blend: float, cos_inner: float) -> list[tuple[float, float]]:
    """Old spots fall by the cosine inside their cone.

    Its way from the edge, t, is nearly 0.063 + 0.734 t^2 + 0.251 min(1, t / 0.35)^2, the least
    squares over 0..1: three spots, scaled to the power of the one.
    """
    rise = 1.0 - cos_outer
    parts = [
        (cos_outer + 0.0627 * rise, cos_inner),
        (0.7337 * rise, 1.0),
        (0.2512 * rise, cos_outer + 0.35 * rise),
    ]
    width = blend * rise
    full = cos_outer + width
    power = (1.0 - full**2) / 2.0 + width * (0.5 * cos_outer + 0.35 * width)
    scale = POINT_INTENSITY * power / sum(_power(i, cos_outer, inner) for i, inner in parts)
    return [(scale * intensity, inner) for intensity, inner in parts]


def spot_parts(cos_outer: float, blend: float) -> list[tuple[float, float]]:
    """Spots of mir for one of Cycles: W sr^-1 on the axis and cosine of the inner angle.

    Edges are steps of the cosine: Cycles' is smooth and has a mean of 1/2, mir's is a square and
    has 1/3, so three fourths of the width send as much.
    """
    cos_inner = min(1.0, cos_outer + 0.75 * blend * (1.0 - cos_outer))
    if IS_OLD:
        return _old_spot(cos_outer, blend, cos_inner)
    return [(POINT_INTENSITY, cos_inner)]
