// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mir {

/// A picture for textures: `texels` in rows from the top, 8 bits a channel. Each is red + green 2^8
/// + blue 2^16 + alpha 2^24. What the codes mean is up to who looks them up.
struct TextureImage {
    std::string name;                   ///< for messages and files
    std::uint32_t width = 0;            ///< columns, 1 to 65536
    std::uint32_t height = 0;           ///< rows, 1 to 65536
    std::vector<std::uint32_t> texels;  ///< width x height
};

/// What the colours of a texel stand for. Alpha is linear in either case.
enum class TexelEncoding : std::uint8_t { linear, srgb };

/// Linear value of an sRGB code, both in [0, 1]. Source: IEC 61966-2-1.
inline float srgb_to_linear(double code) {
    return static_cast<float>(code <= 0.04045 ? code / 12.92
                                              : std::pow((code + 0.055) / 1.055, 2.4));
}

/// Code `k` of one channel in [0, 1]. Linear at element k, sRGB at 256 + k. Kernels read it as an
/// array, so that powers have the same bits everywhere.
inline const std::array<float, 512>& texel_values() {
    static const std::array<float, 512> values = [] {
        std::array<float, 512> v{};
        for (std::size_t k = 0; k < 256; ++k) {
            const double code = static_cast<double>(k) / 255.0;
            v[k] = static_cast<float>(code);
            v[256 + k] = srgb_to_linear(code);
        }
        return v;
    }();
    return values;
}

/// Mean colour of an image, 0..1; black for one without texels.
inline Rgb mean_of(const TextureImage& image, TexelEncoding encoding) {
    const float* values = texel_values().data() + (encoding == TexelEncoding::srgb ? 256 : 0);
    double sum[3] = {};
    for (const std::uint32_t texel : image.texels)
        for (std::uint32_t k = 0; k < 3; ++k) sum[k] += double{values[texel >> 8 * k & 0xff]};
    const double n = image.texels.empty() ? 1.0 : static_cast<double>(image.texels.size());
    return {static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n),
            static_cast<float>(sum[2] / n)};
}
/// Mean alpha of an image, 0..1.
inline float mean_alpha_of(const TextureImage& image) {
    double sum = 0.0;
    for (const std::uint32_t texel : image.texels) sum += static_cast<double>(texel >> 24) / 255.0;
    return image.texels.empty()
               ? 0.0f
               : static_cast<float>(sum / static_cast<double>(image.texels.size()));
}

}  // namespace mir
