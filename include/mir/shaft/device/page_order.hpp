// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/group_sort.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"
#include "mir/shaft/exact/cluster_record.hpp"
#include "mir/shaft/exact/luxel_pages.hpp"
#include "mir/shaft/exact/page_compactness.hpp"

#include <cstring>
#include <limits>

namespace mir {

/// Sorts the luxels of a tile so that aligned runs of 32 are compact. A run lies close together and
/// looks the same way: kernel for groups, a page each. Pages whose runs are compact as they are
/// stay so. Others are split at medians, along the widest of the six keys of cluster_order(),
/// position and weighted normal, ties by index, empty luxels last; but page by page, which is as
/// good (docs/decisions/017) and needs no more memory than a group has. It decides speed, never
/// bits.
struct PageOrder {
    /// What a group works in.
    struct Workspace {
        /// A key above the number of a luxel in the page.
        std::uint64_t items[LuxelPage::most_luxels];
    };

    SoaView<const Hit> hits;     ///< in blocked order
    LuxelPages pages;            ///< of the tile
    float normal_weight = 0.0f;  ///< what a difference of 1 in a normal counts as, metres
    SoaView<Hit> ordered;        ///< the same luxels, in their new slots
    /// By blocked index: number in its page of the new slot. `stays` in all of a page in which no
    /// luxel moves.
    std::uint32_t* places = nullptr;

    static constexpr std::uint32_t stays = 0xFFFFFFFFu;  ///< instead of a number

    /// Page `i`.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const LuxelPage page = pages[i];
        const std::uint32_t count = page.luxels();
        const bool moves = !is_compact(group, page);
        group.each([&](std::uint32_t lane) {
            for (std::uint32_t k = lane; k < count; k += LaneGroup::width) space.items[k] = k;
        });
        if (moves) sort(group, page, space);
        group.each([&](std::uint32_t lane) {
            for (std::uint32_t k = lane; k < count; k += LaneGroup::width) {
                const LuxelIndex from = page.slot(luxel_of(space.items[k]));
                ordered.store(page.slot(k), hits.load(from));
                places[from] = moves ? k : stays;
            }
        });
    }

 private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    /// Items of a page.
    struct Run {
        std::uint32_t first;
        std::uint32_t count;
    };

    /// By what luxels are told apart, metres.
    struct Key {
        Vec3 position;
        Vec3 normal;
    };

    /// A box around positions, metres.
    struct Box {
        Vec3 low;
        Vec3 high;

        MIR_HD static Box none() { return {Vec3(infinity), Vec3(-infinity)}; }
        MIR_HD static Box of(const Hit& hit) {
            return is_empty(hit) ? none() : Box{hit.position, hit.position};
        }
        [[nodiscard]] MIR_HD float diagonal() const { return glm::length(high - low); }
    };
    [[nodiscard]] MIR_HD static Box joined(const Box& a, const Box& b) {
        return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
    }

    [[nodiscard]] MIR_HD bool is_compact(const LaneGroup& group, const LuxelPage& page) const {
        Box all = Box::none();
        RunSizes sizes;
        for (std::uint32_t run = 0; run < page.luxels() / cluster_luxels; ++run) {
            LaneGroup::PerLane<Box> boxes;
            group.each([&](std::uint32_t lane) {
                boxes[lane] = Box::of(hits.load(page.slot(run * cluster_luxels + lane)));
            });
            const Box box = combined(group, boxes);
            if (box.low.x > box.high.x) continue;
            sizes.add(box.diagonal());
            all = joined(all, box);
        }
        return sizes.are_compact(all.diagonal());
    }

    /// The box around those of all lanes.
    [[nodiscard]] MIR_HD static Box combined(const LaneGroup& group,
                                             const LaneGroup::PerLane<Box>& boxes) {
        Box box = Box::none();
        for (int axis = 0; axis < 3; ++axis) {
            LaneGroup::PerLane<float> lows, highs;
            group.each([&](std::uint32_t lane) {
                lows[lane] = boxes[lane].low[axis];
                highs[lane] = boxes[lane].high[axis];
            });
            box.low[axis] = group.combined(lows, [](float a, float b) { return smaller(a, b); });
            box.high[axis] = group.combined(highs, [](float a, float b) { return larger(a, b); });
        }
        return box;
    }

