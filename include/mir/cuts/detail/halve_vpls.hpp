// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/cuts/vpl_key.hpp"
#include "mir/cuts/vpl_node.hpp"
#include "mir/data/vpl_list.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace mir::detail {

/// Place of a VPL in six dimensions (vpl_key()).
struct VplKey {
    float at[6] = {};
    VplIndex vpl = 0;
    float luminance = 0.0f;  ///< of its intensity
};

/// Axis along which keys differ most.
inline std::uint32_t widest_axis(std::span<const VplKey> keys) {
    float low[6];
    float high[6];
    std::copy_n(keys.front().at, 6, low);
    std::copy_n(keys.front().at, 6, high);
    for (const VplKey& key : keys)
        for (int a = 0; a < 6; ++a) {
            low[a] = std::min(low[a], key.at[a]);
            high[a] = std::max(high[a], key.at[a]);
        }
    return mir::widest_axis(low, high);
}

/// Puts the keys of a node's first half first.
inline void halve(std::span<VplKey> keys) {
    const std::uint32_t axis = widest_axis(keys);
    std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / 2),
                     keys.end(), [axis](const VplKey& a, const VplKey& b) {
                         return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.vpl < b.vpl;
                     });
}

inline VplBounds halve_all(std::span<VplKey> keys, const VplNode& node,
                           std::span<VplBounds> bounds) {
    if (node.is_leaf()) {
        const float* const at = keys[node.first].at;
        return bounds[node.place] = {
                   {at[0], at[1], at[2]}, {at[0], at[1], at[2]}, keys[node.first].luminance};
    }
    halve(keys.subspan(node.first, node.count));
    const VplBounds left = halve_all(keys, node.left(), bounds);
    return bounds[node.place] = left.with(halve_all(keys, node.right(), bounds));
}

/// Halves a node and those below it, level by level, until there are parts enough for many threads.
template <Executor E>
std::vector<VplNode> halve_top(std::span<VplKey> keys, const VplNode& root, std::uint32_t least,
                               E& executor) {
    const auto is_large = [least](const VplNode& node) { return node.count >= least; };
    std::vector<VplNode> parts{root};
    while (std::any_of(parts.begin(), parts.end(), is_large)) {
        executor.for_each(parts.size(), [&](std::size_t i) {
            if (is_large(parts[i])) halve(keys.subspan(parts[i].first, parts[i].count));
        });
        std::vector<VplNode> below;
        for (const VplNode& node : parts) {
            below.push_back(is_large(node) ? node.left() : node);
            if (is_large(node)) below.push_back(node.right());
        }
        parts.swap(below);
    }
    return parts;
}

/// Bounds of the nodes above the parts.
inline VplBounds join_top(const VplNode& node, std::uint32_t least, std::span<VplBounds> bounds) {
    if (node.count < least) return bounds[node.place];
    const VplBounds left = join_top(node.left(), least, bounds);
    return bounds[node.place] = left.with(join_top(node.right(), least, bounds));
}

inline std::vector<VplKey> keys_of(VplSpan<Space::host> vpls, float normal_scale,
                                   std::span<const VplIndex> order) {
    std::vector<VplKey> keys;
    keys.reserve(order.size());
    for (const VplIndex j : order) {
        VplKey key{{}, j, luminance(vpls[j].intensity)};
        for (int a = 0; a < 6; ++a) key.at[a] = vpl_key(vpls[j], normal_scale, a);
        keys.push_back(key);
    }
    return keys;
}

/// Brings `order` into leaf order and finds the bounds of all nodes. `normal_scale` is that of
/// ShiningVpls.
template <Executor E>
void halve_vpls(VplSpan<Space::host> vpls, float normal_scale, std::vector<VplIndex>& order,
                std::vector<VplBounds>& bounds, E& executor) {
    if (order.empty()) return;
    std::vector<VplKey> keys = keys_of(vpls, normal_scale, order);
    const VplNode root{0, 0, static_cast<std::uint32_t>(order.size())};
    bounds.resize(2 * order.size() - 1);
    constexpr std::uint32_t least = 4096;
    const std::vector<VplNode> parts = halve_top(std::span(keys), root, least, executor);
    executor.for_each(parts.size(), [&](std::size_t i) { halve_all(keys, parts[i], bounds); });
    join_top(root, least, bounds);
    for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].vpl;
}

}  // namespace mir::detail
