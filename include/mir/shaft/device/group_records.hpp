// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

#include <limits>

namespace mir {

/// Records of all blocks of 256 luxels and all clusters of 32. They are those of cluster_record()
/// except for the order in which normals are summed: kernel for groups, a run of luxels each, which
/// neighbouring lanes read side by side. Luxels beyond the last one are padding, that is empty, and
/// are there to be read.
struct GroupRecords {
    /// Groups need no memory.
    struct Workspace {};

    SoaView<const Hit> hits;            ///< in cluster order, whole blocks
    float sigma = 0.0f;                 ///< of the scene, metres
    ClusterRecord* blocks = nullptr;    ///< one for each block
    ClusterRecord* clusters = nullptr;  ///< one for each cluster

    /// Groups that make all records.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t luxels) {
        return luxels / block_luxels + luxels / cluster_luxels;
    }

    /// Group `i` < groups(): a block or, behind the last one, a cluster. What takes longest is
    /// first.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        const std::uint32_t block_count = hits.stride / block_luxels;
        const bool is_block = i < block_count;
        const std::uint32_t k = is_block ? i : i - block_count;
        const Run run = is_block ? Run{k * block_luxels, block_luxels}
                                 : Run{k * cluster_luxels, cluster_luxels};
        const ClusterRecord record = record_of(group, run);
        group.each([&](std::uint32_t lane) {
            if (lane == 0) (is_block ? blocks : clusters)[k] = record;
        });
    }

 private:
    /// Luxels one behind the other, a multiple of 32.
    struct Run {
        std::uint32_t first;
        std::uint32_t count;
    };

    [[nodiscard]] MIR_HD ClusterRecord record_of(const LaneGroup& group, Run run) const {
        const detail::ClusterSum sum = sum_of(group, run);
        ClusterRecord cluster;
        if (sum.luxels == 0) return cluster;
        cluster.low = sum.low - sigma;
        cluster.high = sum.high + sigma;
        cluster.luxels = sum.luxels;
        cluster.front = detail::direction_row(sum.normals);
        const TiltedAxis tilt = detail::tilted_axis(cluster.front);
        const Ranges ranges = ranges_of(group, run, cluster.front, tilt);
        cluster.front.w = strict::sub(2.0f * sigma, ranges.front);
        detail::set_tilt(cluster, tilt, ranges.along.low, ranges.along.high, sigma);
        return cluster;
    }

    static constexpr float infinity = std::numeric_limits<float>::infinity();

    using Floats = LaneGroup::PerLane<float>;

    /// Luxels that are no number face nothing; comparing with one would lose those before it.
    MIR_HD static bool is_number(const Hit& hit) {
        const Vec3 p = hit.position;
        return fabsf(p.x) >= 0.0f && fabsf(p.y) >= 0.0f && fabsf(p.z) >= 0.0f;
    }

    MIR_HD static float total(const LaneGroup& group, Floats values) {
        return group.combined(values, [](float a, float b) { return strict::add(a, b); });
    }

    [[nodiscard]] MIR_HD detail::ClusterSum sum_of(const LaneGroup& group, Run run) const {
        LaneGroup::PerLane<detail::ClusterSum> own;
        LaneGroup::PerLane<std::uint32_t> counts;
        group.each([&](std::uint32_t lane) {
            own[lane] = {Vec3(infinity), Vec3(-infinity), Vec3(0.0f), 0};
            for (std::uint32_t k = lane; k < run.count; k += LaneGroup::width) {
                const Hit hit = hits.load(run.first + k);
                if (!is_empty(hit) && is_number(hit)) own[lane].add(hit);
            }
            counts[lane] = own[lane].luxels;
        });
        detail::ClusterSum sum;
        sum.luxels = group.sums_before(counts);
        for (int axis = 0; axis < 3; ++axis) {
            Floats low, high, normal;
            group.each([&](std::uint32_t lane) {
                low[lane] = own[lane].low[axis];
                high[lane] = own[lane].high[axis];
                normal[lane] = own[lane].normals[axis];
            });
            sum.low[axis] = group.smallest(low);
            sum.high[axis] = group.largest(high);
            sum.normals[axis] = total(group, normal);
        }
        return sum;
    }

    /// At the luxels of a run that are not empty.
    struct Ranges {
        float front;          ///< the least value of the half-space's row
        detail::Range along;  ///< of TiltedAxis::along()
    };

    [[nodiscard]] MIR_HD Ranges ranges_of(const LaneGroup& group, Run run, AffineRow front,
                                          const TiltedAxis& tilt) const {
        Floats least, low, high;
        group.each([&](std::uint32_t lane) {
            least[lane] = infinity;
            low[lane] = infinity;
            high[lane] = -infinity;
            for (std::uint32_t k = lane; k < run.count; k += LaneGroup::width) {
                const Hit hit = hits.load(run.first + k);
                if (is_empty(hit)) continue;
                const float along = tilt.along(hit.position);
                least[lane] = smaller(row_at(front, hit.position), least[lane]);
                low[lane] = smaller(along, low[lane]);
                high[lane] = larger(along, high[lane]);
            }
        });
        return {group.smallest(least), {group.smallest(low), group.largest(high)}};
    }
};

}  // namespace mir
