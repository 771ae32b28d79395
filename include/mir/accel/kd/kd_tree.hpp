// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/raw_array.hpp"
#include "mir/accel/kd/kd_options.hpp"
#include "mir/accel/kd/kd_statistics.hpp"
#include "mir/accel/kd/kd_tree_view.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/scene/world_geometry.hpp"

#include <span>
#include <vector>

namespace mir {

namespace detail {
struct KdGrown;
struct KdTally;
}  // namespace detail

/// A kd-tree over all triangles of a scene, in host memory. Move only; const use from any thread.
/// Equal in bytes for any number of threads. The constructor is defined in kd_build.hpp.
class KdTree {
 public:
    /// Builds by the surface area heuristic. Planes at the ends of clipped triangles, exact below
    /// and beside the best of up to 256 borders in large nodes. A leaf lists every triangle that
    /// may be accepted (accept_box.hpp) in its closed cell. O(N log N). Source: Wald and Havran,
    /// "On building fast kd-trees for ray tracing, and on doing that in O(N log N)", IEEE Symposium
    /// on Interactive Ray Tracing 2006.
    /// @throws Error(invalid_argument) on options out of range; Error(invalid_input) on coordinates
    ///         beyond 1e36 metres; Error(limit_exceeded) on more than options.max_references.
    template <Executor E>
    KdTree(const WorldGeometry& geometry, const KdTreeOptions& options, E& executor);

    /// What traversal reads. Valid, as the spans below, until the tree is assigned to, moved or
    /// ends.
    [[nodiscard]] KdTreeView<Space::host> view() const {
        return {nodes_.data(), references_.data(), triangles_.data(), low_, high_, reach_};
    }
    /// What the tree looks like and how long each stage of its construction took.
    [[nodiscard]] const KdTreeStatistics& statistics() const { return statistics_; }

    /// As KdTreeView counts them: node 0 is never visited.
    [[nodiscard]] std::span<const KdNode> nodes() const { return nodes_.span(); }
    /// Triangle indices of WorldGeometry, leaf by leaf; KdNode::first() is a place here.
    [[nodiscard]] std::span<const std::uint32_t> references() const { return references_.span(); }
    /// Rows of every triangle, by index of WorldGeometry.
    [[nodiscard]] std::span<const TriangleRows> triangles() const { return triangles_.span(); }

    /// Memory held, bytes.
    [[nodiscard]] std::size_t bytes() const {
        return nodes().size_bytes() + references().size_bytes() + triangles().size_bytes();
    }

 private:
    void count_parts(detail::KdTally total, const std::vector<detail::KdGrown>& grown);

    detail::RawArray<KdNode> nodes_;
    detail::RawArray<std::uint32_t> references_;
    detail::RawArray<TriangleRows> triangles_;
    Vec3 low_{0};
    Vec3 high_{0};
    float reach_ = 0.0f;
    KdTreeStatistics statistics_;
};

}  // namespace mir
