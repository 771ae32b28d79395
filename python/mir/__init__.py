# SPDX-License-Identifier: MIT
"""Metropolis Instant Radiosity: scenes and pictures as arrays.

Metres, +y up; radiance in W m^-2 sr^-1, linear Rec. 709. Settings of pictures are those of the
program `mir render`, with "_" for "-": mir.render(scene, vpls=256, direct_samples=8).
"""

from mir._core import (
    Comparison,
    Progress,
    Result,
    Scene,
    Vpls,
    builtin_scenes,
    devices,
    load,
    reconstruct,
    reshade,
    version as __version__,
    visibility,
)
from mir._error import Error
from mir._render import (
    compare,
    gbuffer,
    micro,
    progressive,
    reference,
    render,
    sample_vpls,
)

__all__ = [
    "Comparison",
    "Error",
    "Progress",
    "Result",
    "Scene",
    "Vpls",
    "builtin_scenes",
    "compare",
    "devices",
    "gbuffer",
    "load",
    "micro",
    "progressive",
    "reconstruct",
    "reference",
    "render",
    "reshade",
    "sample_vpls",
    "visibility",
]
