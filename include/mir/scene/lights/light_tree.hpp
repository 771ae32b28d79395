// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/lights/light_bounds.hpp"
#include "mir/scene/lights/light_tree_view.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

namespace mir {

/// A LightSource with a place that a LightTree may hold. Others are summed one by one.
template <class L>
concept TreeLight = requires(const L l) {
    { l.light_bounds() } -> std::same_as<LightBounds>;
};

/// A lamp as a LightTree is made of it.
struct TreeLamp {
    LightBounds bounds;       ///< with power
    std::uint32_t light = 0;  ///< as LightTable counts
};

/// A binary tree over lamps from which a luxel draws those that light it. Immutable; const use from
/// any thread. Nodes are halved where the surface area orientation heuristic (SAOH) is least.
/// Source: Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
/// Splitting", HPG 2018, without the splitting.
class LightTree {
 public:
    LightTree() = default;

    /// Of lamps with power, at most 2^29.
    explicit LightTree(std::vector<TreeLamp> lamps);

    /// The root first; two children lie side by side.
    [[nodiscard]] std::span<const LightNode> nodes() const { return nodes_; }
    /// What kernels on the host read; valid until the tree is changed or ends.
    [[nodiscard]] LightTreeView<Space::host> view() const {
        return {nodes_.data(), static_cast<std::uint32_t>(nodes_.size())};
    }

 private:
    using Lamps = std::span<TreeLamp>;

    LightBounds build(Lamps lamps, std::uint32_t at, std::uint32_t depth);
    void write(std::uint32_t at, const LightBounds& bounds, std::uint32_t link);

    std::vector<LightNode> nodes_;
};

namespace detail {

/// Where lamps are divided: those whose centre has less than `place` along `axis` come first.
struct LightSplit {
    double cost = std::numeric_limits<double>::infinity();  ///< of SAOH, without the parent's part
    int axis = 0;                                           ///< 0..2
    float place = 0.0f;                                     ///< metres
};

/// The least SAOH cost among `bins` equal slices of an axis. `centres` is the box of the lamps'
/// centres.
inline LightSplit best_split(std::span<const TreeLamp> lamps, const Bounds& centres, int axis) {
    constexpr int bins = 12;
    const float low = centres.low[axis];
    const float width = (centres.high[axis] - low) / bins;
    LightSplit best;
    if (!(width > 0.0f)) return best;
    std::array<LightBounds, bins> bin;
    for (const TreeLamp& lamp : lamps) {
        const auto i = static_cast<int>((lamp.bounds.box.centre()[axis] - low) / width);
        LightBounds& own = bin[static_cast<std::size_t>(std::clamp(i, 0, bins - 1))];
        own = own.with(lamp.bounds);
    }
    std::array<double, bins> behind{};
    LightBounds sum;
    for (std::size_t i = bins - 1; i > 0; --i) {
        sum = sum.with(bin[i]);
        behind[i] = sum.cost();
    }
    // k_r of the paper: thin slices of long boxes are not wanted.
    const Vec3 size = centres.high - centres.low;
    const double regular = static_cast<double>(std::max({size.x, size.y, size.z}) / size[axis]);
    sum = {};
    for (std::size_t i = 1; i < bins; ++i) {
        sum = sum.with(bin[i - 1]);
        const double cost = regular * (sum.cost() + behind[i]);
        if (cost < best.cost) best = {cost, axis, low + width * static_cast<float>(i)};
    }
    return best;
}

/// Puts a node's first lamps first; how many they are. Both halves get some.
inline std::size_t divide(std::span<TreeLamp> lamps, bool by_halves) {
    Bounds centres;
    for (const TreeLamp& lamp : lamps) centres.add(lamp.bounds.box.centre());
    const Vec3 size = centres.high - centres.low;
    const int widest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (!by_halves) {
        LightSplit best = best_split(lamps, centres, widest);
        // Other axes where that costs little.
        if (lamps.size() <= 1024)
            for (int axis = 0; axis < 3; ++axis)
                if (axis != widest) {
                    const LightSplit other = best_split(lamps, centres, axis);
                    if (other.cost < best.cost) best = other;
                }
        const auto behind =
            std::stable_partition(lamps.begin(), lamps.end(), [&best](const TreeLamp& lamp) {
                return lamp.bounds.box.centre()[best.axis] < best.place;
            });
        const auto first = static_cast<std::size_t>(behind - lamps.begin());
        if (first > 0 && first < lamps.size()) return first;
    }
    std::sort(lamps.begin(), lamps.end(), [widest](const TreeLamp& a, const TreeLamp& b) {
        return std::tuple(a.bounds.box.centre()[widest], a.light) <
               std::tuple(b.bounds.box.centre()[widest], b.light);
    });
    return lamps.size() / 2;
}

}  // namespace detail

inline LightTree::LightTree(std::vector<TreeLamp> lamps) {
    if (lamps.empty()) return;
    nodes_.reserve(2 * lamps.size() - 1);
    nodes_.resize(1);
    build(lamps, 0, 0);
}

/// Writes the node `at` and all below; the bounds of its lamps.
inline LightBounds LightTree::build(Lamps lamps, std::uint32_t at, std::uint32_t depth) {
    if (lamps.size() == 1) {
        write(at, lamps[0].bounds, lamps[0].light | LightNode::leaf_bit);
        return lamps[0].bounds;
    }
    // The heuristic may cut off one lamp at a time, and recursion must end.
    constexpr std::uint32_t deep = 64;
    const std::size_t first = detail::divide(lamps, depth >= deep);
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    const LightBounds a = build(lamps.first(first), children, depth + 1);
    const LightBounds b = build(lamps.subspan(first), children + 1, depth + 1);
    nodes_[children].share = static_cast<float>(a.power / (a.power + b.power));
    nodes_[children + 1].share = static_cast<float>(b.power / (a.power + b.power));
    const LightBounds both = a.with(b);
    write(at, both, children);
    return both;
}

inline void LightTree::write(std::uint32_t at, const LightBounds& bounds, std::uint32_t link) {
    LightNode& node = nodes_[at];
    node.centre = bounds.box.centre();
    // A little more than the box, because the centre is rounded.
    node.radius =
        0.5f * (1.0f + 0x1p-20f) * bounds.box.diagonal() + 0x1p-22f * max_abs(node.centre);
    node.axis = bounds.cone.axis;
    node.cos_spread = std::cos(bounds.cone.spread);
    node.sin_spread = std::sin(bounds.cone.spread);
    node.cos_emission = std::cos(bounds.cone.emission);
    node.link = link | (bounds.cone.is_double ? LightNode::double_bit : 0u);
}

}  // namespace mir
