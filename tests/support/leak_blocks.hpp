// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/data/luxel.hpp"
#include "support/closed_rooms.hpp"
#include "support/packet_points.hpp"

#include <array>

namespace mirtest {

/// Segments of LeakSegments from one place, as packets and shafts are asked for them.
struct LeakBlock {
    static constexpr std::uint32_t size = mir::BlockMask::luxels;  ///< number of segments

    mir::Vec3 from{0};
    std::array<mir::Vec3, size> to{};

    /// Ends of packet g of sixteen.
    [[nodiscard]] mir::PointPacket packet(std::uint32_t g) const {
        mir::PointPacket points;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k)
            set_point(points, k, to[g * mir::PointPacket::width + k]);
        return points;
    }
    /// Luxels at the ends, turned to the place.
    [[nodiscard]] std::vector<mir::Hit> luxels() const {
        std::vector<mir::Hit> hits;
        for (const mir::Vec3 p : to) hits.push_back({p, glm::normalize(from - p)});
        return hits;
    }
};

/// Blocks of segments that must meet a closed surface. Of four in a row two lie past the edges of
/// one triangle, each run of 32 past one edge, so that shafts are thin; the third goes everywhere;
/// ends of the fourth lie where structures do not reach. The geometry must outlive them.
class LeakBlocks {
 public:
    LeakBlocks(const mir::WorldGeometry& geometry, mir::Vec3 centre, std::uint64_t index)
        : segments_(geometry, centre, index) {}

    /// From a place of its own.
    LeakBlock next() { return next_from(segments_.place()); }

    /// From one of place().
    LeakBlock next_from(mir::Vec3 from) {
        LeakBlock block{from};
        const std::uint32_t triangle = segments_.triangle();
        const float distance = segments_.distance();
        const std::uint64_t number = drawn_++;
        const auto draw = [&](std::uint32_t i) {
            if (is_far(number)) return segments_.next_from(from);
            if (number % 4 == 2) return segments_.next_near(from, segments_.distance());
            return segments_.next_past(from, triangle, i / 32 % 3, distance);
        };
        for (std::uint32_t i = 0; i < LeakBlock::size; ++i) block.to[i] = draw(i).to;
        return block;
    }

    /// True when ends of block number `i` lie out of reach.
    static constexpr bool is_far(std::uint64_t i) { return i % 4 == 3; }

    /// Where blocks may start.
    mir::Vec3 place() { return segments_.place(); }

 private:
    LeakSegments segments_;
    std::uint64_t drawn_ = 0;
};

}  // namespace mirtest
