// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/cuts/vpl_bounds.hpp"
#include "mir/cuts/vpl_key.hpp"
#include "mir/cuts/vpl_node.hpp"
#include "mir/data/vpl_list.hpp"

#include <cstdint>
#include <cstring>
#include <limits>

namespace mir {

/// The nodes of a VplTree that as many halvings of its root make. Their numbers are the turns on
/// the way from the root, a bit each, 1 for the right half. A leaf on the way goes on to the left.
struct TreeLevel {
    std::uint32_t leaves = 0;  ///< of the tree, at least 1
    std::uint32_t depth = 0;   ///< halvings

    /// Numbers, some of them of no node.
    [[nodiscard]] MIR_HD constexpr std::uint32_t size() const { return 1u << depth; }
    /// Leaves of the largest node.
    [[nodiscard]] MIR_HD constexpr std::uint32_t largest() const {
        return ((leaves - 1) >> depth) + 1;
    }
    /// The node of a number; one without leaves where there is none.
    [[nodiscard]] MIR_HD constexpr VplNode node(std::uint32_t number) const {
        VplNode node{0, 0, leaves};
        for (std::uint32_t bit = depth; bit-- > 0;) {
            const bool is_right = (number >> bit & 1u) != 0;
            if (node.is_leaf() && is_right) return {};
            if (!node.is_leaf()) node = is_right ? node.right() : node.left();
        }
        return node;
    }
    /// Number of the node that has a leaf.
    [[nodiscard]] MIR_HD constexpr std::uint32_t number_at(std::uint32_t leaf) const {
        VplNode node{0, 0, leaves};
        std::uint32_t number = 0;
        for (std::uint32_t bit = depth; bit-- > 0;) {
            number *= 2;
            if (node.is_leaf()) continue;
            const bool is_right = leaf >= node.right().first;
            number += is_right ? 1 : 0;
            node = is_right ? node.right() : node.left();
        }
        return number;
    }
};

/// Bounds of some VPLs in the six dimensions of their keys, and their largest luminance.
struct KeyBounds {
    float low[6];
    float high[6];
    float most;
};

/// Kernel for groups of lanes: bounds of parts of the nodes of a level, `parts` of each node.
template <Space S>
struct BoundParts {
    /// Not used.
    struct Workspace {};

    static constexpr std::uint32_t part_size = 2048;  ///< leaves, the last has what is left

    VplSpan<S> vpls;                       ///< those that shine
    const std::uint32_t* order = nullptr;  ///< of `vpls`, as they are halved so far
    TreeLevel level;                       ///< of these halves
    float scale = 0.0f;                    ///< of normals (vpl_key())
    std::uint32_t parts = 0;               ///< of a node
    KeyBounds* out = nullptr;              ///< written; not where a node has one leaf or none

    /// Part i % parts of node i / parts.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        const VplNode node = level.node(i / parts);
        if (node.count < 2) return;
        const std::uint32_t first = node.first + i % parts * part_size;
        const std::uint32_t end = node.first + node.count;
        const std::uint32_t last = first + part_size < end ? first + part_size : end;
        LaneGroup::PerLane<KeyBounds> own;
        group.each_apart([&](std::uint32_t lane) {
            own[lane] = nothing();
            for (std::uint32_t p = first + lane; p < last; p += LaneGroup::width)
                add(own[lane], vpls[order[p]]);
        });
        for (std::uint32_t axis = 0; axis < 6; ++axis) {
            LaneGroup::PerLane<float> low, high;
            group.each_apart([&](std::uint32_t lane) {
                low[lane] = own[lane].low[axis];
                high[lane] = own[lane].high[axis];
            });
            const float least = group.smallest(low);
            const float most = group.largest(high);
            group.each([&](std::uint32_t lane) {
                if (lane != 0) return;
                out[i].low[axis] = least;
                out[i].high[axis] = most;
            });
        }
        LaneGroup::PerLane<float> luminances;
        group.each_apart([&](std::uint32_t lane) { luminances[lane] = own[lane].most; });
        const float most = group.largest(luminances);
        group.each([&](std::uint32_t lane) {
            if (lane == 0) out[i].most = most;
        });
    }

 private:
    static constexpr float far = std::numeric_limits<float>::max();

    MIR_HD static KeyBounds nothing() {
        return {{far, far, far, far, far, far}, {-far, -far, -far, -far, -far, -far}, 0.0f};
    }
    MIR_HD void add(KeyBounds& bounds, const Vpl& vpl) const {
        for (int axis = 0; axis < 6; ++axis) {
            const float at = vpl_key(vpl, scale, axis);
            bounds.low[axis] = smaller(at, bounds.low[axis]);
            bounds.high[axis] = larger(at, bounds.high[axis]);
        }
        bounds.most = larger(luminance(vpl.intensity), bounds.most);
    }
};

