// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/write_wide.hpp"
#include "mir/resident/detail/wide_collapse.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/scene/triangle_choice.hpp"

namespace mir::detail {

/// A wide tree that only has to be written. Memory of the construction and the kernels that read
/// it.
template <Backend B>
class WideBuild {
 public:
    /// Of the triangles `chosen`. `queue` must outlive it.
    WideBuild(const B& backend, typename B::Queue& queue, const WorldGeometry& geometry,
              GeometryView<B::space> uploaded, const TriangleChoice<B::space>& chosen,
              const WideBvhOptions& options)
        : plan_(cluster_plan(geometry, chosen.count, options)),
          uploaded_(with_triangles(uploaded, chosen)),
          numbers_(chosen.numbers),
          split_(backend, queue, uploaded_, plan_),
          scratch_(backend.template buffer<std::byte>(queue.scratch_bytes(plan_.room() + 1))),
          tree_(backend, plan_),
          collapse_(backend, plan_),
          wait_(queue) {
        if (plan_.triangles == 0) return;
        tree_.build(queue, uploaded_, split_, scratch_);
        collapse_.run(queue, tree_, scratch_);
    }

    [[nodiscard]] std::uint32_t references() const { return collapse_.reference_count(); }
    [[nodiscard]] std::uint32_t nodes() const { return std::max(collapse_.node_count(), 1u); }
    [[nodiscard]] std::uint32_t depth() const { return std::max(collapse_.depth(), 1u); }
    [[nodiscard]] float reach() const { return plan_.reach; }

    /// Starts writing nodes() nodes, and references() rows and indices.
    void write(typename B::Queue& queue, const WideArrays& to) {
        if (plan_.triangles == 0) {
            queue.for_each(1, WriteEmptyRoot{to, plan_.reach});
            return;
        }
        queue.for_each(collapse_.node_count(), WriteWideNodes{tree_.view().nodes, collapse_.notes(),
                                                              to, plan_.leaf_size, plan_.reach});
        queue.for_each(references(), WriteRows<B::space>{uploaded_, to});
        if (numbers_ != nullptr) queue.for_each(references(), Renumber{numbers_, to.indices});
    }

 private:
    /// The chosen triangles alone; nothing else of triangles is read.
    static GeometryView<B::space> with_triangles(GeometryView<B::space> view,
                                                 const TriangleChoice<B::space>& chosen) {
        view.triangles = chosen.corners;
        return view;
    }

    ClusterPlan plan_;
    GeometryView<B::space> uploaded_;
    const std::uint32_t* numbers_;
    SplitPlan<B> split_;
    typename B::template Buffer<std::byte> scratch_;
    ClusterTree<B> tree_;
    WideCollapse<B> collapse_;
    WaitAtEnd<typename B::Queue> wait_;
};

}  // namespace mir::detail
