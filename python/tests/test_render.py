# SPDX-License-Identifier: MIT
"""Pictures are those of the program."""

import subprocess

import numpy as np
import pytest

import mir

LARGE = {"car", "car-up", "car-grille", "garage"}


def words(settings):
    return [f"--{name.replace('_', '-')}={value}" for name, value in settings.items()]


def same_file(program, scene, settings, tmp_path, more=()):
    """True where both write the same bytes."""
    theirs, ours = tmp_path / "theirs.exr", tmp_path / "ours.exr"
    subprocess.run(
        [program, "render", scene, "-q", "--no-png", "-o", theirs, *words(settings), *more],
        check=True,
    )
    mir.render(scene, **settings).save(ours)
    return theirs.read_bytes() == ours.read_bytes()


@pytest.mark.parametrize("scene", ["sphere", "cornell-box", "corner"])
def test_files_are_those_of_the_program(program, scene, small, tmp_path):
    assert same_file(program, f"builtin:{scene}", small, tmp_path)


@pytest.mark.extended
@pytest.mark.parametrize("scene", mir.builtin_scenes())
def test_files_of_every_scene_are_those_of_the_program(program, scene, small, tmp_path):
    assert same_file(program, f"builtin:{scene}", small, tmp_path)


@pytest.mark.parametrize(
    "settings",
    [
        {"sampler": "ir", "seed": 3, "bounces": 3, "aov": "all,bounces"},
        {"integrator": "path", "samples": 2},
        {"integrator": "micro", "surfels": 256, "gather_rays": 8, "surfel_rays": 4},
        {"passes": 2, "bound": "none", "aov": "all"},
    ],
    ids=["ir", "path", "micro", "passes"],
)
def test_settings_are_those_of_the_program(program, settings, small, tmp_path):
    assert same_file(program, "builtin:sphere", {**small, **settings}, tmp_path)


def test_scenes_without_camera_are_framed_as_by_the_program(program, small, tmp_path):
    scene = mir.Scene()
    scene.add_material(specular=0.0)
    scene.add_mesh(np.eye(3), [[0, 1, 2]])
    scene.save(tmp_path / "bare.glb")
    name = str(tmp_path / "bare.glb")
    assert same_file(program, name, {**small, "sun": "1,2,1", "ground": "true"}, tmp_path)


def test_layers_are_views_of_one_memory(small):
    result = mir.render("builtin:sphere", **small)
    assert result.beauty.shape == (24, 32, 3) and result.beauty.dtype == np.float32
    assert result.depth.shape == (24, 32)
    addresses = [result.beauty.__array_interface__["data"][0] for _ in range(2)]
    assert addresses[0] == addresses[1]
    sums = result.emission + (result.direct + result.indirect)
    np.testing.assert_array_equal(result.beauty, sums)
    beauty = result.beauty
    copy = beauty.copy()
    del result
    np.testing.assert_array_equal(beauty, copy)


def test_layers_go_out_by_dlpack_without_a_copy(small):
    result = mir.render("builtin:sphere", **small)
    other = np.from_dlpack(result.beauty)
    assert np.shares_memory(other, result.beauty)


def test_layers_on_request(small):
    result = mir.render("builtin:sphere", **small)
    assert result.bounces == [] and result.removed is None
    result = mir.render("builtin:sphere", aov="bounces,removed", **small)
    assert result.removed.shape == (24, 32, 3)
    assert len(result.bounces) > 1


def test_statistics_budget_and_warnings(small):
    result = mir.render("builtin:sphere", **small)
    facts = result.statistics
    assert facts["width"] == 32 and facts["vpls"] > 0 and facts["sampler"] == "mir"
    assert 0.0 <= result.light_budget["removed_share"] <= 1.0
    assert len(result.light_budget["mean_radiance"]["beauty"]) == 3
    assert all(isinstance(w, str) for w in result.warnings)


def test_picture_inline(small):
    assert mir.render("builtin:sphere", **small)._repr_png_().startswith(b"\x89PNG\r\n")


def test_passes_one_by_one(small):
    results = list(mir.progressive("builtin:sphere", passes=3, **small))
    assert [r.statistics["passes"] for r in results] == [1, 2, 3]
    whole = mir.render("builtin:sphere", passes=3, **small)
    np.testing.assert_array_equal(results[-1].beauty, whole.beauty)


def test_parts_of_a_render(small):
    assert mir.reference("builtin:sphere", samples=1, **small).statistics["sampler"] == "path"
    micro = mir.micro("builtin:sphere", surfels=128, gather_rays=8, surfel_rays=4, **small)
    assert micro.statistics["sampler"] == "micro"


def test_comparison(small):
    a = mir.render("builtin:sphere", **small)
    b = mir.render("builtin:sphere", **{**small, "seed": 1})
    assert mir.compare(a, a).rmse == 0.0
    found = mir.compare(a, b)
    wanted = np.sqrt(np.mean((a.beauty.astype(np.float64) - b.beauty) ** 2))
    assert found.rmse == pytest.approx(wanted)
    assert found.flip_map.shape == (24, 32) and 0.0 < found.flip < 1.0
