// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/shard_manifest.hpp"
#include "mir/runtime/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mir {

/// A picture that was put together, and what its shards say.
struct MergedPicture {
    RenderResult result;     ///< in every bit that of a whole render; without VPLs
    ShardManifest manifest;  ///< of the first shard
};

/// Puts shards together, in any order. `build` is that of the program, as in their manifests.
/// @throws Error(invalid_input) that names the shard which is damaged, incomplete, of another
///         version, build or picture, or there twice, or the shards that are missing. Error(io).
[[nodiscard]] MergedPicture merge_shards(const std::vector<std::filesystem::path>& shards,
                                         const std::string& build);

}  // namespace mir
