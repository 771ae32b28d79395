// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/wide_bins.hpp"

#include <vector>

namespace mir::detail {

/// What all parts of one construction share. Parts work on items that are not each other's.
struct WidePlan {
    WideBvhOptions options;
    std::uint32_t max_depth = 0;
    float area_scale = 1.0f;  ///< 1 / metres: turns half the root's surface into 1
    float reach = 0.0f;
    WideItem* items = nullptr;
    WideItem* spare = nullptr;  ///< room for as many
};

struct WideHalves {
    WideRange below;
    WideRange above;
};

/// Cuts ranges of items in two. All threads of the executor work on one cut; what comes out does
/// not depend on their number.
template <Executor E>
class WideSplitter {
 public:
    WideSplitter(const WidePlan& plan, E& executor) : plan_(plan), executor_(executor) {}

    /// By the surface area heuristic, or by number where all centres coincide.
    WideHalves cut(const WideRange& range) {
        const WideGrid grid(range, plan_.options.bins);
        parts_.resize((range.count() + wide_part - 1) / wide_part);
        for_each_part(range.count(), wide_part, executor_,
                      [&](std::size_t first, std::size_t last) {
                          parts_[first / wide_part].bins.count(items(range, first, last), grid);
                      });
        WideBins all = parts_[0].bins;
        for (std::size_t i = 1; i < parts_.size(); ++i) all.add(parts_[i].bins, grid.bins);
        const WideCut cut = all.best(grid.bins, plan_.area_scale);
        return cut.border == 0 ? halve(range) : deal(range, grid, cut, all.below(cut));
    }

    /// Into halves of equal number, below and above the middle of the centres on the axis on which
    /// they lie farthest apart.
    WideHalves halve(const WideRange& range) {
        const Float4 extent = range.content.centres.high - range.content.centres.low;
        const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0
                         : extent[1] >= extent[2]                         ? 1
                                                                          : 2;
        const std::size_t middle = range.first + (range.count() + 1) / 2;
        std::nth_element(plan_.items + range.first, plan_.items + middle, plan_.items + range.last,
                         [axis](const WideItem& a, const WideItem& b) {
                             const float left = a.centre()[axis];
                             const float right = b.centre()[axis];
                             return left < right || (left == right && a.triangle < b.triangle);
                         });
        return {range_of(range.first, middle), range_of(middle, range.last)};
    }

 private:
    /// Some of the range's items: what one thread works on at a time.
    struct Part {
        WideBins bins;
        std::size_t below = 0;  ///< where its items below the cut go, from the range's begin
        std::size_t above = 0;
        WideContent content_below;
        WideContent content_above;
    };

    [[nodiscard]] std::span<const WideItem> items(const WideRange& range, std::size_t first,
                                                  std::size_t last) const {
        return {plan_.items + range.first + first, last - first};
    }
    [[nodiscard]] WideRange range_of(std::size_t first, std::size_t last) const {
        return {first, last, content_of({plan_.items + first, last - first})};
    }

    /// Puts the items below the cut first. Keeps their order else.
    WideHalves deal(const WideRange& range, const WideGrid& grid, const WideCut& cut,
                    std::size_t below) {
        place_parts(cut, below);
        for_each_part(range.count(), wide_part, executor_,
                      [&](std::size_t first, std::size_t last) {
                          deal_part(parts_[first / wide_part], items(range, first, last), grid, cut,
                                    plan_.spare + range.first);
                      });
        for_each_part(
            range.count(), wide_part, executor_, [&](std::size_t first, std::size_t last) {
                std::copy(plan_.spare + range.first + first, plan_.spare + range.first + last,
                          plan_.items + range.first + first);
            });
        WideHalves halves{{range.first, range.first + below, {}},
                          {range.first + below, range.last, {}}};
        for (const Part& part : parts_) {
            halves.below.content.add(part.content_below);
            halves.above.content.add(part.content_above);
        }
        return halves;
    }

    void place_parts(const WideCut& cut, std::size_t below) {
        std::size_t next_below = 0;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            parts_[i].below = next_below;
            parts_[i].above = below + i * wide_part - next_below;
            next_below += parts_[i].bins.below(cut);
        }
    }

    static void deal_part(Part& part, std::span<const WideItem> items, const WideGrid& grid,
                          const WideCut& cut, WideItem* to) {
        part.content_below = {};
        part.content_above = {};
        std::size_t below = part.below;
        std::size_t above = part.above;
        for (const WideItem& item : items) {
            const bool is_below = grid.bin(item)[cut.axis] < static_cast<int>(cut.border);
            (is_below ? part.content_below : part.content_above).add(item);
            to[is_below ? below++ : above++] = item;
        }
    }

    const WidePlan& plan_;
    E& executor_;
    std::vector<Part> parts_;
};

}  // namespace mir::detail
