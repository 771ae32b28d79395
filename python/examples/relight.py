# SPDX-License-Identifier: MIT
"""Relights a scene from stored visibility bits: after the first picture no ray is traced.

Two lamps of two groups light a room. Each VPL knows whose light it carries, so indirect light of
either lamp is a sum over bits that were found once. Direct light is left out.
"""

import sys
import time

import numpy as np

import mir

size = dict(width=64, height=48, vpls=64) if "--small" in sys.argv else dict(width=320, height=240)

scene = mir.load("builtin:cornell-box")
scene.add_point_light((0.6, 1.2, 0.4), intensity=(0.2, 0.4, 2.0), light_group=1)
vpls = mir.sample_vpls(scene, **size)
gbuffer = mir.gbuffer(scene, **size)

start = time.perf_counter()
bits = mir.visibility(
    scene,
    gbuffer["position"].reshape(-1, 3),
    gbuffer["normal"].reshape(-1, 3),
    vpls.positions,
    vpls.normals,
)
print(f"{bits.nbytes} bytes of visibility in {time.perf_counter() - start:.2f} s")

start = time.perf_counter()
lamps = [
    mir.reshade(gbuffer, vpls.of_light_group(g), bits, ray_offset=scene.ray_offset) for g in (0, 1)
]
print(f"light of two lamps in {time.perf_counter() - start:.2f} s, no ray")

both = mir.reshade(gbuffer, vpls, bits, ray_offset=scene.ray_offset)
assert np.allclose(lamps[0] + lamps[1], both, rtol=1e-4, atol=1e-6)
for dimmed in (1.0, 0.5, 0.0):
    picture = lamps[0] + dimmed * lamps[1]
    print(f"second lamp at {dimmed:.0%}: mean indirect light {picture.mean():.4f} W m^-2 sr^-1")
