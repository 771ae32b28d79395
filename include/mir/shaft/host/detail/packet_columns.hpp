// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_lanes.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace mir::detail {

static_assert(BlockMask::packets == lane_count);

/// The luxels of a block, a packet per lane. Those at the same place of all packets side by side.
/// What packets come to is found for sixteen of them at once, and what blocks come to from that.
class PacketColumns {
 public:
    static constexpr std::uint32_t packets = BlockMask::packets;  ///< of a block

    /// Of the first 256 luxels of `hits`.
    explicit PacketColumns(const SoaView<const Hit>& hits) {
        for (std::uint32_t g = 0; g < packets; ++g)
            for (std::uint32_t k = 0; k < size; ++k) {
                const Hit hit = hits.load(g * size + k);
                column_[k].position[0].at[g] = hit.position.x;
                column_[k].position[1].at[g] = hit.position.y;
                column_[k].position[2].at[g] = hit.position.z;
                column_[k].normal[0].at[g] = hit.normal.x;
                column_[k].normal[1].at[g] = hit.normal.y;
                column_[k].normal[2].at[g] = hit.normal.z;
            }
    }

    /// Of each packet, numbers that are none left out of its box.
    [[nodiscard]] std::array<ClusterSum, packets> sums() const {
        Columns low = all_of(infinity);
        Columns high = all_of(-infinity);
        Columns normals = all_of(0.0f);
        LaneFloats luxels{};
        for (const Column& c : column_) {
            for (std::uint32_t g = 0; g < packets; ++g) luxels.at[g] += c.is_used(g) ? 1.0f : 0.0f;
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::uint32_t g = 0; g < packets; ++g) {
                    const float p = c.position[axis].at[g];
                    const bool is_used = c.is_used(g);
                    low[axis].at[g] = smaller(is_used ? p : infinity, low[axis].at[g]);
                    high[axis].at[g] = larger(is_used ? p : -infinity, high[axis].at[g]);
                    normals[axis].at[g] += c.normal[axis].at[g];
                }
        }
        std::array<ClusterSum, packets> sums;
        for (std::uint32_t g = 0; g < packets; ++g)
            sums[g] = {vector(low, g), vector(high, g), vector(normals, g),
                       static_cast<std::uint32_t>(luxels.at[g])};
        return sums;
    }

    /// Least value of a row for each packet at its luxels. Infinite where all are empty.
    [[nodiscard]] LaneFloats least_at(const LaneRows& rows) const {
        LaneFloats least = all_of(infinity)[0];
        for (const Column& c : column_)
            for (std::uint32_t g = 0; g < packets; ++g) {
                const float value = row_at(rows.row(g), vector(c.position, g));
                least.at[g] = smaller(c.is_used(g) ? value : infinity, least.at[g]);
            }
        return least;
    }

 private:
    static constexpr std::uint32_t size = PointPacket::width;
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    using Columns = std::array<LaneFloats, 3>;  ///< by axis

    struct Column {
        Columns position;
        Columns normal;

        [[nodiscard]] bool is_used(std::uint32_t g) const {
            return !is_empty(Hit{Vec3(0.0f), vector(normal, g)});
        }
    };

    [[nodiscard]] static Vec3 vector(const Columns& columns, std::uint32_t g) {
        return {columns[0].at[g], columns[1].at[g], columns[2].at[g]};
    }
    [[nodiscard]] static Columns all_of(float value) {
        Columns columns;
        for (LaneFloats& lanes : columns) std::fill_n(lanes.at, packets, value);
        return columns;
    }

    std::array<Column, size> column_;
};

}  // namespace mir::detail