    MIR_HD void sort(const LaneGroup& group, const LuxelPage& page, Workspace& space) const {
        const std::uint32_t count = page.luxels();
        for (std::uint32_t run = count; run > cluster_luxels; run /= 2) {
            for (std::uint32_t first = 0; first < count; first += run)
                set_keys(group, page, {first, run}, space);
            sort_runs(group, space.items, count, run);
        }
    }

    MIR_HD static std::uint32_t luxel_of(std::uint64_t item) {
        return static_cast<std::uint32_t>(item);
    }
    [[nodiscard]] MIR_HD Key key_of(const Hit& hit) const {
        return {hit.position, normal_weight * hit.normal};
    }

    /// Numbers in the order of the floats that they stand for.
    MIR_HD static std::uint32_t ordered_bits(float value) {
        std::uint32_t bits = 0;
        memcpy(&bits, &value, sizeof bits);
        return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
    }

    /// Gives the items of a run the key by which they are to be sorted.
    MIR_HD void set_keys(const LaneGroup& group, const LuxelPage& page, Run run,
                         Workspace& space) const {
        const int axis = widest(group, page, run, space);
        group.each([&](std::uint32_t lane) {
            for (std::uint32_t k = run.first + lane; k < run.first + run.count;
                 k += LaneGroup::width) {
                const std::uint32_t luxel = luxel_of(space.items[k]);
                const Hit hit = hits.load(page.slot(luxel));
                const Key key = key_of(hit);
                const float value = axis < 3 ? key.position[axis] : key.normal[axis - 3];
                const std::uint32_t bits = is_empty(hit) ? 0xFFFFFFFFu : ordered_bits(value);
                space.items[k] = std::uint64_t{bits} << 32 | luxel;
            }
        });
    }

    /// The key with the largest extent in a run, 0 to 5. The first of equals.
    [[nodiscard]] MIR_HD int widest(const LaneGroup& group, const LuxelPage& page, Run run,
                                    const Workspace& space) const {
        LaneGroup::PerLane<Key> low, high;
        group.each([&](std::uint32_t lane) {
            low[lane] = {Vec3(infinity), Vec3(infinity)};
            high[lane] = {Vec3(-infinity), Vec3(-infinity)};
            for (std::uint32_t k = run.first + lane; k < run.first + run.count;
                 k += LaneGroup::width) {
                const Hit hit = hits.load(page.slot(luxel_of(space.items[k])));
                if (is_empty(hit)) continue;
                const Key key = key_of(hit);
                low[lane] = {glm::min(low[lane].position, key.position),
                             glm::min(low[lane].normal, key.normal)};
                high[lane] = {glm::max(high[lane].position, key.position),
                              glm::max(high[lane].normal, key.normal)};
            }
        });
        int axis = 0;
        float most = -infinity;
        for (int k = 0; k < 6; ++k) {
            const float extent = extent_of(group, low, high, k);
            if (extent > most) axis = k;
            most = larger(extent, most);
        }
        return axis;
    }

    [[nodiscard]] MIR_HD static float extent_of(const LaneGroup& group,
                                                const LaneGroup::PerLane<Key>& low,
                                                const LaneGroup::PerLane<Key>& high, int axis) {
        LaneGroup::PerLane<float> lows, highs;
        group.each([&](std::uint32_t lane) {
            lows[lane] = axis < 3 ? low[lane].position[axis] : low[lane].normal[axis - 3];
            highs[lane] = axis < 3 ? high[lane].position[axis] : high[lane].normal[axis - 3];
        });
        return group.combined(highs, [](float a, float b) { return larger(a, b); }) -
               group.combined(lows, [](float a, float b) { return smaller(a, b); });
    }
};

}  // namespace mir
