// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace mir {

/// image - reference, each channel with its sign.
/// @throws Error(invalid_argument) when the sizes differ.
inline Image<Rgb> difference(const Image<Rgb>& image, const Image<Rgb>& reference) {
    expects(image.extent() == reference.extent(),
            "the difference of images of two sizes was asked for (pixels are subtracted one by "
            "one); give images of one size");
    Image<Rgb> out(image.extent());
    for (std::size_t i = 0; i < out.pixels().size(); ++i)
        out.pixels()[i] = image.pixels()[i] - reference.pixels()[i];
    return out;
}

/// The size of luminance that a picture of `errors` shows in full colour. The 99th percentile of
/// the errors' absolute luminance among those that are not zero, so that a few outliers do not hide
/// the rest; 0 when all are zero.
inline float error_range(const Image<Rgb>& errors) {
    std::vector<float> sizes;
    for (const Rgb& e : errors.pixels())
        if (const float y = std::fabs(luminance(e)); y > 0.0f) sizes.push_back(y);
    if (sizes.empty()) return 0.0f;
    const auto nth = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 99 / 100);
    std::nth_element(sizes.begin(), nth, sizes.end());
    return *nth;
}

namespace detail {

inline Rgb mixed(Rgb a, Rgb b, float t) { return (1.0f - t) * a + t * b; }

/// Linear light of magma, the colour map of FLIP's authors (S. van der Walt and N. Smith, CC0), by
/// nine of its colours; t in [0, 1].
inline Rgb magma(float t) {
    static constexpr std::array<Rgb, 9> stops{{{0.00011f, 0.00004f, 0.00107f},
                                               {0.01218f, 0.00548f, 0.06227f},
                                               {0.08176f, 0.00618f, 0.20076f},
                                               {0.22611f, 0.01919f, 0.22119f},
                                               {0.47168f, 0.03797f, 0.19188f},
                                               {0.79591f, 0.08333f, 0.12471f},
                                               {0.97001f, 0.24847f, 0.12074f},
                                               {0.99296f, 0.55356f, 0.24777f},
                                               {0.97080f, 0.98063f, 0.52175f}}};
    const float place = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    return mixed(stops[i], stops[i + 1], place - static_cast<float>(i));
}

}  // namespace detail

/// Picture of signed errors in linear light. Grey where image and reference agree, towards red
/// where the image is brighter in luminance, towards blue where it is darker, in full colour from
/// `range` on. A range of 0 shows the sign alone.
inline Image<Rgb> signed_error_picture(const Image<Rgb>& errors, float range) {
    constexpr Rgb none{0.60f, 0.60f, 0.60f};
    constexpr Rgb brighter{0.60f, 0.01f, 0.01f};
    constexpr Rgb darker{0.01f, 0.06f, 0.60f};
    Image<Rgb> picture(errors.extent());
    std::transform(errors.pixels().begin(), errors.pixels().end(), picture.pixels().begin(),
                   [&](Rgb e) {
                       const float y = luminance(e);
                       const float size = std::fabs(y);
                       const float t = size < range ? size / range : (size > 0.0f ? 1.0f : 0.0f);
                       return detail::mixed(none, y > 0.0f ? brighter : darker, t);
                   });
    return picture;
}

/// Picture of a FLIP map in linear light. Black for 0, over violet and orange to pale yellow for 1.
inline Image<Rgb> flip_picture(const Image<float>& errors) {
    Image<Rgb> picture(errors.extent());
    std::transform(errors.pixels().begin(), errors.pixels().end(), picture.pixels().begin(),
                   detail::magma);
    return picture;
}

}  // namespace mir
