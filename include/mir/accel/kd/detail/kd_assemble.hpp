// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_grow.hpp"
#include "mir/accel/kd/kd_tree_view.hpp"

namespace mir::detail {

/// Where a part of the tree goes in the arrays of the whole. Each part counts its nodes from its
/// root, 0, and has its pairs of children behind it.
struct KdPlace {
    std::size_t root = 0;        ///< index of its root
    std::size_t first_pair = 0;  ///< of the others, which follow each other; even
    std::size_t first_reference = 0;
};

inline KdNode moved(KdNode node, const KdPlace& place) {
    if (node.is_leaf())
        return KdNode::leaf(node.first() + static_cast<std::uint32_t>(place.first_reference),
                            node.count());
    return KdNode::inner(node.axis(), node.split(),
                         node.below() - 1 + static_cast<std::uint32_t>(place.first_pair));
}

inline void copy_nodes(std::span<const KdNode> from, const KdPlace& place,
                       RawArray<KdNode>& nodes) {
    nodes[place.root] = moved(from[0], place);
    for (std::size_t i = 1; i < from.size(); ++i)
        nodes[place.first_pair + i - 1] = moved(from[i], place);
}

inline void copy_subtree(const KdGrown& from, const KdPlace& place, RawArray<KdNode>& nodes,
                         RawArray<std::uint32_t>& references) {
    copy_nodes(from.nodes(), place, nodes);
    std::copy(from.references().begin(), from.references().end(),
              references.data() + place.first_reference);
}

/// Joins the top and all subtrees.
/// @throws Error(limit_exceeded) when they have more references or nodes than may be.
template <Executor E>
void assemble(const KdTop& top, const std::vector<KdGrown>& grown, const KdTreeOptions& options,
              RawArray<KdNode>& nodes, RawArray<std::uint32_t>& references, E& executor) {
    constexpr std::size_t root = KdTreeView<Space::host>::root;
    const KdPlace place_of_top{root, root + 1, 0};
    std::vector<KdPlace> places(grown.size());
    KdPlace end{0, root + top.nodes.size(), 0};
    for (std::size_t i = 0; i < grown.size(); ++i) {
        places[i] = {root + top.open[i].node, end.first_pair, end.first_reference};
        end.first_pair += grown[i].nodes().size() - 1;
        end.first_reference += grown[i].references().size();
    }
    check_kd_size(end.first_pair, end.first_reference, options);
    nodes.resize(end.first_pair);
    references.resize(end.first_reference);
    nodes[0] = {};
    copy_nodes(top.nodes.span(), place_of_top, nodes);
    executor.for_each(grown.size(),
                      [&](std::size_t i) { copy_subtree(grown[i], places[i], nodes, references); });
}

}  // namespace mir::detail
