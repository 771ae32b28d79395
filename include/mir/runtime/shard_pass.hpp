// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/byte_hash.hpp"
#include "mir/runtime/mean_luminances.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/row_errors.hpp"

#include <cstdint>
#include <vector>

namespace mir {

/// Numbers of one pass of some rows of a picture, from which those of the picture are made.
struct ShardPass {
    RenderStatistics statistics;      ///< of the whole picture; mean luminances are not
    std::vector<RowLuminances> rows;  ///< of luxels, from top to bottom
    std::uint64_t shared = 0;         ///< fingerprint of what all shards must have alike

    /// Hands all of `self` to `archive`, which reads or, unless const, replaces it.
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
        archive(self.statistics, self.rows, self.shared);
    }
};

/// The numbers of a pass that made some rows.
inline ShardPass shard_pass(const RenderResult& pass) {
    const RenderStatistics& s = pass.statistics;
    ByteHash hash;
    hash.add(pass.vpls.vpls().data(), pass.vpls.vpls().size_bytes());
    for (const double number :
         {s.path_luminance, s.dropped_share, s.states, double{s.bound}, s.vsl_radius,
          double{s.emitted_power}, s.direct_noise.value_or(0.0), s.removed ? s.removed->share : 0.0,
          s.cut ? s.cut->share : 0.0, s.gather_difference ? s.gather_difference->mean : 0.0})
        hash.add(&number, sizeof number);
    hash.add(s.backend.data(), s.backend.size());
    // All other structures give the same bits.
    const bool embree = s.acceleration == "embree";
    hash.add(&embree, sizeof embree);
    return {s, pass.luminances, hash.value()};
}

/// Numbers of a pass of the whole picture, from those of its shards in their order. Seconds are
/// those of all shards together.
inline RenderStatistics merged(const std::vector<const ShardPass*>& shards) {
    RenderStatistics all = shards.front()->statistics;
    clear_rows(all);
    all.seconds = {};
    std::vector<RowLuminances> rows;
    for (const ShardPass* const shard : shards) {
        for (const RowLuminances& row : shard->rows) add_row(all, row);
        rows.insert(rows.end(), shard->rows.begin(), shard->rows.end());
        add_seconds(all.seconds, shard->statistics.seconds);
    }
    keep_row_errors(all, rows);
    return all;
}

}  // namespace mir
