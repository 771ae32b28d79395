// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/cuts/detail/halve_vpls.hpp"
#include "mir/cuts/vpl_key.hpp"
#include "mir/cuts/vpl_tree_view.hpp"
#include "mir/data/vpl_list.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace mir {

/// A balanced binary tree over VPLs, for cuts. A node is a range of the leaf order: the VPLs are
/// halved again and again along the widest axis of their places and normals. Black VPLs are left
/// out. Each VPL has a pick weight, a whole number that grows with the root of its luminance, and
/// the tree keeps the sums of those before it, so that a node picks one of its VPLs by one random
/// number. The tree is the same for any number of threads. Const use from any thread.
/// Source: Walter et al., "Lightcuts", SIGGRAPH 2005 (tree over lights with normals); Yuksel,
/// "Stochastic Lightcuts", HPG 2019 (one pick a node).
class VplTree {
 public:
    /// Copies the VPLs. Spread over `executor`.
    /// @throws Error(invalid_argument) for an intensity, place or normal that is not finite.
    template <Executor E>
    VplTree(VplSpan<Space::host> vpls, E& executor);

    /// The VPLs in leaf order.
    [[nodiscard]] VplSpan<Space::host> leaves() const { return span_of(leaves_); }
    /// Index in the list that it was made of, of each leaf.
    [[nodiscard]] std::span<const VplIndex> order() const { return order_; }
    /// Number of leaves.
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(leaves_.size()); }
    /// The node of all leaves. There must be some.
    [[nodiscard]] VplNode root() const { return {0, 0, size()}; }
    /// Sum of the pick weights of the leaves before `leaf`, 0..size().
    [[nodiscard]] std::uint64_t weight_before(std::uint32_t leaf) const { return sums_[leaf]; }
    /// Sum of the pick weights of a node's leaves.
    [[nodiscard]] std::uint64_t weight(const VplNode& node) const {
        return sums_[node.first + node.count] - sums_[node.first];
    }
    /// Bounds of a node.
    [[nodiscard]] const VplBounds& bounds(const VplNode& node) const { return bounds_[node.place]; }

    /// See VplTreeView::pick().
    [[nodiscard]] std::uint32_t pick(const VplNode& node, std::uint64_t u) const {
        return view().pick(node, u);
    }
    /// The inverse of the probability with which a node picks one of its leaves.
    [[nodiscard]] float inverse_probability(const VplNode& node, std::uint32_t leaf) const {
        return view().inverse_probability(node, leaf);
    }

    /// Itself, without owning; valid as long as this.
    [[nodiscard]] VplTreeView<Space::host> view() const {
        return {leaves_.data(), sums_.data(), bounds_.data(), size()};
    }

 private:
    std::vector<VplIndex> order_;
    std::vector<Vpl> leaves_;
    std::vector<std::uint64_t> sums_;
    std::vector<VplBounds> bounds_;
};

template <Executor E>
VplTree::VplTree(VplSpan<Space::host> vpls, E& executor) {
    ShiningVpls shining(vpls);
    order_ = std::move(shining.order);
    detail::halve_vpls(vpls, shining.normal_scale, order_, bounds_, executor);
    leaves_.resize(order_.size());
    sums_.assign(order_.size() + 1, 0);
    for (std::size_t i = 0; i < order_.size(); ++i) {
        leaves_[i] = vpls[order_[i]];
        sums_[i + 1] = sums_[i] + pick_weight(leaves_[i], shining.most);
    }
}

}  // namespace mir
