#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Denoises a picture of `mir render --aov albedo,normal` by Open Image Denoise.

Every layer named is denoised with the guides of the picture and written as a layer of its own.
"""
import argparse

import numpy
import OpenEXR
import pyoidn


def plane(channels, layer, letters):
    """A layer of three numbers a pixel."""
    prefix = layer + "." if layer else ""
    return numpy.stack([channels[prefix + c].pixels for c in letters], -1).astype(numpy.float32)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("picture", help="EXR")
    parser.add_argument("output", help="EXR to write")
    parser.add_argument("--layer", action="append", default=[""], help="besides the picture")
    options = parser.parse_args()
    channels = OpenEXR.File(options.picture, separate_channels=True).channels()
    albedo, normal = plane(channels, "albedo", "RGB"), plane(channels, "normal", "XYZ")
    written = {}
    for layer in options.layer:
        clean = pyoidn.denoise(plane(channels, layer, "RGB"), albedo, normal, hdr=True)
        for i, letter in enumerate("RGB"):
            name = f"{layer}.{letter}" if layer else letter
            written[name] = numpy.ascontiguousarray(clean[..., i], numpy.float32)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, written).write(options.output)


if __name__ == "__main__":
    main()
