// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/exr_attributes.hpp"
#include "mir/core/limits.hpp"

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

/// Bytes of a chunk that are taken for any file. Writers code a flat row of many pixels in few
/// bytes, and OpenEXR reads it into a chunk of many rows.
inline constexpr std::uint64_t exr_free_chunk = 64ull << 20;

/// Rows that a file of scan lines compresses together.
inline std::uint64_t exr_rows_of_chunk(Imf::Compression method) {
    if (method <= Imf::ZIPS_COMPRESSION) return 1;
    if (method == Imf::ZIP_COMPRESSION || method == Imf::PXR24_COMPRESSION) return 16;
    return method == Imf::DWAB_COMPRESSION ? 256 : 32;
}

/// How a file is cut into parts that are compressed by themselves. They are those of the largest
/// level if there are several. Each has a place in a table.
struct ExrChunks {
    std::uint64_t count;
    std::uint64_t pixels;  ///< of a whole one, or a row of tiles, beyond the image's edge too
};

inline ExrChunks exr_chunks(const Imf::Header& header, bool tiled, std::uint64_t width,
                            std::uint64_t height) {
    std::uint64_t x = width;
    std::uint64_t y = 0;
    if (tiled) {
        x = header.tileDescription().xSize;
        y = header.tileDescription().ySize;
    } else {
        y = exr_rows_of_chunk(header.compression());
    }
    return {((width + x - 1) / x) * ((height + y - 1) / y), saturating_mul(std::max(x, width), y)};
}

/// @pre `header` passed its sanityCheck(tiled), `tiled` is the flag of the file's version (a file
/// of
///      scan lines may have a description of tiles, which nobody checks), width and height are
///      those of its data window.
/// @throws Error(invalid_input) when a file of `file_bytes` cannot hold the pixels, a chunk larger
///         than exr_free_chunk, or the table of places of the chunks.
inline void check_exr_sizes(const Imf::Header& header, bool tiled, std::uint64_t width,
                            std::uint64_t height, const std::filesystem::path& path,
                            std::uint64_t file_bytes) {
    // As floats, which a row of tiles is kept as.
    std::uint64_t bytes_of_pixel = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) bytes_of_pixel += 4;
    const ExrChunks chunks = exr_chunks(header, tiled, width, height);
    const std::uint64_t bytes = saturating_mul(width * height, bytes_of_pixel);
    const std::uint64_t chunk_bytes = saturating_mul(chunks.pixels, bytes_of_pixel);
    const std::uint64_t can_hold = saturating_mul(file_bytes, exr_expansion(header.compression()));
    if (bytes > can_hold || chunk_bytes > std::max(can_hold, exr_free_chunk) ||
        chunks.count > file_bytes / 8)
        cannot_read(path,
                    "it announces " + std::to_string(bytes) + " bytes of pixels in " +
                        std::to_string(chunks.count) + " parts of " + std::to_string(chunk_bytes) +
                        " bytes, which " + std::to_string(file_bytes) + " bytes cannot hold",
                    "write it again");
}

}  // namespace mir::detail
