// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/device/facing_bounds.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

namespace mir {

/// What FacingPass knows of a block of 256 luxels.
struct FacingRecord {
    /// Words of visibility of a block and a VPL.
    static constexpr std::uint32_t words = block_luxels / cluster_luxels;

    FacingBounds bounds;               ///< of all luxels
    std::uint32_t luxels[words] = {};  ///< a word for each 32: those that are not empty
};

/// The records of all blocks: kernel for groups, a block each.
struct FacingRecords {
    /// Groups need no memory.
    struct Workspace {};

    SoaView<const Hit> hits;          ///< whole blocks
    FacingRecord* records = nullptr;  ///< one for each block

    /// Groups that make all records.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t luxels) {
        return luxels / block_luxels;
    }

    /// Block `i`.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        FacingRecord record{facing_bounds(group, hits, i * block_luxels, block_luxels), {}};
        for (std::uint32_t c = 0; c < FacingRecord::words; ++c)
            record.luxels[c] = group.ballot([&](std::uint32_t lane) {
                return !is_empty(hits.load(i * block_luxels + c * cluster_luxels + lane));
            });
        group.each([&](std::uint32_t lane) {
            if (lane == 0) records[i] = record;
        });
    }
};

}  // namespace mir
