// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/kd_grow.hpp"

namespace mir::detail {

/// Where a subtree goes in the arrays of the whole tree.
struct KdPlace {
    std::size_t root = 0;        ///< index of its root, in the top
    std::size_t first_node = 0;  ///< of the others, which follow each other
    std::size_t first_reference = 0;
};

inline KdNode moved(KdNode node, const KdPlace& place) {
    if (node.is_leaf())
        return KdNode::leaf(node.first() + static_cast<std::uint32_t>(place.first_reference),
                            node.count());
    // Node 0 of a subtree is its root, which lies elsewhere.
    return KdNode::inner(node.axis(), node.split(),
                         node.below() + static_cast<std::uint32_t>(place.first_node) - 1);
}

inline void copy_subtree(const KdGrown& from, const KdPlace& place, RawArray<KdNode>& nodes,
                         RawArray<std::uint32_t>& references) {
    const std::span<const KdNode> source = from.nodes();
    nodes[place.root] = moved(source[0], place);
    for (std::size_t i = 1; i < source.size(); ++i)
        nodes[place.first_node + i - 1] = moved(source[i], place);
    std::copy(from.references().begin(), from.references().end(),
              references.data() + place.first_reference);
}

/// Joins the top and all subtrees.
/// @throws Error(limit_exceeded) when they have more references or nodes than may be.
template <Executor E>
void assemble(const KdTop& top, const std::vector<KdGrown>& grown, const KdTreeOptions& options,
              RawArray<KdNode>& nodes, RawArray<std::uint32_t>& references, E& executor) {
    std::vector<KdPlace> places(grown.size());
    KdPlace end{0, top.nodes.size(), 0};
    for (std::size_t i = 0; i < grown.size(); ++i) {
        places[i] = {top.open[i].node, end.first_node, end.first_reference};
        end.first_node += grown[i].nodes().size() - 1;
        end.first_reference += grown[i].references().size();
    }
    check_kd_size(end.first_node, end.first_reference, options);
    nodes.resize(end.first_node);
    references.resize(end.first_reference);
    std::copy_n(top.nodes.data(), top.nodes.size(), nodes.data());
    executor.for_each(grown.size(),
                      [&](std::size_t i) { copy_subtree(grown[i], places[i], nodes, references); });
}

}  // namespace mir::detail
