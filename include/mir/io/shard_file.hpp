// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/shard_manifest.hpp"
#include "mir/runtime/pass_sums.hpp"
#include "mir/runtime/shard_pass.hpp"

#include <filesystem>
#include <vector>

namespace mir {

/// What a shard holds: the passes done of some rows of a picture.
struct ShardPasses {
    PassSums sums;                  ///< pixels of other rows are black
    std::vector<ShardPass> passes;  ///< numbers of each pass
};

/// The file in which a job keeps its part of a picture. Another process can go on from the passes
/// in it; merge_shards() makes the picture of all parts. Good on machines of one kind. Nothing in
/// it is trusted that its hash does not confirm; it is no protection against forgery. Several
/// processes may write one file: each replaces it as a whole.
class ShardFile {
 public:
    /// Makes sure that `path` can be written.
    /// @throws Error(io).
    ShardFile(std::filesystem::path path, ShardManifest manifest);

    /// The passes in the file; none where there is no file.
    /// @throws Error(invalid_input) for a file that is damaged or another shard's.
    [[nodiscard]] ShardPasses read() const;

    /// Replaces the file as a whole.
    /// @throws Error(io) when it cannot be written; an older one stays as it was.
    void write(const PassSums& sums, const std::vector<ShardPass>& passes) const;

 private:
    std::filesystem::path path_;
    ShardManifest manifest_;
};

}  // namespace mir
