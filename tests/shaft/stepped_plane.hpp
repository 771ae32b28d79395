// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"
#include "mir/scene/bounds.hpp"

#include <vector>

namespace mirtest {

/// Planes of some luxels.
class LuxelPlanes {
 public:
    explicit LuxelPlanes(std::uint32_t count)
        : words_(std::size_t{mir::SoaView<mir::Hit>::words} * count), count_(count) {}

    [[nodiscard]] mir::SoaView<mir::Hit> view() { return {words_.data(), count_}; }
    [[nodiscard]] mir::SoaView<const mir::Hit> view() const { return {words_.data(), count_}; }

 private:
    std::vector<std::uint32_t> words_;
    std::uint32_t count_;
};

/// Luxels of a plane, seen obliquely, with steps in it whose edges are `step` luxels apart; every
/// seventh is empty.
inline LuxelPlanes stepped_plane(const mir::BlockedLayout& layout, std::uint32_t step) {
    LuxelPlanes luxels(layout.size());
    for (std::uint32_t i = 0; i < layout.size(); ++i) {
        const mir::LuxelPlace at = layout.place(i);
        const bool is_far = at.x % (2 * step) >= step;
        const mir::Hit hit{{0.01f * static_cast<float>(at.x), is_far ? 3.0f : 0.0f,
                            0.03f * static_cast<float>(at.y)},
                           i % 7 == 3 ? mir::Vec3(0.0f) : mir::Vec3(0.0f, 0.0f, 1.0f)};
        luxels.view().store(i, hit);
    }
    return luxels;
}

/// Sum of the diagonals of the boxes of all aligned runs of `run` among the first `count` luxels,
/// metres.
inline float size_of_runs(const mir::SoaView<const mir::Hit>& luxels, std::uint32_t run,
                          std::size_t count) {
    float sum = 0.0f;
    for (std::uint32_t first = 0; first < count; first += run) {
        mir::Bounds box;
        for (std::uint32_t i = first; i < first + run; ++i)
            if (!is_empty(luxels.load(i))) box.add(luxels.load(i).position);
        if (!box.empty()) sum += glm::length(box.high - box.low);
    }
    return sum;
}
/// The same of all that there are.
inline float size_of_runs(const mir::SoaView<const mir::Hit>& luxels, std::uint32_t run) {
    return size_of_runs(luxels, run, luxels.stride);
}

}  // namespace mirtest
