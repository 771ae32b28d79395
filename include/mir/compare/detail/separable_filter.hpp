// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/image.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mir::detail {

/// Weights at -radius .. radius; their number is odd.
using FilterWeights = std::vector<float>;

/// Adds `weight` times a row to another. Taps outside, pixels inside: compilers vectorise this.
inline void add_row(float* to, const float* from, float weight, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) to[i] += weight * from[i];
}

/// Row `y`, its ends repeated `radius` times.
inline std::vector<float> padded_row(const Image<float>& image, std::uint32_t y,
                                     std::size_t radius) {
    const float* row = &image(0, y);
    std::vector<float> padded(radius, row[0]);
    padded.insert(padded.end(), row, row + image.width());
    padded.insert(padded.end(), radius, row[image.width() - 1]);
    return padded;
}

template <Executor E>
Image<float> filtered_across(const Image<float>& in, const FilterWeights& weights, E& executor) {
    Image<float> out(in.extent());
    executor.for_each(in.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        const std::vector<float> padded = padded_row(in, y, weights.size() / 2);
        for (std::size_t k = 0; k < weights.size(); ++k)
            add_row(&out(0, y), padded.data() + k, weights[k], in.width());
    });
    return out;
}

template <Executor E>
Image<float> filtered_down(const Image<float>& in, const FilterWeights& weights, E& executor) {
    Image<float> out(in.extent());
    executor.for_each(in.height(), [&](std::size_t row) {
        const auto radius = static_cast<std::ptrdiff_t>(weights.size() / 2);
        const auto last = static_cast<std::ptrdiff_t>(in.height()) - 1;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const std::ptrdiff_t y = static_cast<std::ptrdiff_t>(row + k) - radius;
            const auto from = static_cast<std::uint32_t>(std::clamp<std::ptrdiff_t>(y, 0, last));
            add_row(&out(0, static_cast<std::uint32_t>(row)), &in(0, from), weights[k], in.width());
        }
    });
    return out;
}

/// Correlation with across(x) * down(y). Beyond its border the image goes on with its last pixel.
template <Executor E>
Image<float> filtered(const Image<float>& in, const FilterWeights& across,
                      const FilterWeights& down, E& executor) {
    return filtered_down(filtered_across(in, across, executor), down, executor);
}

}  // namespace mir::detail
