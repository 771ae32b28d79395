// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace mir {
namespace detail {

inline std::string size_text(Extent e) {
    return std::to_string(e.width) + "x" + std::to_string(e.height);
}

/// @throws Error(invalid_input) that tells how many pixels are not numbers and where the first is.
inline void check_finite(const Image<Rgb>& image, const std::string& name) {
    std::size_t bad = 0;
    std::size_t first = 0;
    for (std::size_t i = image.pixels().size(); i-- > 0;) {
        if (is_finite(image.pixels()[i])) continue;
        ++bad;
        first = i;
    }
    if (bad == 0) return;
    throw Error(ErrorCode::invalid_input,
                name + ": " + std::to_string(bad) + " of " + std::to_string(image.pixels().size()) +
                    " pixels are NaN or infinite, the first at (" +
                    std::to_string(first % image.width()) + ", " +
                    std::to_string(first / image.width()) +
                    ") (no metric is defined there); render the picture again");
}

}  // namespace detail

/// Makes sure that two images can be compared. Equal size, at least one pixel, finite numbers.
/// Pixels are counted from 0 at the top left.
/// @throws Error(invalid_input) that calls the images by the names given.
inline void check_comparable(const Image<Rgb>& image, const Image<Rgb>& reference,
                             const std::string& name = "the image",
                             const std::string& reference_name = "the reference") {
    if (image.extent() != reference.extent())
        throw Error(ErrorCode::invalid_input,
                    name + " has " + detail::size_text(image.extent()) + " pixels and " +
                        reference_name + " has " + detail::size_text(reference.extent()) +
                        " (pixels are compared one by one); give pictures of one size");
    if (image.extent().area() == 0)
        throw Error(ErrorCode::invalid_input,
                    name + " has no pixels (there is nothing to compare); render it first");
    detail::check_finite(image, name);
    detail::check_finite(reference, reference_name);
}

}  // namespace mir
