// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/wide_item.hpp"
#include "mir/accel/wide_options.hpp"

#include <algorithm>

namespace mir::detail {

/// Equal bins between the ends of the centres of some items, on three axes.
struct WideGrid {
    static constexpr std::uint32_t largest = 32;

    WideGrid(const WideRange& range, std::uint32_t most)
        : bins(static_cast<std::uint32_t>(std::clamp<std::size_t>(2 * range.count(), 4, most))),
          low(range.content.centres.low) {
        const Float4 extent = range.content.centres.high - low;
        // Wide enough for the scale to be finite; what lies closer together shares a bin.
        scale = all_lanes(static_cast<float>(bins)) / larger_lanes(extent, all_lanes(1e-30f));
    }

    [[nodiscard]] Int4 bin(const WideItem& item) const {
        const Float4 last = all_lanes(static_cast<float>(bins - 1));
        const Float4 at = axes_only((item.centre() - low) * scale);
        return __builtin_convertvector(smaller_lanes(at, last), Int4);
    }

    std::uint32_t bins;
    Float4 low;
    Float4 scale;
};

/// A border between two bins of an axis, and what it costs in the surface area heuristic.
struct WideCut {
    int axis = 0;
    std::uint32_t border = 0;  ///< first bin above; 0: there is no cut
    float cost = std::numeric_limits<float>::infinity();
};

/// How many items have their centre in each bin, and the boxes around these. Sums and boxes of
/// parts can be joined in any order.
struct WideBins {
    LaneBox boxes[3][WideGrid::largest];
    std::uint32_t counts[3][WideGrid::largest] = {};

    void count(std::span<const WideItem> items, const WideGrid& grid) {
        clear(grid.bins);
        for (const WideItem& item : items) {
            const Int4 bin = grid.bin(item);
            for (int axis = 0; axis < 3; ++axis) {
                boxes[axis][bin[axis]].add(item.low_lanes(), item.high_lanes());
                ++counts[axis][bin[axis]];
            }
        }
    }

    void add(const WideBins& other, std::uint32_t bins) {
        for (int axis = 0; axis < 3; ++axis)
            for (std::uint32_t b = 0; b < bins; ++b) {
                boxes[axis][b].add(other.boxes[axis][b]);
                counts[axis][b] += other.counts[axis][b];
            }
    }

    /// Items in the bins below a cut.
    [[nodiscard]] std::size_t below(const WideCut& cut) const {
        std::size_t sum = 0;
        for (std::uint32_t b = 0; b < cut.border; ++b) sum += counts[cut.axis][b];
        return sum;
    }

    /// The cheapest border with items on both sides: N_l A_l + N_r A_r is least.
    [[nodiscard]] WideCut best(std::uint32_t bins, float area_scale) const {
        WideCut best;
        for (int axis = 0; axis < 3; ++axis) {
            const WideCut cut = best_on(axis, bins, area_scale);
            if (cut.border != 0 && (best.border == 0 || cut.cost < best.cost)) best = cut;
        }
        return best;
    }

 private:
    void clear(std::uint32_t bins) {
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(boxes[axis], bins, LaneBox{});
            std::fill_n(counts[axis], bins, 0u);
        }
    }

    [[nodiscard]] WideCut best_on(int axis, std::uint32_t bins, float area_scale) const {
        float above[WideGrid::largest];  // negative: nothing there
        LaneBox box;
        std::size_t count = 0;
        for (std::uint32_t b = bins; --b > 0;) {
            box.add(boxes[axis][b]);
            count += counts[axis][b];
            above[b] = count == 0 ? -1.0f : cost_of(box, count, area_scale);
        }
        WideCut best;
        box = {};
        count = 0;
        for (std::uint32_t b = 1; b < bins && above[b] >= 0.0f; ++b) {
            box.add(boxes[axis][b - 1]);
            count += counts[axis][b - 1];
            if (count == 0) continue;
            const float cost = cost_of(box, count, area_scale) + above[b];
            if (best.border == 0 || cost < best.cost) best = {axis, b, cost};
        }
        return best;
    }

    static float cost_of(const LaneBox& box, std::size_t count, float area_scale) {
        return half_area(box, area_scale) * static_cast<float>(count);
    }
};

}  // namespace mir::detail
