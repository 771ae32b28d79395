// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <string>

namespace mirtool {

/// A layer of a picture, and what its positions are counted from.
struct Picture {
    mir::Image<mir::Rgb> image;
    mir::DVec3 origin{0.0};  ///< attribute mir:origin, metres; zero where it has none
};

/// Reads a layer of an OpenEXR picture, the beauty when `layer` is empty.
/// @throws mir::Error for whatever is wrong with it, limits included: invalid_input or unsupported.
Picture read_picture(const std::string& name, const std::string& layer = "");

}  // namespace mirtool
