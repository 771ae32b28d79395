// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/shaft/cluster_record.hpp"

#include <limits>

namespace mir {

/// Records of runs of luxels, as cluster_record() makes them but for the order in which normals are
/// summed: kernel for groups, a run of `run` luxels each, which neighbouring lanes read side by
/// side. Luxels beyond the last one are padding, that is empty, and are there to be read.
struct GroupRecords {
    /// Groups need no memory.
    struct Workspace {};

    SoaView<const Hit> hits;             ///< in cluster order
    std::uint32_t run = cluster_luxels;  ///< a multiple of 32
    float sigma = 0.0f;                  ///< of the scene, metres
    ClusterRecord* records = nullptr;    ///< one for each run

    /// Run `i`: luxels i run to i run + run - 1.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        const detail::ClusterSum sum = sum_of(group, i * run);
        ClusterRecord cluster;
        if (sum.luxels > 0) {
            cluster.low = sum.low - sigma;
            cluster.high = sum.high + sigma;
            cluster.luxels = sum.luxels;
            cluster.front = detail::direction_row(sum.normals);
            const AffineRow front = cluster.front;
            const auto in_front = [front](Vec3 p) { return row_at(front, p); };
            cluster.front.w = strict::sub(2.0f * sigma, range_of(group, i * run, in_front).low);
            const TiltedAxis tilt = detail::tilted_axis(front);
            const auto along = [tilt](Vec3 p) { return tilt.along(p); };
            const detail::Range range = range_of(group, i * run, along);
            detail::set_tilt(cluster, tilt, range.low, range.high, sigma);
        }
        group.each([&](std::uint32_t lane) {
            if (lane == 0) records[i] = cluster;
        });
    }

 private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    using Floats = LaneGroup::PerLane<float>;

    /// Luxels that are no number face nothing; comparing with one would lose those before it.
    MIR_HD static bool is_number(const Hit& hit) {
        const Vec3 p = hit.position;
        return fabsf(p.x) >= 0.0f && fabsf(p.y) >= 0.0f && fabsf(p.z) >= 0.0f;
    }

    MIR_HD static float smallest(const LaneGroup& group, Floats values) {
        return group.combined(values, [](float a, float b) { return smaller(a, b); });
    }
    MIR_HD static float largest(const LaneGroup& group, Floats values) {
        return group.combined(values, [](float a, float b) { return larger(a, b); });
    }
    MIR_HD static float total(const LaneGroup& group, Floats values) {
        return group.combined(values, [](float a, float b) { return strict::add(a, b); });
    }

    [[nodiscard]] MIR_HD detail::ClusterSum sum_of(const LaneGroup& group,
                                                   std::uint32_t first) const {
        LaneGroup::PerLane<detail::ClusterSum> own;
        LaneGroup::PerLane<std::uint32_t> counts;
        group.each([&](std::uint32_t lane) {
            own[lane] = {Vec3(infinity), Vec3(-infinity), Vec3(0.0f), 0};
            for (std::uint32_t k = lane; k < run; k += LaneGroup::width) {
                const Hit hit = hits.load(first + k);
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
            sum.low[axis] = smallest(group, low);
            sum.high[axis] = largest(group, high);
            sum.normals[axis] = total(group, normal);
        }
        return sum;
    }

    /// Of `value` at the luxels of a run that are not empty.
    template <class Value>
    [[nodiscard]] MIR_HD detail::Range range_of(const LaneGroup& group, std::uint32_t first,
                                                const Value& value) const {
        Floats least, greatest;
        group.each([&](std::uint32_t lane) {
            least[lane] = infinity;
            greatest[lane] = -infinity;
            for (std::uint32_t k = lane; k < run; k += LaneGroup::width) {
                const Hit hit = hits.load(first + k);
                if (is_empty(hit)) continue;
                const float at = value(hit.position);
                least[lane] = smaller(at, least[lane]);
                greatest[lane] = larger(at, greatest[lane]);
            }
        });
        return {smallest(group, least), largest(group, greatest)};
    }
};

}  // namespace mir
