# SPDX-License-Identifier: MIT
"""Lights the G-buffer of another renderer by VPLs.

The other renderer is a few lines of NumPy: it meets a sphere on a floor by its own formulas and
knows nothing of mir. Its arrays are handed over where they lie.
"""

import sys

import numpy as np

import mir

W, H = (48, 36) if "--small" in sys.argv else (320, 240)
CENTRE, RADIUS, EYE = np.float32([0, 0.5, 0]), 0.5, np.float32([0, 1, 3])


def render_gbuffer():
    """Position, normal and albedo of what each pixel sees, in closed form."""
    x, y = np.meshgrid((np.arange(W) + 0.5) / W - 0.5, 0.5 - (np.arange(H) + 0.5) / H)
    ray = np.stack([x * W / H, y - 0.25, np.full_like(x, -1.2)], axis=-1)
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    b = ray @ (EYE - CENTRE)
    root = b**2 - (np.sum((EYE - CENTRE) ** 2) - RADIUS**2)
    to_sphere = np.where(root > 0, -b - np.sqrt(np.maximum(root, 0)), np.inf)
    to_floor = np.where(ray[..., 1] < 0, -EYE[1] / np.minimum(ray[..., 1], -1e-9), np.inf)
    distance = np.minimum(to_sphere, to_floor)
    seen = distance < 20
    place = EYE + ray * np.where(seen, distance, 0)[..., None]
    on_sphere = (to_sphere < to_floor) & seen
    normal = np.where(on_sphere[..., None], (place - CENTRE) / RADIUS, [0.0, 1.0, 0.0])
    normal[~seen] = 0  # background
    albedo = np.where(on_sphere[..., None], [0.8, 0.3, 0.2], [0.6, 0.6, 0.6])
    return {
        "position": place.astype(np.float32),
        "normal": normal.astype(np.float32),
        "albedo": albedo.astype(np.float32),
        "eye": EYE,
    }


def hiding_scene():
    """What hides: the same things as triangles, and a lamp."""
    scene = mir.Scene()
    scene.add_material(base_color=(0.8, 0.3, 0.2), specular=0)
    scene.add_material(base_color=(0.6, 0.6, 0.6), specular=0)
    turn, up = np.meshgrid(np.linspace(0, 2 * np.pi, 65), np.linspace(0, np.pi, 33))
    ball = np.stack([np.sin(up) * np.cos(turn), np.cos(up), -np.sin(up) * np.sin(turn)], axis=-1)
    # A little smaller than the true sphere, so that places on that lie before the triangles.
    ball = ball.reshape(-1, 3) * (0.995 * RADIUS) + CENTRE
    i = (np.arange(32)[:, None] * 65 + np.arange(64)).ravel()
    faces = np.concatenate([np.stack([i, i + 65, i + 1], 1), np.stack([i + 1, i + 65, i + 66], 1)])
    scene.add_mesh(ball, faces, material=0)
    floor = [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]
    scene.add_mesh(floor, [[0, 1, 2], [0, 2, 3]], material=1)
    scene.add_point_light((1.5, 2.5, 1.0), intensity=(6, 6, 6))
    scene.add_camera(EYE, (0, 0.5, 0))
    return scene


scene = hiding_scene()
vpls = mir.sample_vpls(scene, vpls=64 if W == 48 else 1024, sampler="ir")
gbuffer = render_gbuffer()
light = mir.reconstruct(scene, gbuffer, vpls)
lit = np.any(light > 0, axis=-1)
print(f"{len(vpls)} VPLs light {lit.mean():.0%} of {W}x{H} pixels, mean {light.mean():.4f}")
assert light.shape == (H, W, 3) and 0.2 < lit.mean() < 1
