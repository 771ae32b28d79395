// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/hdr_flip.hpp"
#include "mir/compare/metrics.hpp"
#include "mir/compare/scaled_rel_mse.hpp"
#include "options.hpp"

#include <string>
#include <vector>

namespace mirtool {

/// Two pictures and everything that was measured of them.
struct Comparison {
    mir::Image<mir::Rgb> image;
    mir::Image<mir::Rgb> reference;
    mir::DVec3 origin{0.0};            ///< from which positions of `image` are counted, metres
    mir::DVec3 reference_origin{0.0};  ///< and those of `reference`
    mir::ImageMetrics metrics;
    mir::ScaledRelMse scaled;    ///< from two references where two were given
    mir::Image<float> flip_map;  ///< HDR-FLIP
    double flip = 0.0;           ///< mean of it
    double ldr_flip = 0.0;       ///< mean, at `exposure`
    mir::FlipExposures flip_exposures;
    float exposure = 0.0f;              ///< EV of pictures and LDR-FLIP
    std::vector<std::string> exceeded;  ///< metrics above their limits, as the JSON names them
};

/// Checks, before any work is done, that the files asked for can be written. None of them may
/// replace another or a picture to compare.
/// @throws mir::Error(io or invalid_argument).
void check_outputs(const CompareOptions& options);

/// Writes the files that were asked for. Each appears complete or not at all.
void write_outputs(const Comparison& comparison, const CompareOptions& options);

/// The metrics on stdout, as JSON or as a table.
void print_metrics(const Comparison& comparison, const CompareOptions& options);

}  // namespace mirtool
