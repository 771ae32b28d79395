// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/io/exr_layer.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// Luminous efficacy of the equal-energy white in lm/W that Radiance fixed by convention. It turns
/// the radiance of RGB (1, 1, 1) into the cd/m^2 that attribute whiteLuminance asks for.
inline constexpr float white_efficacy = 179.0f;

/// Writes all layers into one scan line OpenEXR file with lossless ZIP compression. Values are
/// stored as they are: linear Rec. 709, scene-referred, no tone curve, no clamp. Channels appear in
/// alphabetical order, as the format wants it; equal arguments give equal bytes. The file replaces
/// an older one only when complete. Attributes chromaticities, software ("mir") and whiteLuminance
/// (white_efficacy, in cd/m^2 for radiance in W m^-2 sr^-1) are added; the last two can be given.
/// Compression uses the threads of Imf::setGlobalThreadCount().
/// @throws Error(io) when the file cannot be written; Error(internal) for NaN or infinite values;
///         Error(invalid_argument) for layers of different size, values that half cannot hold,
///         and names that are taken.
void write_exr(const std::filesystem::path& path, Extent extent,
               const std::vector<ExrLayer>& layers, const ExrAttributes& attributes = {});

/// What read_exr() found.
struct ExrImage {
    Image<Rgb> image;                                             ///< as large as the data window
    std::vector<std::pair<std::string, std::string>> attributes;  ///< text only, sorted by name
    std::vector<std::pair<std::string, DVec3>> vectors;           ///< those of type v3d
    std::vector<std::string> layers;  ///< names of all in the file, sorted; "" is the beauty
};

/// Reads one layer of a single-part OpenEXR file, the beauty when `layer` is empty. Channels are R
/// G B, else X Y Z, else Y or Z repeated three times. Values come as stored. OpenEXR itself is not
/// hardened against hostile files in every version that distributions ship: read files that you
/// trust.
/// @throws Error(invalid_input) when the file or the layer is missing or broken,
///         Error(unsupported) for several parts or deep pixels, Error(limit_exceeded) when the
///         file passes `limits`; std::bad_alloc.
ExrImage read_exr(const std::filesystem::path& path, const std::string& layer = "",
                  const Limits& limits = {});

}  // namespace mir
