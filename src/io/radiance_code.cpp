// SPDX-License-Identifier: MIT
#include "mir/io/radiance_code.hpp"

#include "mir/core/error.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mir {

namespace detail {
namespace {

/// Pixel of a radiance code: logarithm of the sum of the channels, and shares. The shares are those
/// of red and green in it. A sum of 0 is black.
struct RadianceCode {
    std::uint16_t sum = 0;
    std::uint8_t red = 0;
    std::uint8_t green = 0;
};

RadianceCode radiance_code(Rgb pixel) {
    // Negative lobes of filters, and NaN.
    const auto positive = [](float x) { return x > 0.0f ? x : 0.0f; };
    const Rgb p{positive(pixel.r), positive(pixel.g), positive(pixel.b)};
    const double sum = static_cast<double>(p.r) + static_cast<double>(p.g) + p.b;
    if (!(sum > 0.0)) return {};
    const double code = std::round(64.0 * std::log2(sum)) + 16384.0;
    const auto share = [&](float x) {
        return static_cast<std::uint8_t>(std::lround(255.0 * static_cast<double>(x) / sum));
    };
    return {static_cast<std::uint16_t>(std::clamp(code, 1.0, 65535.0)), share(p.r), share(p.g)};
}

/// What neighbours let expect of a code. The mean of those to the left and above.
template <class Code>
int predicted_code(const Image<RadianceCode>& codes, std::uint32_t x, std::uint32_t y, Code code) {
    const int left = x > 0 ? codes(x - 1, y).*code : 0;
    const int above = y > 0 ? codes(x, y - 1).*code : 0;
    if (x == 0) return above;
    return y == 0 ? left : (left + above) / 2;
}

/// The four planes of deflate_radiance(), before compression.
std::vector<std::uint8_t> radiance_planes(const Image<Rgb>& image) {
    Image<RadianceCode> codes(image.extent());
    std::transform(image.pixels().begin(), image.pixels().end(), codes.pixels().begin(),
                   radiance_code);
    const std::size_t n = codes.pixels().size();
    std::vector<std::uint8_t> planes(4 * n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto x = static_cast<std::uint32_t>(i % image.width());
        const auto y = static_cast<std::uint32_t>(i / image.width());
        RadianceCode& code = codes.pixels()[i];
        const auto d =
            static_cast<std::int16_t>(code.sum - predicted_code(codes, x, y, &RadianceCode::sum));
        const auto zigzag = static_cast<std::uint16_t>(d < 0 ? -2 * d - 1 : 2 * d);
        const int red = predicted_code(codes, x, y, &RadianceCode::red);
        const int green = predicted_code(codes, x, y, &RadianceCode::green);
        // Black has no colour: that which costs nothing.
        if (code.sum == 0)
            code = {0, static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green)};
        planes[i] = static_cast<std::uint8_t>(zigzag >> 8);
        planes[n + i] = static_cast<std::uint8_t>(zigzag);
        planes[2 * n + i] = static_cast<std::uint8_t>(code.red - red);
        planes[3 * n + i] = static_cast<std::uint8_t>(code.green - green);
    }
    return planes;
}

}  // namespace
}  // namespace detail

std::vector<std::uint8_t> deflate_radiance(const Image<Rgb>& image) {
    const std::uint64_t pixels = image.extent().area();
    expects(pixels > 0 && pixels <= 1ull << 28,
            "an image to be coded must have 1 to 2^28 pixels; shrink it");
    const std::vector<std::uint8_t> planes = detail::radiance_planes(image);
    uLongf bytes = compressBound(static_cast<uLong>(planes.size()));
    std::vector<std::uint8_t> out(bytes);
    if (compress2(out.data(), &bytes, planes.data(), static_cast<uLong>(planes.size()),
                  Z_DEFAULT_COMPRESSION) != Z_OK)
        throw Error(ErrorCode::out_of_memory,
                    "an image cannot be compressed (zlib got no memory); shrink it");
    out.resize(bytes);
    return out;
}

}  // namespace mir
