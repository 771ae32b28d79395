# SPDX-License-Identifier: MIT
"""The parts: VPLs, visibility, light from arrays, light from bits."""

import numpy as np
import pytest

import mir


def test_vpls_are_those_of_the_picture(room, small):
    placed = mir.sample_vpls(room, **small)
    wanted = mir.render(room, **small).vpls
    for name in ("positions", "normals", "intensities"):
        np.testing.assert_array_equal(getattr(placed, name), getattr(wanted, name))
    assert placed.bound == pytest.approx(wanted.bound)
    bounces = [placed.of_bounce(b).intensities for b in range(1, 33)]
    np.testing.assert_allclose(np.sum(bounces, axis=0), placed.intensities, rtol=1e-5)


def test_vpls_are_views(room, small):
    vpls = mir.sample_vpls(room, **small)
    vpls.intensities[:] = 0
    assert np.all(vpls.intensities == 0) and np.any(vpls.positions != 0)


def test_vpls_from_arrays():
    up = np.array([[0, 1, 0]], np.float32)
    vpls = mir.Vpls(up, up, up)
    assert len(vpls) == 1 and vpls.positions.tolist() == up.tolist()
    with pytest.raises(mir.Error) as raised:
        mir.Vpls(up, 2 * up, up)
    assert raised.value.place == "normals"
    with pytest.raises(mir.Error):
        vpls.of_bounce(2)


def test_visibility_of_a_wall(room):
    points = np.array([[0, 0, 0], [0, 0, 0.5], [0.5, 0, 0]], np.float32)
    normals = np.tile(np.float32([0, 1, 0]), (3, 1))
    targets = np.array([[0, 1, 0], [0, 1, -2], [0, 3, 0], [0, -1, 0]], np.float32)
    bits = mir.visibility(room, points, normals, targets)
    assert bits.shape == (3, 1) and bits.dtype == np.uint8
    seen = np.unpackbits(bits, axis=1, count=4, bitorder="little")
    # The wall hides the second target, the lamp the third from what lies below it.
    assert seen.tolist() == [[1, 0, 0, 0], [1, 0, 1, 0], [1, 0, 1, 0]]


def test_light_from_bits_is_that_of_rays(room, small):
    gbuffer = mir.gbuffer(room, **small)
    vpls = mir.sample_vpls(room, **small)
    traced = mir.reconstruct(room, gbuffer, vpls)
    assert traced.shape == (24, 32, 3) and traced.max() > 0
    bits = mir.visibility(
        room,
        gbuffer["position"].reshape(-1, 3),
        gbuffer["normal"].reshape(-1, 3),
        vpls.positions,
        vpls.normals,
    )
    shaded = mir.reshade(gbuffer, vpls, bits, ray_offset=room.ray_offset)
    np.testing.assert_allclose(shaded, traced, rtol=1e-5, atol=1e-9)
    vpls.intensities[:] *= 2
    doubled = mir.reshade(gbuffer, vpls, bits, ray_offset=room.ray_offset)
    np.testing.assert_allclose(doubled, 2 * shaded, rtol=1e-6)


def test_reconstructed_light_is_that_of_the_picture(room, small):
    settings = {**small, "width": 64, "height": 48, "vpls": 256}
    gbuffer = mir.gbuffer(room, **settings)
    result = mir.render(room, **settings)
    light = mir.reconstruct(room, gbuffer, result.vpls)
    assert light.mean() == pytest.approx(result.indirect.mean(), rel=0.05)


def test_gbuffers_are_read_where_they_lie(room, small):
    gbuffer = mir.gbuffer(room, **small)
    vpls = mir.sample_vpls(room, **small)
    light = mir.reconstruct(room, gbuffer, vpls)
    flipped = {name: array[::-1] for name, array in gbuffer.items()}
    np.testing.assert_array_equal(mir.reconstruct(room, flipped, vpls)[::-1], light)


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"position": None}, "gbuffer.position"),
        ({"normal": np.zeros((2, 2, 3), np.float32)}, "gbuffer"),
        ({"albedo": np.zeros((24, 32, 3))}, "gbuffer.albedo"),
        ({"view": None}, "gbuffer.view"),
        ({"colour": np.zeros(3)}, "gbuffer"),
        ({"roughness": np.full((24, 32), np.nan, np.float32)}, "gbuffer.roughness"),
    ],
)
def test_gbuffers_that_cannot_be_used(room, small, change, place):
    gbuffer = {**mir.gbuffer(room, **small), **change}
    vpls = mir.sample_vpls(room, **small)
    with pytest.raises(mir.Error) as raised:
        mir.reconstruct(room, gbuffer, vpls)
    assert raised.value.place == place


def test_bits_that_do_not_fit(room, small):
    gbuffer = mir.gbuffer(room, **small)
    vpls = mir.sample_vpls(room, **small)
    luxels, row = 24 * 32, (len(vpls) + 7) // 8
    for bits in (
        np.zeros((luxels, row + 1), np.uint8),
        np.zeros((luxels, row), np.int8),
        np.zeros((luxels, 2 * row), np.uint8)[:, ::2],
    ):
        with pytest.raises(mir.Error) as raised:
            mir.reshade(gbuffer, vpls, bits)
        assert raised.value.place == "bits"
