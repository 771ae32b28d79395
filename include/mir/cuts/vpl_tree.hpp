// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/error.hpp"
#include "mir/cuts/detail/halve_vpls.hpp"
#include "mir/cuts/vpl_tree_view.hpp"
#include "mir/data/vpl_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace mir {

/// A balanced binary tree over VPLs, for cuts. A node is a range of the leaf order: the VPLs are
/// halved again and again along the widest axis of their places and normals. Black VPLs are left
/// out. Each VPL has a pick weight, a whole number that grows with the root of its luminance, and
/// the tree keeps the sums of those before it, so that a node picks one of its VPLs by one random
/// number. The tree is the same for any number of threads. Copies share what they hold. Const use
/// from any thread.
/// Source: Walter et al., "Lightcuts", SIGGRAPH 2005 (tree over lights with normals); Yuksel,
/// "Stochastic Lightcuts", HPG 2019 (one pick a node).
class VplTree {
 public:
    /// Copies the VPLs. Spread over `executor`.
    /// @throws Error(invalid_argument) for an intensity, place or normal that is not finite.
    template <Executor E>
    VplTree(VplSpan<Space::host> vpls, E& executor);

    /// The VPLs in leaf order.
    [[nodiscard]] VplSpan<Space::host> leaves() const { return span_of(content_->leaves); }
    /// Index in the list that it was made of, of each leaf.
    [[nodiscard]] std::span<const VplIndex> order() const { return content_->order; }
    /// Number of leaves.
    [[nodiscard]] std::uint32_t size() const {
        return static_cast<std::uint32_t>(content_->leaves.size());
    }
    /// The node of all leaves. There must be some.
    [[nodiscard]] VplNode root() const { return {0, 0, size()}; }
    /// Sum of the pick weights of the leaves before `leaf`, 0..size().
    [[nodiscard]] std::uint64_t weight_before(std::uint32_t leaf) const {
        return content_->sums[leaf];
    }
    /// Sum of the pick weights of a node's leaves.
    [[nodiscard]] std::uint64_t weight(const VplNode& node) const { return view().weight(node); }
    /// Bounds of a node.
    [[nodiscard]] const VplBounds& bounds(const VplNode& node) const {
        return content_->bounds[node.place];
    }

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
        const Content& c = *content_;
        return {c.leaves.data(), c.sums.data(), c.bounds.data(), size()};
    }
    /// Sums of weights as the view has them, for copies: size() + 1 of them.
    [[nodiscard]] std::span<const std::uint64_t> sums() const { return content_->sums; }
    /// Bounds as the view has them, for copies.
    [[nodiscard]] std::span<const VplBounds> node_bounds() const { return content_->bounds; }
    /// True for this and its copies.
    [[nodiscard]] bool is(const VplTree& other) const { return content_ == other.content_; }

 private:
    struct Content {
        std::vector<VplIndex> order;
        std::vector<Vpl> leaves;
        std::vector<std::uint64_t> sums;
        std::vector<VplBounds> bounds;
    };

    std::shared_ptr<const Content> content_;
};

template <Executor E>
VplTree::VplTree(VplSpan<Space::host> vpls, E& executor) {
    Content made;
    float most = 0.0f;
    for (VplIndex j = 0; j < vpls.size(); ++j) {
        const Vpl& v = vpls[j];
        expects(is_finite(v.intensity) && std::isfinite(glm::dot(v.position, v.normal)),
                "a VPL has an intensity, a place or a normal that is not finite (a cut cannot "
                "bound it); leave such VPLs out");
        if (is_black(v.intensity)) continue;
        made.order.push_back(j);
        most = std::max(most, std::sqrt(luminance(v.intensity)));
    }
    detail::halve_vpls(vpls, made.order, made.bounds, executor);
    made.leaves.resize(made.order.size());
    made.sums.assign(made.order.size() + 1, 0);
    constexpr float steps = 0x1p20f;
    for (std::size_t i = 0; i < made.order.size(); ++i) {
        made.leaves[i] = vpls[made.order[i]];
        const float share = std::sqrt(std::max(luminance(made.leaves[i].intensity), 0.0f)) / most;
        made.sums[i + 1] = made.sums[i] + 1 + static_cast<std::uint64_t>(share * steps);
    }
    content_ = std::make_shared<const Content>(std::move(made));
}

}  // namespace mir
