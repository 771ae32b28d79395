// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"
#include "mir/io/tone_curve.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mir {

/// Exposure in stops (EV) that maps the 90th percentile of luminance to 0.8. Multiply radiance by
/// 2^EV. Where more than 90 % of the pixels are black, the percentile of the others. 0 when all are
/// black. Pixels that are not finite are left out.
[[nodiscard]] float auto_exposure(const Image<Rgb>& linear);

/// 8-bit sRGB code of a linear value, clamped to [0, 1]. The curve of IEC 61966-2-1 is rounded down
/// after `rounding` was added: 0.5 for the nearest code, a random number of [0, 1) for codes whose
/// mean is exact. NaN gives 0.
[[nodiscard]] std::uint8_t to_srgb8(float linear, float rounding = 0.5f);

/// How a preview shows radiance.
struct PreviewLook {
    float exposure_ev = 0.0f;          ///< radiance is multiplied by 2 to this power
    ToneCurve tone = ToneCurve::none;  ///< what becomes of the product
    bool dithered = false;             ///< codes are rounded by a pattern: no bands in dark slopes
};

namespace detail {

/// PNG file of 8-bit sRGB, for the file at `path`.
std::vector<std::uint8_t> encode_png(const Image<Rgb>& linear, const PreviewLook& look,
                                     const std::filesystem::path& path);

}  // namespace detail

/// Writes an 8-bit sRGB preview with an sRGB chunk, as `look` says. The only place of the library
/// that clamps. Equal input gives equal bytes; the file replaces an older one only when complete.
/// @throws Error(io) when the file cannot be written, Error(invalid_argument) for an empty image or
///         one that is beyond 10^6 pixels a side or 2^28 in all.
void write_png(const std::filesystem::path& path, const Image<Rgb>& linear,
               const PreviewLook& look);

/// The same with a film's curve, dithered, at the exposure that suits it (tone_exposure()).
/// @throws what the other throws.
void write_png(const std::filesystem::path& path, const Image<Rgb>& linear);

}  // namespace mir