/// Kernel over the nodes of a level: bounds of all their parts, and the axis to halve them along.
struct JoinParts {
    TreeLevel level;                    ///< of the nodes
    std::uint32_t parts = 0;            ///< of each
    const KeyBounds* bounds = nullptr;  ///< of parts
    VplBounds* out = nullptr;           ///< written by VplNode::place; not of leaves
    std::uint32_t* axes = nullptr;      ///< written, by number

    /// Node of number i.
    MIR_HD void operator()(std::uint32_t i) const {
        const VplNode node = level.node(i);
        axes[i] = 0;
        if (node.count < 2) return;
        const std::uint32_t used = (node.count - 1) / part_size + 1;
        KeyBounds all = bounds[std::size_t{i} * parts];
        for (std::uint32_t k = 1; k < used; ++k) {
            const KeyBounds& part = bounds[std::size_t{i} * parts + k];
            for (int axis = 0; axis < 6; ++axis) {
                all.low[axis] = smaller(part.low[axis], all.low[axis]);
                all.high[axis] = larger(part.high[axis], all.high[axis]);
            }
            all.most = larger(part.most, all.most);
        }
        out[node.place] = {{all.low[0], all.low[1], all.low[2]},
                           {all.high[0], all.high[1], all.high[2]},
                           all.most};
        axes[i] = widest_axis(all.low, all.high);
    }

 private:
    static constexpr std::uint32_t part_size = BoundParts<Space::host>::part_size;
};

/// Kernel over VPLs: before they are halved, the list's order, and all in the root.
struct StartOrder {
    std::uint32_t* order = nullptr;    ///< written
    std::uint32_t* numbers = nullptr;  ///< written

    /// VPL j.
    MIR_HD void operator()(std::uint32_t j) const {
        order[j] = j;
        numbers[j] = 0;
    }
};

/// Kernel over VPLs: what sorts them by node, and in each along its axis. Equal ones stay in the
/// order of the list.
template <Space S>
struct SortKeys {
    VplSpan<S> vpls;                         ///< those that shine
    float scale = 0.0f;                      ///< of normals (vpl_key())
    const std::uint32_t* numbers = nullptr;  ///< of the node of each VPL
    const std::uint32_t* axes = nullptr;     ///< of the nodes
    std::uint64_t* keys = nullptr;           ///< written
    std::uint32_t* order = nullptr;          ///< written: the list's

    /// VPL j.
    MIR_HD void operator()(std::uint32_t j) const {
        const std::uint32_t number = numbers[j];
        const float at = vpl_key(vpls[j], scale, static_cast<int>(axes[number]));
        keys[j] = std::uint64_t{number} << 32 | place_in_order(at + 0.0f);  // -0 becomes 0
        order[j] = j;
    }

 private:
    /// A whole number in the order of those that are none.
    MIR_HD static std::uint32_t place_in_order(float at) {
        std::uint32_t bits = 0;
        memcpy(&bits, &at, 4);
        return bits ^ ((bits >> 31) != 0 ? 0xFFFFFFFFu : 0x80000000u);
    }
};

/// Kernel over places in leaf order: nodes of the VPLs that lie there.
struct NumberNodes {
    TreeLevel level;                       ///< of the nodes
    const std::uint32_t* order = nullptr;  ///< VPLs by place
    std::uint32_t* numbers = nullptr;      ///< written by VPL

    /// Place p.
    MIR_HD void operator()(std::uint32_t p) const { numbers[order[p]] = level.number_at(p); }
};

/// Kernel over the leaves and one more place: VPLs in leaf order and the parts of their weights.
template <Space S>
struct PlaceVpls {
    VplSpan<S> vpls;                       ///< those that shine
    const std::uint32_t* order = nullptr;  ///< of them, by leaf
    float most = 0.0f;                     ///< root of the largest luminance
    Vpl* leaves = nullptr;                 ///< written
    std::uint32_t* low = nullptr;          ///< written: the lowest bits of weights
    std::uint32_t* high = nullptr;         ///< written: all others

    static constexpr std::uint32_t low_bits = 10;  ///< sums of 2^22 such numbers have 32

    /// Leaf p.
    MIR_HD void operator()(std::uint32_t p) const {
        low[p] = high[p] = 0;
        if (p == vpls.size()) return;
        const Vpl vpl = vpls[order[p]];
        const std::uint64_t weight = pick_weight(vpl, most);
        leaves[p] = vpl;
        low[p] = static_cast<std::uint32_t>(weight) & ((1u << low_bits) - 1u);
        high[p] = static_cast<std::uint32_t>(weight >> low_bits);
    }
};

/// Kernel over the leaves and one more place: sums of weights from those of their parts.
struct JoinSums {
    const std::uint32_t* low = nullptr;   ///< sums
    const std::uint32_t* high = nullptr;  ///< sums
    std::uint64_t* sums = nullptr;        ///< written
    std::uint32_t low_bits = 0;           ///< PlaceVpls::low_bits

    /// Place p.
    MIR_HD void operator()(std::uint32_t p) const {
        sums[p] = (std::uint64_t{high[p]} << low_bits) + low[p];
    }
};

}  // namespace mir
