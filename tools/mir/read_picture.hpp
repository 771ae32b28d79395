// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <string>

namespace mirtool {

/// Reads a layer of an OpenEXR picture, the beauty when `layer` is empty.
/// @throws mir::Error for whatever is wrong with it, limits included: invalid_input or unsupported.
mir::Image<mir::Rgb> read_picture(const std::string& name, const std::string& layer = "");

}  // namespace mirtool
