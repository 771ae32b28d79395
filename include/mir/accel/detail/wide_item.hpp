// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/construction.hpp"
#include "mir/accel/detail/lane_box.hpp"
#include "mir/accel/detail/raw_array.hpp"

#include <span>
#include <vector>

namespace mir::detail {

/// A triangle as construction moves it about: its accept box.
struct alignas(16) WideItem {
    float low[3];
    std::uint32_t triangle;
    float high[3];
    std::uint32_t spare;

    [[nodiscard]] Float4 low_lanes() const { return axes_only(load_lanes(low)); }
    [[nodiscard]] Float4 high_lanes() const { return axes_only(load_lanes(high)); }

    /// Twice the centre of the box.
    [[nodiscard]] Float4 centre() const { return low_lanes() + high_lanes(); }
};
static_assert(sizeof(WideItem) == 32);

/// Where some items lie: the box around them, and the one around their centres (times two).
struct WideContent {
    LaneBox box;
    LaneBox centres;

    void add(const WideItem& item) {
        box.add(item.low_lanes(), item.high_lanes());
        centres.add(item.centre(), item.centre());
    }
    void add(const WideContent& other) {
        box.add(other.box);
        centres.add(other.centres);
    }
};

inline WideContent content_of(std::span<const WideItem> items) {
    WideContent content;
    for (const WideItem& item : items) content.add(item);
    return content;
}

/// Items [first, last), which follow each other.
struct WideRange {
    std::size_t first = 0;
    std::size_t last = 0;
    WideContent content;

    [[nodiscard]] std::size_t count() const { return last - first; }
};

/// How many items one thread looks at before another may.
inline constexpr std::size_t wide_part = 4096;

/// Makes an item of each triangle.
template <Executor E>
WideRange make_items(const WorldGeometry& geometry, RawArray<WideItem>& items, E& executor) {
    const std::size_t n = geometry.triangles().size();
    const float magnitude = magnitude_of(geometry.bounds());
    items.resize(n);
    std::vector<WideContent> contents((n + wide_part - 1) / wide_part);
    for_each_part(n, wide_part, executor, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto t = static_cast<std::uint32_t>(i);
            const Bounds box = accept_box(geometry.corner(t, 0), geometry.corner(t, 1),
                                          geometry.corner(t, 2), magnitude);
            items[i] = {
                {box.low.x, box.low.y, box.low.z}, t, {box.high.x, box.high.y, box.high.z}, 0};
        }
        contents[first / wide_part] = content_of(items.span().subspan(first, last - first));
    });
    WideRange all{0, n, {}};
    for (const WideContent& content : contents) all.content.add(content);
    return all;
}

}  // namespace mir::detail
