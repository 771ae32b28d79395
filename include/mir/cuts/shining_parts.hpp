// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/cuts/vpl_key.hpp"
#include "mir/data/vpl_list.hpp"

#include <cstdint>
#include <limits>

namespace mir {

/// What a part of a list of VPLs holds.
struct ShiningPart {
    static constexpr std::uint32_t size = 2048;  ///< VPLs, the last part has what is left

    /// End of part `i` of a list.
    [[nodiscard]] MIR_HD static std::uint32_t end(std::uint32_t vpls, std::uint32_t i) {
        const std::uint32_t first = i * size;
        return vpls - first < size ? vpls : first + size;
    }

    std::uint32_t shining = 0;  ///< number of VPLs that shine
    std::uint32_t broken = 0;   ///< number of VPLs that no cut can bound (can_be_bounded())
    float low[3] = {};          ///< least corner of those that shine, metres
    float high[3] = {};         ///< largest corner of those that shine, metres
    float most = 0.0f;          ///< their largest luminance, W sr^-1
};

/// Kernel for groups of lanes: what each part of a list holds.
template <Space S>
struct CountShining {
    /// Not used.
    struct Workspace {};

    VplSpan<S> vpls;             ///< all
    ShiningPart* out = nullptr;  ///< written

    /// Part i.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        const std::uint32_t first = i * ShiningPart::size;
        const std::uint32_t last = ShiningPart::end(vpls.size(), i);
        LaneGroup::PerLane<ShiningPart> own;
        group.each_apart([&](std::uint32_t lane) {
            own[lane] = {0, 0, {far, far, far}, {-far, -far, -far}, 0.0f};
            for (std::uint32_t p = first + lane; p < last; p += LaneGroup::width)
                add(own[lane], vpls[p]);
        });
        ShiningPart all;
        all.shining = sum(group, own, &ShiningPart::shining);
        all.broken = sum(group, own, &ShiningPart::broken);
        LaneGroup::PerLane<float> values;
        for (int axis = 0; axis < 3; ++axis) {
            group.each_apart([&](std::uint32_t lane) { values[lane] = own[lane].low[axis]; });
            all.low[axis] = group.smallest(values);
            group.each_apart([&](std::uint32_t lane) { values[lane] = own[lane].high[axis]; });
            all.high[axis] = group.largest(values);
        }
        group.each_apart([&](std::uint32_t lane) { values[lane] = own[lane].most; });
        all.most = group.largest(values);
        group.each([&](std::uint32_t lane) {
            if (lane == 0) out[i] = all;
        });
    }

 private:
    static constexpr float far = std::numeric_limits<float>::max();

    MIR_HD static std::uint32_t sum(const LaneGroup& group,
                                    const LaneGroup::PerLane<ShiningPart>& own,
                                    std::uint32_t ShiningPart::*member) {
        LaneGroup::PerLane<std::uint32_t> values;
        group.each_apart([&](std::uint32_t lane) { values[lane] = own[lane].*member; });
        return group.combined(values, [](std::uint32_t a, std::uint32_t b) { return a + b; });
    }
    MIR_HD static void add(ShiningPart& part, const Vpl& vpl) {
        if (!can_be_bounded(vpl)) {
            ++part.broken;
            return;
        }
        if (is_black(vpl.intensity)) return;
        ++part.shining;
        for (int axis = 0; axis < 3; ++axis) {
            part.low[axis] = smaller(vpl.position[axis], part.low[axis]);
            part.high[axis] = larger(vpl.position[axis], part.high[axis]);
        }
        part.most = larger(luminance(vpl.intensity), part.most);
    }
};

/// Kernel for groups of lanes: copies the VPLs of each part that shine, in the list's order.
template <Space S>
struct KeepShining {
    /// Not used.
    struct Workspace {};

    VplSpan<S> vpls;                        ///< all
    const std::uint32_t* before = nullptr;  ///< by part: VPLs that shine in those before it
    Vpl* out = nullptr;                     ///< written

    /// Part i.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        const std::uint32_t first = i * ShiningPart::size;
        const std::uint32_t last = ShiningPart::end(vpls.size(), i);
        std::uint32_t next = before[i];
        for (std::uint32_t p = first; p < last; p += LaneGroup::width) {
            const std::uint32_t shining = group.ballot([&](std::uint32_t lane) {
                return p + lane < last && !is_black(vpls[p + lane].intensity);
            });
            group.each_apart([&](std::uint32_t lane) {
                if ((shining >> lane & 1u) == 0) return;
                out[next + LaneGroup::count_before(shining, lane)] = vpls[p + lane];
            });
            next += LaneGroup::count(shining);
        }
    }
};

}  // namespace mir
