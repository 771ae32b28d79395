// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/collapse_level.hpp"
#include "mir/resident/detail/cluster_tree.hpp"

namespace mir::detail {

/// Chooses which binary nodes become those of a wide tree, level by level.
template <Backend B>
class WideCollapse {
 public:
    WideCollapse(const B& backend, const ClusterPlan& plan)
        : plan_(plan),
          roots_(backend.template buffer<std::uint32_t>(most_nodes(plan))),
          children_(backend.template buffer<WideChildren>(most_nodes(plan))),
          first_child_(backend.template buffer<std::uint32_t>(most_nodes(plan))),
          first_triangle_(backend.template buffer<std::uint32_t>(most_nodes(plan))),
          inner_(backend.template buffer<std::uint32_t>(most_nodes(plan) + 1)),
          inner_before_(backend.template buffer<std::uint32_t>(most_nodes(plan) + 1)),
          next_size_(backend) {}

    /// All of it. There are triangles.
    void run(typename B::Queue& queue, const ClusterTree<B>& tree,
             typename B::template Buffer<std::byte>& scratch) {
        queue.for_each(1, StartAtRoot{tree.all(), tree.view().nodes, notes(), next_size_.data()});
        references_ = next_size_.read(queue);
        while (level_.size > 0) {
            choose(queue, tree, scratch);
            const std::uint32_t size = next_size_.read(queue);
            level_ = {level_.end(), size, level_.depth + 1};
        }
    }

    [[nodiscard]] std::uint32_t node_count() const { return level_.begin; }
    /// In leaves.
    [[nodiscard]] std::uint32_t reference_count() const { return references_; }
    [[nodiscard]] std::uint32_t depth() const { return level_.depth; }
    [[nodiscard]] WideNotes notes() {
        return {roots_.data(), children_.data(), first_child_.data(), first_triangle_.data()};
    }

 private:
    /// Room for wide nodes. Each is made of a node of the binary tree that has two children.
    static std::size_t most_nodes(const ClusterPlan& plan) {
        return std::max(plan.references, 2u) - 1;
    }

    void choose(typename B::Queue& queue, const ClusterTree<B>& tree,
                typename B::template Buffer<std::byte>& scratch) {
        const ChildChoice choice{tree.view(), plan_.leaf_size, plan_.max_depth, plan_.area_scale};
        const std::uint32_t n = level_.size + 1;
        queue.for_each(n, ChooseChildren{choice, notes(), inner_.data(), level_});
        queue.sum_before(n, inner_.data(), inner_before_.data(), scratch);
        queue.for_each(n, NumberChildren{tree.view().nodes, inner_before_.data(), notes(),
                                         next_size_.data(), level_, plan_.leaf_size});
    }

    template <class T>
    using Buffer = typename B::template Buffer<T>;

    ClusterPlan plan_;
    Buffer<std::uint32_t> roots_;
    Buffer<WideChildren> children_;
    Buffer<std::uint32_t> first_child_;
    Buffer<std::uint32_t> first_triangle_;
    Buffer<std::uint32_t> inner_;
    Buffer<std::uint32_t> inner_before_;
    Counter<B> next_size_;
    std::uint32_t references_ = 0;
    WideLevel level_;
};

}  // namespace mir::detail
