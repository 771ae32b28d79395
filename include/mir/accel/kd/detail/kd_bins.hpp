// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_split.hpp"
#include "mir/accel/kd/detail/raw_array.hpp"

#include <algorithm>

namespace mir::detail {

// Large nodes: begins and ends are counted in equal bins on the three axes at once; the bins
// around the best border are then searched exactly, so that planes still touch what they cut off.

/// Box around a list of fragments; empty lists have an inverted one.
struct KdContent {
    Float4 low = all_lanes(std::numeric_limits<float>::infinity());
    Float4 high = all_lanes(-std::numeric_limits<float>::infinity());

    void add(std::span<const KdFragment> fragments) {
        for (const KdFragment& f : fragments) {
            low = smaller_lanes(f.low_lanes(), low);
            high = larger_lanes(f.high_lanes(), high);
        }
    }
    void add(const KdContent& other) {
        low = smaller_lanes(other.low, low);
        high = larger_lanes(other.high, high);
    }
};

/// Equal bins between the ends of a content, on three axes.
struct KdGrid {
    static constexpr int largest = 256;

    KdGrid() = default;
    KdGrid(const KdContent& content, std::size_t fragments)
        : bins(bins_for(fragments)),
          low(axes_only(content.low)),
          width(larger_lanes(axes_only(content.high) - low, all_lanes(1e-30f)) /
                all_lanes(static_cast<float>(bins))),
          scale(all_lanes(1.0f) / width) {}

    /// Few enough that counting, not sweeping bins, takes the time. Enough that the exact search
    /// looks at a small part.
    static int bins_for(std::size_t fragments) {
        if (fragments <= 256) return 32;
        if (fragments <= 2048) return 64;
        return fragments <= 16384 ? 128 : largest;
    }

    [[nodiscard]] Int4 bin(Float4 at) const {
        const Float4 last = all_lanes(static_cast<float>(bins - 1));
        return __builtin_convertvector(smaller_lanes((axes_only(at) - low) * scale, last), Int4);
    }

    [[nodiscard]] int bin(int axis, float at) const {
        const auto last = static_cast<float>(bins - 1);
        return static_cast<int>(smaller((at - low[axis]) * scale[axis], last));
    }

    int bins = 0;
    Float4 low = {0, 0, 0, 0};
    Float4 width = {0, 0, 0, 0};
    Float4 scale = {0, 0, 0, 0};
};

/// How many fragments begin and end in each bin.
struct KdBins {
    alignas(16) std::uint32_t begins[KdGrid::largest][4];
    alignas(16) std::uint32_t ends[KdGrid::largest][4];

    void clear(int bins) {
        std::fill_n(&begins[0][0], 4 * bins, 0u);
        std::fill_n(&ends[0][0], 4 * bins, 0u);
    }

    void count(std::span<const KdFragment> fragments, const KdGrid& grid) {
        for (const KdFragment& f : fragments) {
            const Int4 low = grid.bin(f.low_lanes());
            const Int4 high = grid.bin(f.high_lanes());
            for (int axis = 0; axis < 3; ++axis) {
                ++begins[low[axis]][axis];
                ++ends[high[axis]][axis];
            }
        }
    }

