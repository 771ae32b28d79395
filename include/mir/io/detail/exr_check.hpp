// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/io/detail/exr_attributes.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

namespace mir::detail {

// OpenEXR takes memory for what a header announces before it has read anything of it. What the
// bytes of the file cannot hold is refused here.

/// Bytes that one byte of the file can become at most. Deflate makes 1032 of one and the other
/// methods do less, or little more; DWA codes runs of equal blocks before deflating them.
inline std::uint64_t exr_expansion(Imf::Compression method) {
    const bool dwa = method == Imf::DWAA_COMPRESSION || method == Imf::DWAB_COMPRESSION;
    return dwa ? 1u << 17 : 4096;
}

/// Parts of the file that are compressed by themselves: those of the largest level, if there are
/// several. Each has a place in a table.
inline std::uint64_t exr_chunks(const Imf::Header& header, bool tiled, std::uint64_t width,
                                std::uint64_t height) {
    if (tiled) {
        const std::uint64_t x = header.tileDescription().xSize;
        const std::uint64_t y = header.tileDescription().ySize;
        return ((width + x - 1) / x) * ((height + y - 1) / y);
    }
    const Imf::Compression method = header.compression();
    std::uint64_t lines = 32;
    if (method <= Imf::ZIPS_COMPRESSION) lines = 1;
    if (method == Imf::ZIP_COMPRESSION || method == Imf::PXR24_COMPRESSION) lines = 16;
    if (method == Imf::DWAB_COMPRESSION) lines = 256;
    return (height + lines - 1) / lines;
}

/// @pre `header` passed its sanityCheck(tiled), `tiled` is the flag of the file's version (a file
/// of
///      scan lines may have a description of tiles, which nobody checks), width and height are
///      those of its data window.
/// @throws Error(invalid_input) when a file of `file_bytes` cannot hold the pixels, or the table of
///         places of their chunks.
inline void check_exr_sizes(const Imf::Header& header, bool tiled, std::uint64_t width,
                            std::uint64_t height, const std::filesystem::path& path,
                            std::uint64_t file_bytes) {
    std::uint64_t bytes_of_pixel = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        bytes_of_pixel += c.channel().type == Imf::HALF ? 2 : 4;
    std::uint64_t area = width * height;
    if (tiled) {
        const Imf::TileDescription& tile = header.tileDescription();
        area = std::max(area, saturating_mul(tile.xSize, tile.ySize));
    }
    const std::uint64_t bytes = saturating_mul(area, bytes_of_pixel);
    const std::uint64_t chunks = exr_chunks(header, tiled, width, height);
    if (bytes / exr_expansion(header.compression()) > file_bytes || chunks > file_bytes / 8)
        cannot_read(path,
                    "it announces " + std::to_string(bytes) + " bytes of pixels in " +
                        std::to_string(chunks) + " parts, which " + std::to_string(file_bytes) +
                        " bytes cannot hold",
                    "write it again");
}

}  // namespace mir::detail
