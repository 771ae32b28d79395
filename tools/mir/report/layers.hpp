// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/io/png.hpp"
#include "report/render_report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mirtool {

/// Means of squares of `factor` x `factor` pixels, smaller at the rim. Those at the right and lower
/// rim take what there is.
mir::Image<mir::Rgb> shrunk(const mir::Image<mir::Rgb>& image, std::uint32_t factor);

/// A layer of a report that can be shown at any exposure.
struct ReportLayer {
    std::string id;
    std::string label;
    const mir::Image<mir::Rgb>* image = nullptr;
    std::string code;  ///< base64 of deflate_radiance(), shrunk
};

/// Everything of a report that is a picture, shrunk to fit a page.
struct ReportPictures {
    std::uint32_t shrink = 1;  ///< pixels of the render that one pixel of the page is across
    std::vector<ReportLayer>
        layers;                ///< direct, emission, indirect or its bounces, denoised, reference
    std::string still;         ///< beauty at the exposure, base64 of a PNG
    std::string error;         ///< signed error, the same; empty without reference
    float error_range = 0.0f;  ///< that of signed_error_picture()
};

/// Codes the pictures of a report, at the largest size that stays below `most_bytes`.
ReportPictures report_pictures(const ReportInput& input, const mir::PreviewLook& look,
                               std::size_t most_bytes);

}  // namespace mirtool
