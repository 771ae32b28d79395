// SPDX-License-Identifier: MIT
#include "mir/io/png.hpp"

#include "mir/core/error.hpp"
#include "mir/io/detail/shown_path.hpp"
#include "mir/io/write_file.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace mir {

namespace detail {
namespace {

/// Values of [0, 1) that neighbours spread evenly. Source: Jimenez, "Next generation post
/// processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014 course notes.
float gradient_noise(std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
    const double at = 0.06711056 * (x + 47.0 * channel) + 0.00583715 * (y + 17.0 * channel);
    const double turned = 52.9829189 * (at - std::floor(at));
    return std::min(static_cast<float>(turned - std::floor(turned)), 0x1.fffffep-1f);
}

/// Codes of one picture, row by row.
std::vector<std::uint8_t> srgb_codes(const Image<Rgb>& linear, const PreviewLook& look) {
    const float scale = std::exp2(look.exposure_ev);
    std::vector<std::uint8_t> codes;
    codes.reserve(linear.pixels().size() * 3);
    for (std::uint32_t y = 0; y < linear.height(); ++y)
        for (std::uint32_t x = 0; x < linear.width(); ++x) {
            const Rgb shown = toned(linear(x, y) * scale, look.tone);
            const std::array<float, 3> channels{shown.r, shown.g, shown.b};
            for (std::uint32_t c = 0; c < 3; ++c)
                codes.push_back(
                    to_srgb8(channels[c], look.dithered ? gradient_noise(x, y, c) : 0.5f));
        }
    return codes;
}

}  // namespace

// libpng's simplified interface keeps its longjmp to itself, so that no C++ frame is ever jumped
// over.
std::vector<std::uint8_t> encode_png(const Image<Rgb>& linear, const PreviewLook& look,
                                     const std::filesystem::path& path) {
    const std::vector<std::uint8_t> codes = srgb_codes(linear, look);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = linear.width();
    image.height = linear.height();
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;  // a fifth of the time for half as many bytes again
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::uint8_t> file(bytes);
    if (png_image_write_to_memory(&image, file.data(), &bytes, 0, codes.data(), 0, nullptr) == 0)
        throw Error(ErrorCode::io, detail::shown_path(path) +
                                       ": the picture cannot be compressed (" + image.message +
                                       "); ask for a smaller one");
    file.resize(bytes);
    return file;
}

}  // namespace detail

float auto_exposure(const Image<Rgb>& linear) {
    std::vector<float> values;
    values.reserve(linear.pixels().size());
    for (const Rgb& pixel : linear.pixels())
        if (const float y = luminance(pixel); std::isfinite(y)) values.push_back(y);
    const auto percentile = [&values] {
        if (values.empty()) return 0.0f;
        const std::size_t at = (values.size() - 1) * 9 / 10;
        const auto nth = values.begin() + static_cast<std::ptrdiff_t>(at);
        std::nth_element(values.begin(), nth, values.end());
        return *nth;
    };
    float bright = percentile();
    if (bright <= 0.0f) {
        values.erase(std::remove_if(values.begin(), values.end(), [](float y) { return y <= 0; }),
                     values.end());
        bright = percentile();
    }
    return bright > 0.0f ? std::log2(0.8f / bright) : 0.0f;
}

std::uint8_t to_srgb8(float linear, float rounding) {
    if (!(linear > 0.0f)) return 0;
    if (linear >= 1.0f) return 255;
    const float coded =
        linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(coded * 255.0f + rounding);
}

void write_png(const std::filesystem::path& path, const Image<Rgb>& linear,
               const PreviewLook& look) {
    constexpr std::uint32_t most = 1'000'000;  // libpng's own bound
    constexpr std::uint64_t most_pixels = 1ull << 28;
    const Extent extent = linear.extent();
    expects(extent.area() > 0 && extent.area() <= most_pixels && extent.width <= most &&
                extent.height <= most,
            "this image has no preview (a PNG has 1 to 1000000 pixels a side and 2^28 in all); "
            "write OpenEXR");
    const std::vector<std::uint8_t> file = detail::encode_png(linear, look, path);
    detail::write_file(path, {reinterpret_cast<const char*>(file.data()), file.size()},
                       "the preview");
}

void write_png(const std::filesystem::path& path, const Image<Rgb>& linear) {
    write_png(path, linear, {tone_exposure(linear), ToneCurve::agx, true});
}

}  // namespace mir
