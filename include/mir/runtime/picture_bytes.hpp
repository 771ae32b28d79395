// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/limits.hpp"
#include "mir/runtime/settings.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace mir {

/// Estimates the bytes that a picture takes while it is rendered. They are the sums of its film,
/// the images and guides of the result. `layers` are those of the film. The scene, the VPLs and the
/// luxels of one band come on top; the settings must be validated.
[[nodiscard]] inline std::uint64_t picture_bytes(const RenderSettings& settings,
                                                 std::size_t layers) {
    constexpr std::uint64_t film_sum = 8, color = 12, guides = 40, coverage = 4;
    const std::uint64_t pixel =
        film_sum * (1 + 3 * layers) + color * (layers + 1) + guides + coverage;
    return saturating_mul(settings.image.area(), pixel);
}

/// Stops before memory is taken for a picture that Limits::picture_bytes forbids.
/// @throws Error(limit_exceeded) with both figures.
inline void check_picture(const RenderSettings& settings, std::size_t layers) {
    const std::uint64_t bytes = picture_bytes(settings, layers);
    if (bytes <= settings.limits.picture_bytes) return;
    const auto gigabytes = [](std::uint64_t n) {
        const std::string tenths = std::to_string((n + 50'000'000) / 100'000'000);
        return (tenths.size() > 1 ? tenths.substr(0, tenths.size() - 1) : "0") + "." +
               tenths.back() + " GB";
    };
    throw Error(ErrorCode::limit_exceeded,
                "a picture of " + std::to_string(settings.image.width) + "x" +
                    std::to_string(settings.image.height) + " pixels and " +
                    std::to_string(layers) + " layers takes about " + gigabytes(bytes) +
                    " while it is rendered, but Limits::picture_bytes allows " +
                    gigabytes(settings.limits.picture_bytes) +
                    " (memory is bounded before it is taken); render fewer pixels, layers or "
                    "luxels per pixel, or raise the limit");
}

}  // namespace mir
