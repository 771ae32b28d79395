// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/extent.hpp"
#include "mir/runtime/shard_number.hpp"
#include "mir/scene/scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mir {

/// What a shard says of itself. A merge compares it with that of the others.
struct ShardManifest {
    std::string version;               ///< of the library that made it
    std::string build;                 ///< of the program that did
    std::string scene_hash;            ///< SceneHash::hex()
    std::uint64_t settings_hash = 0;   ///< SettingsHash of the whole picture
    Extent image;                      ///< whole, pixels
    std::uint32_t passes = 1;          ///< of the picture
    ShardNumber shard;                 ///< which part of it
    std::string look;                  ///< how the program is to write the picture; all have one
    std::vector<std::string> recipe;   ///< of the program, by which it writes the picture
    std::vector<std::string> remarks;  ///< warnings of the program, before those of the picture

    /// Rows of pixels that it holds.
    [[nodiscard]] PixelRows rows() const { return rows_of(shard, image.height); }

    /// Hands all of `self` to `archive`, which reads or, unless const, replaces it.
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
        archive(self.version, self.build, self.scene_hash, self.settings_hash, self.image,
                self.passes, self.shard, self.look, self.recipe, self.remarks);
    }
};

/// That of a part of a picture with these settings, and what the library knows of it.
/// @throws Error(invalid_argument) for a shard that the picture does not have.
[[nodiscard]] ShardManifest shard_manifest(const Scene& scene, const RenderSettings& settings,
                                           std::uint32_t passes, ShardNumber shard);

}  // namespace mir
