// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

namespace mir {

/// Pictures of what the camera sees, apart from light: for denoisers and compositors. Albedo and
/// normal are means over a pixel's luxels; position and depth are those of its first luxel that
/// sees a surface, because a mean of two surfaces lies on neither. Background: zero.
struct Guides {
    Image<Rgb> albedo;     ///< hemispherical reflectance, 0..1
    Image<Vec3> normal;    ///< shading normal, world space; shorter than 1 where it varies
    Image<Vec3> position;  ///< world space, metres
    Image<float> depth;    ///< distance from the lens plane, metres; 0: background

    /// Background everywhere.
    explicit Guides(Extent pixels)
        : albedo(pixels), normal(pixels), position(pixels), depth(pixels) {}

    /// Guides for those who write every pixel (Image::unwritten()).
    static Guides unwritten(Extent pixels) {
        Guides guides({0, 0});
        guides.albedo = Image<Rgb>::unwritten(pixels);
        guides.normal = Image<Vec3>::unwritten(pixels);
        guides.position = Image<Vec3>::unwritten(pixels);
        guides.depth = Image<float>::unwritten(pixels);
        return guides;
    }
};

}  // namespace mir
