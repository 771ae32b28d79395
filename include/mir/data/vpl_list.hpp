// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/space.hpp"
#include "mir/data/tile.hpp"
#include "mir/data/vpl.hpp"

#include <span>
#include <vector>

namespace mir {

/// View of consecutive VPLs; the model of VplSet. Size and elements do not change while it exists.
template <Space S>
struct VplSpan {
    static constexpr Space space = S;

    const Vpl* first = nullptr;
    std::uint32_t count = 0;

    [[nodiscard]] MIR_HD std::uint32_t size() const { return count; }
    [[nodiscard]] MIR_HD const Vpl& operator[](VplIndex j) const { return first[j]; }
};

/// Owner of a set of VPLs, ordered by bounce so that one bounce is one span.
class VplList {
 public:
    void push_back(const Vpl& vpl, const VplOrigin& origin) {
        vpls_.push_back(vpl);
        origins_.push_back(origin);
    }

    /// Adds a path VPL: its intensity joins the last VPL when that is the same point with the same
    /// bounce and group, else it becomes a VPL of its own (algorithm 2 of the paper).
    void append(const Vpl& vpl, const VplOrigin& origin) {
        if (empty() || !same_place(origins_.back(), origin)) return push_back(vpl, origin);
        vpls_.back().intensity += vpl.intensity;
        origins_.back().multiplicity += origin.multiplicity;
    }

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(vpls_.size()); }
    [[nodiscard]] bool empty() const { return vpls_.empty(); }
    [[nodiscard]] std::span<const Vpl> vpls() const { return vpls_; }
    [[nodiscard]] std::span<const VplOrigin> origins() const { return origins_; }

    /// All VPLs. Valid until the list changes.
    [[nodiscard]] VplSpan<Space::host> span() const { return {vpls_.data(), size()}; }

    /// The VPLs of one bounce, empty when there are none. Needs sort_by_bounce() before.
    [[nodiscard]] VplSpan<Space::host> bounce(std::uint8_t b) const;

    /// Largest bounce of any VPL, 0 for an empty list.
    [[nodiscard]] std::uint8_t max_bounce() const;

    /// Stable sort by bounce: the order inside a bounce is the order of generation.
    void sort_by_bounce();

 private:
    std::vector<Vpl> vpls_;
    std::vector<VplOrigin> origins_;
};

inline VplSpan<Space::host> VplList::bounce(std::uint8_t b) const {
    // As unsigned: one past the largest bounce must not wrap to 0.
    const auto by_bounce = [](const VplOrigin& o, unsigned value) { return o.bounce < value; };
    const auto first = std::lower_bound(origins_.begin(), origins_.end(), unsigned{b}, by_bounce);
    const auto last = std::lower_bound(first, origins_.end(), unsigned{b} + 1, by_bounce);
    return {vpls_.data() + (first - origins_.begin()), static_cast<std::uint32_t>(last - first)};
}

inline std::uint8_t VplList::max_bounce() const {
    std::uint8_t largest = 0;
    for (const VplOrigin& o : origins_) largest = std::max(largest, o.bounce);
    return largest;
}

inline void VplList::sort_by_bounce() {
    std::vector<std::uint32_t> order(vpls_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return origins_[a].bounce < origins_[b].bounce;
    });
    VplList sorted;
    for (std::uint32_t i : order) sorted.push_back(vpls_[i], origins_[i]);
    *this = std::move(sorted);
}

}  // namespace mir
