// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/scene/scene.hpp"

#include <filesystem>

namespace mirconvergence {

/// The indirect light of an image by path tracing: light that was scattered at least twice on its
/// way to the camera (D_2 and on), one estimate per pixel along the ray through its centre.
struct Reference {
    mir::Image<mir::Rgb> indirect;  ///< W m^-2 sr^-1
    mir::Image<float> variance;     ///< of the mean luminance of each pixel, (W m^-2 sr^-1)^2
};

/// How a reference is made; equal scenes and values give equal bits.
struct ReferenceSettings {
    mir::Extent size{128, 96};     ///< pixels
    std::uint32_t samples = 4096;  ///< paths per pixel; rounded up to replicates of equal size
    unsigned threads = 0;          ///< 0: every core; changes no bit
};

/// Traces the reference, telling its progress on stderr.
/// @throws mir::Error for what the scene or the device does wrong.
Reference trace_reference(const mir::Scene& scene, const ReferenceSettings& settings);

/// The same from a file of `folder` when it was traced before, else traced and stored there. The
/// name of the file holds the hash of the scene, size and samples; `folder` is made when missing,
/// and nothing is stored when its name is empty.
/// @throws mir::Error(io) when the folder cannot be written.
Reference cached_reference(const mir::Scene& scene, const ReferenceSettings& settings,
                           const std::filesystem::path& folder);

}  // namespace mirconvergence
