# SPDX-License-Identifier: MIT
"""What renders. Scenes may also be meshes of trimesh, Open3D or PyVista, or names of files."""

from collections.abc import Callable, Iterator
from typing import Any

from mir import _core
from mir._core import Comparison, Progress, Result, Scene, Vpls
from mir._progress import callback_of
from mir._words import words_of

ProgressCallback = Callable[[Progress], Any] | bool | None


def _scene_of(scene) -> Scene:
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, str) or hasattr(scene, "__fspath__"):
        return _core.load(str(scene))
    from mir.neighbours import scene_from

    return scene_from(scene)


def render(scene, *, progress: ProgressCallback = None, **settings) -> Result:
    """Renders a scene.

    scene: a Scene, the name of a file or "builtin:NAME", or a mesh of trimesh, Open3D or PyVista.
    progress: a function that gets a Progress ten times a second, or True for a bar of tqdm. What it
    raises cancels the render, as Ctrl-C does.
    settings: those of `mir render`, with "_" for "-": width, height, vpls, sampler, bound, passes,
    seed, threads, eye=(x, y, z) and so on.

    The float32 arrays of the result have the bits of the program's picture.
    """
    return _core._render(_scene_of(scene), words_of(settings), callback_of(progress))


def progressive(scene, *, progress: ProgressCallback = None, **settings) -> Iterator[Result]:
    """Renders pass by pass; yields the mean of the passes so far.

    Ends where passes, time or target_error say; without these it goes on until it is left. The
    scene cannot be edited before that.
    """
    passes = _core._Progressive(_scene_of(scene), words_of(settings))
    while passes.next(callback_of(progress)):
        yield passes.result()


def reference(scene, *, progress: ProgressCallback = None, **settings) -> Result:
    """The picture of the reference path tracer: noisy, unbiased, slow.

    samples: camera paths per luxel (64). Other settings: those of render().
    """
    return render(scene, progress=progress, **{"integrator": "path", **settings})


def micro(scene, *, progress: ProgressCallback = None, **settings) -> Result:
    """The picture whose indirect light is gathered from a hierarchy of discs.

    surfels: discs wanted. Other settings: those of render().
    """
    return render(scene, progress=progress, **{"integrator": "micro", **settings})


def sample_vpls(scene, *, progress: ProgressCallback = None, **settings) -> Vpls:
    """The VPLs that render() would place, with their intensities, W sr^-1, without a picture.

    settings: those of render(). Without any of vpls, sampler, sum and quality there are 1024 VPLs
    by Metropolis sampling.
    """
    if not {"vpls", "sampler", "sum", "quality"} & settings.keys():
        settings = {"vpls": 1024, **settings}
    return _core._sample_vpls(_scene_of(scene), words_of(settings), callback_of(progress))


def gbuffer(scene, **settings) -> dict:
    """What the middle of each pixel sees, as reconstruct() and reshade() take it.

    Arrays of float32 (h, w, 3): position, metres; normal, geometric; shading_normal; view, towards
    the camera; albedo, the base colour; emission, W m^-2 sr^-1. (h, w): roughness, metallic,
    specular. Zero where nothing is seen. settings: width, height, camera, eye and the like.
    """
    return _core._gbuffer(_scene_of(scene), words_of(settings))


def compare(
    image,
    reference,
    *,
    epsilon: float = _core.default_epsilon,
    pixels_per_degree: float = _core.default_pixels_per_degree,
) -> Comparison:
    """Compares a picture with its reference: (h, w, 3) each, or the beauty of two results.

    epsilon: of rel_mse, in the squared unit of the pictures. pixels_per_degree: of HDR-FLIP.
    """
    pictures = [p.beauty if isinstance(p, Result) else p for p in (image, reference)]
    return _core._compare(*pictures, epsilon, pixels_per_degree)
