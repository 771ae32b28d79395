#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a scene by Mitsuba 3's path tracer, a process a picture, as a user would."""
import argparse

import drjit
import mitsuba
import numpy

MOST_SAMPLES = 1 << 24  # of a wavefront, so that memory stays small
GUIDES = "albedo:albedo,normal:sh_normal"


def accumulated(scene, integrator, options):
    """Mean over wavefronts, each with its own seed."""
    pixels = options.width * options.height
    step = max(1, min(options.paths, MOST_SAMPLES // pixels))
    total, done = None, 0
    while done < options.paths:
        paths = min(step, options.paths - done)
        seed = options.seed * 65537 + done
        picture = mitsuba.render(scene, integrator=integrator, spp=paths, seed=seed)
        picture = numpy.array(picture, dtype=numpy.float64) * paths
        total = picture if total is None else total + picture
        done += paths
    return (total / options.paths).astype(numpy.float32)


def denoised(picture):
    import pyoidn  # only here, since its import takes time
    colour, albedo, normal = (numpy.ascontiguousarray(part) for part in
                              (picture[..., :3], picture[..., -6:-3], picture[..., -3:]))
    return pyoidn.denoise(colour, albedo, normal, hdr=True)


class Check(argparse.Action):
    """Compiles and runs something, which shows whether there is a compiler that works."""

    def __call__(self, parser, namespace, values, option_string=None):
        choose_variant()
        picture = mitsuba.render(mitsuba.load_dict(mitsuba.cornell_box()), spp=1)
        parser.exit(0 if numpy.array(picture).mean() > 0 else 1)


def choose_variant():
    has_llvm = drjit.has_backend(drjit.JitBackend.LLVM)
    mitsuba.set_variant("llvm_ad_rgb" if has_llvm else "scalar_rgb")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action=Check, nargs=0, help="draw nothing; fail without LLVM")
    parser.add_argument("scene", help="XML")
    parser.add_argument("picture", help="EXR to write")
    parser.add_argument("--width", type=int, required=True)
    parser.add_argument("--height", type=int, required=True)
    parser.add_argument("--paths", type=int, required=True, help="a pixel")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--denoise", action="store_true", help="by Open Image Denoise")
    options = parser.parse_args()
    choose_variant()
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    scene = mitsuba.load_file(options.scene, width=options.width, height=options.height)
    path = {"type": "path", "max_depth": -1, "rr_depth": 5}
    if options.denoise:
        path = {"type": "aov", "aovs": GUIDES, "picture": path}
    picture = accumulated(scene, mitsuba.load_dict(path), options)
    if options.denoise:
        picture = denoised(picture)
    mitsuba.Bitmap(numpy.ascontiguousarray(picture[..., :3])).write(options.picture)


if __name__ == "__main__":
    main()