    void add(const KdBins& other, int bins) {
        for (int b = 0; b < bins; ++b)
            for (int axis = 0; axis < 3; ++axis) {
                begins[b][axis] += other.begins[b][axis];
                ends[b][axis] += other.ends[b][axis];
            }
    }
};

/// The bins around the cheapest border, where the exact search takes place. On either side the next
/// one in which something begins or ends, since between two such places costs are affine.
struct KdBorder {
    int axis = 0;
    int first_bin = 0;
    int last_bin = 0;
    float cost = 0.0f;
    std::uint32_t below = 0;  ///< fragments that begin before these bins
    std::uint32_t ended = 0;  ///< fragments that end before them
};

inline Float4 lane_counts(const std::uint32_t (&counts)[4]) {
    Int4 v;
    std::memcpy(&v, counts, sizeof v);
    return __builtin_convertvector(v, Float4);
}

inline KdBorder best_border(const KdBins& bins, const KdGrid& grid, const KdCost& cost) {
    Float4 below = all_lanes(0.0f);
    Float4 above = all_lanes(cost.count);
    Float4 best = all_lanes(std::numeric_limits<float>::infinity());
    Float4 best_bin = all_lanes(1.0f);
    for (int b = 1; b < grid.bins; ++b) {
        below += lane_counts(bins.begins[b - 1]);
        above -= lane_counts(bins.ends[b - 1]);
        const Float4 bin = all_lanes(static_cast<float>(b));
        const Float4 c = cost(grid.low + grid.width * bin, below, above);
        best_bin = c < best ? bin : best_bin;
        best = c < best ? c : best;
    }
    KdBorder border;
    for (int axis = 1; axis < 3; ++axis)
        if (best[axis] < best[border.axis]) border.axis = axis;
    border.cost = best[border.axis];
    const auto is_empty = [&](int b) {
        return (bins.begins[b][border.axis] | bins.ends[b][border.axis]) == 0;
    };
    border.last_bin = static_cast<int>(best_bin[border.axis]);
    border.first_bin = border.last_bin - 1;
    while (border.first_bin > 0 && is_empty(border.first_bin)) --border.first_bin;
    while (border.last_bin + 1 < grid.bins && is_empty(border.last_bin)) ++border.last_bin;
    for (int b = 0; b < border.first_bin; ++b) {
        border.below += bins.begins[b][border.axis];
        border.ended += bins.ends[b][border.axis];
    }
    return border;
}

/// Appends the keys of all begins and ends in the bins around a border. The last bit of a begin is
/// set.
inline void collect_events(std::span<const KdFragment> fragments, const KdGrid& grid,
                           const KdBorder& border, RawArray<std::int32_t>& keys) {
    std::size_t n = keys.size();
    keys.resize(n + 2 * fragments.size());
    std::int32_t* const to = keys.data();
    const int axis = border.axis;
    const auto last = static_cast<unsigned>(border.last_bin - border.first_bin);
    const auto is_near = [&](float at) {
        return static_cast<unsigned>(grid.bin(axis, at) - border.first_bin) <= last ? 1u : 0u;
    };
    for (const KdFragment& f : fragments) {
        to[n] = ordered_key(f.low[axis]) | 1;
        n += is_near(f.low[axis]);
        to[n] = ordered_key(f.high[axis]);
        n += is_near(f.high[axis]);
    }
    keys.resize(n);
}

// Outside of loops that are compiled for several instruction sets: it gains nothing from them.
[[gnu::noinline]] inline void sort_events(RawArray<std::int32_t>& keys) {
    std::sort(keys.data(), keys.data() + keys.size());
}

/// Sorts the events of a border and tries a plane through each.
inline KdSplit search_border(RawArray<std::int32_t>& keys, const KdBorder& border,
                             const KdCost& cost) {
    sort_events(keys);
    KdSplit best{KdCutKind::none, 0, 0.0f, cost.limit};
    std::uint32_t below = border.below;
    std::uint32_t ended = border.ended;
    for (const std::int32_t key : keys.span()) {
        const std::uint32_t begins = static_cast<std::uint32_t>(key) & 1u;
        const float at = number_of(key & -2);
        ended += 1u - begins;
        const float c = cost(border.axis, at, static_cast<float>(below),
                             cost.count - static_cast<float>(ended));
        if (c < best.cost) best = {KdCutKind::parts, border.axis, at, c};
        below += begins;
    }
    return best;
}

/// The best plane that cuts off empty space, or none.
inline KdSplit empty_side(const KdCost& cost, const KdContent& content) {
    KdCandidates best{all_lanes(cost.limit)};
    best.try_empty_sides(cost, axes_only(content.low), axes_only(content.high));
    return best.best(cost.limit);
}

/// Search by bins, exact around the best border.
class KdBinSearch {
 public:
    void start(std::span<const KdFragment> fragments) {
        fragments_ = fragments;
        content_ = {};
        content_.add(fragments);
        grid_ = KdGrid(content_, fragments.size());
        bins_.clear(grid_.bins);
        bins_.count(fragments, grid_);
    }

    [[nodiscard]] KdSplit best(const KdCost& cost) {
        const KdBorder border = best_border(bins_, grid_, cost);
        keys_.replace(0);
        collect_events(fragments_, grid_, border, keys_);
        const KdSplit inner = search_border(keys_, border, cost);
        const KdSplit outer = empty_side(cost, content_);
        return inner.cost < outer.cost ? inner : outer;
    }

 private:
    std::span<const KdFragment> fragments_;
    KdContent content_;
    KdGrid grid_;
    KdBins bins_;
    RawArray<std::int32_t> keys_;
};

}  // namespace mir::detail
