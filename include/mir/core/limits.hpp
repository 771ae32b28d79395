// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace mir {

/// Upper bounds that are checked before memory is taken. Raise them knowingly.
struct Limits {
    std::uint64_t triangles = 200'000'000;         ///< after instancing
    std::uint64_t vertices = 400'000'000;          ///< after instancing
    std::uint64_t vpls = 4'000'000;                ///< geometric VPLs of one set
    std::uint64_t surfels = 16'000'000;            ///< discs of one scene
    std::uint64_t surfel_link_bytes = 4ull << 30;  ///< of the rays between discs
    std::uint64_t pixels = 1ull << 28;             ///< of one image
    std::uint64_t file_bytes = 4ull << 30;         ///< of one input file
    std::uint64_t visibility_bytes = 8ull << 30;   ///< of stored visibility, with its luxels
    /// Of the JSON of one glTF file, as far as something is read from it: numbers, texts and lists,
    /// and 4 or 24 more for what becomes a structure. One takes about 100 bytes at most, beside
    /// what a text holds.
    std::uint64_t json_values = 8'000'000;
    std::uint64_t mesh_bytes = 4ull << 30;  ///< of the stored meshes of one glTF file, estimated
    /// Files that a scene names may lie outside of its folder (`--allow-outside`). Without it
    /// buffers and libraries there are refused, and images count as missing: a scene from elsewhere
    /// could have any file of the machine read.
    bool allow_outside = false;
};

/// Product that saturates instead of wrapping.
constexpr std::uint64_t saturating_mul(std::uint64_t a, std::uint64_t b) {
    if (a != 0 && b > std::numeric_limits<std::uint64_t>::max() / a)
        return std::numeric_limits<std::uint64_t>::max();
    return a * b;
}

/// Stops before an allocation that the caller's limits forbid.
/// @throws Error(limit_exceeded) naming `what`, both numbers and the field of Limits to raise.
inline void check_limit(std::uint64_t wanted, std::uint64_t limit, const char* what,
                        Where at = Where::here()) {
    if (wanted <= limit) return;
    throw Error(ErrorCode::limit_exceeded,
                std::to_string(wanted) + " " + what + " were asked for, but Limits::" + what +
                    " allows " + std::to_string(limit) +
                    " (memory is bounded before it is taken); ask for less or raise the limit",
                at);
}

}  // namespace mir
