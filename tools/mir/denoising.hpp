// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/metrics.hpp"
#include "mir/core/monitor.hpp"
#include "mir/denoise/denoiser.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace mirtool {

/// What taking the noise out of a picture came to.
struct Denoising {
    std::string denoiser;  ///< name and version; empty: nothing was denoised
    std::string failure;   ///< why nothing was; empty where all went well
    double seconds = 0.0;
    std::string reference;  ///< its file; empty: none
    std::optional<mir::ImageMetrics> before;
    std::optional<mir::ImageMetrics> after;

    /// Measures both errors by a reference, an empty one leaves them out.
    void measure(const mir::Image<mir::Rgb>& noisy, const mir::Image<mir::Rgb>& clean,
                 const mir::Image<mir::Rgb>& by, const std::string& name);
};

/// Adds the denoised beauty to a finished result. A picture that was cancelled, before or now, is
/// left as it is.
/// @throws mir::Error(device).
Denoising denoise_result(mir::RenderResult& result, const mir::Denoiser& denoiser,
                         mir::Monitor& monitor);

/// A sentence where the pixel filter of this name hides noise from denoisers; empty otherwise.
std::string filter_remark(const std::string& filter);

/// For programs.
nlohmann::ordered_json json_of(const Denoising& denoising);

/// For people, on stderr.
void print(const Denoising& denoising);

}  // namespace mirtool
