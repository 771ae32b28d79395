// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// Upper bounds that are checked before memory is taken. Raise them knowingly.
struct Limits {
    std::uint64_t triangles = 200'000'000;         ///< after instancing
    std::uint64_t vertices = 400'000'000;          ///< after instancing
    std::uint64_t vpls = 4'000'000;                ///< geometric VPLs of one set
    std::uint64_t vpl_tree_bytes = 4ull << 30;     ///< of the trees over one set, while they grow
    std::uint64_t surfels = 16'000'000;            ///< discs of one scene
    std::uint64_t surfel_link_bytes = 4ull << 30;  ///< of the rays between discs
    std::uint64_t pixels = 1ull << 28;             ///< of one image
    std::uint64_t picture_bytes = 32ull << 30;     ///< of one render's picture, see picture_bytes()
    std::uint64_t file_bytes = 4ull << 30;         ///< of one input file
    std::uint64_t visibility_bytes = 8ull << 30;   ///< of stored visibility, with its luxels
    /// Of the JSON of one glTF file, as far as something is read from it. Numbers, texts and lists,
    /// and 4 or 24 more for what becomes a structure. One takes about 100 bytes at most, beside
    /// what a text holds.
    std::uint64_t json_values = 8'000'000;
    std::uint64_t mesh_bytes = 4ull << 30;  ///< of the stored meshes of one glTF file, estimated
    /// Files that a scene names may lie outside of its folder (`--allow-outside`). Without it
    /// buffers and libraries there are refused, and images count as missing: a scene from elsewhere
    /// could have any file of the machine read.
    bool allow_outside = false;
};

}  // namespace mir
