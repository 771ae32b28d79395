// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace mirtest {

/// The inverse of mir::deflate_radiance(), written from its description alone.
inline mir::Image<mir::Rgb> inflate_radiance(const std::vector<std::uint8_t>& file,
                                             mir::Extent extent) {
    const std::size_t n = extent.area();
    std::vector<std::uint8_t> planes(4 * n);
    uLongf bytes = static_cast<uLongf>(planes.size());
    if (uncompress(planes.data(), &bytes, file.data(), static_cast<uLong>(file.size())) != Z_OK ||
        bytes != planes.size())
        throw std::runtime_error("this is no code of an image of that size");
    std::vector<int> sum(n), red(n), green(n);
    mir::Image<mir::Rgb> image(extent);
    const std::size_t w = extent.width;
    for (std::size_t i = 0; i < n; ++i) {
        const auto expected = [&](const std::vector<int>& code) {
            if (i == 0) return 0;
            if (i < w) return code[i - 1];
            return i % w == 0 ? code[i - w] : (code[i - 1] + code[i - w]) / 2;
        };
        const int zigzag = planes[i] * 256 + planes[n + i];
        const int d = zigzag % 2 == 0 ? zigzag / 2 : -(zigzag + 1) / 2;
        sum[i] = (expected(sum) + d + 65536) % 65536;
        red[i] = (expected(red) + planes[2 * n + i]) % 256;
        green[i] = (expected(green) + planes[3 * n + i]) % 256;
        if (sum[i] == 0) continue;
        const auto total = static_cast<float>(std::exp2((sum[i] - 16384) / 64.0));
        const auto r = static_cast<float>(red[i]) / 255.0f;
        const auto g = static_cast<float>(green[i]) / 255.0f;
        image.pixels()[i] = {total * r, total * g, total * (1.0f - r - g)};
    }
    return image;
}

}  // namespace mirtest
