// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <cstdint>
#include <vector>

namespace mir {
/// Radiance in few bytes, for readers such as web pages. It is zlib's format of four planes of one
/// byte per pixel, rows from the top. Per pixel, S = R + G + B is coded as s = round(64 log2 S) +
/// 16384 (steps of 1.09 %; 0 is black), the shares of red and green as round(255 R / S) and
/// round(255 G / S). Stored is what remains after the prediction by (left + above) / 2, rounded
/// down, or by the one that exists in the first row and column, or 0: of s as zigzag code 2d or -2d
/// - 1 modulo 2^16, high bytes in the first plane and low ones in the second; of the shares modulo
/// 256 in the third and fourth, 0 where the pixel is black. Negative values and NaN count as 0.
/// Equal images give equal bytes with one version of zlib. Thread-safe.
/// @throws Error(invalid_argument) for an empty image or one of more than 2^28 pixels;
///         Error(out_of_memory).
std::vector<std::uint8_t> deflate_radiance(const Image<Rgb>& image);

}  // namespace mir
