// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/raw_array.hpp"
#include "mir/accel/wide_bvh_view.hpp"
#include "mir/accel/wide_options.hpp"
#include "mir/accel/wide_statistics.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/scene/world_geometry.hpp"

#include <span>
#include <vector>

namespace mir {

namespace detail {
struct WideTally;
}  // namespace detail

/// A wide bounding volume hierarchy over all triangles of a scene, in host memory. Move only; const
/// use from any thread. Equal in bytes for any number of threads. The constructor is defined in
/// wide_build.hpp.
class WideBvh {
 public:
    /// Builds from the root down. A node starts as one group of triangles; the group with the
    /// largest surface is cut in two until there are eight. Cuts follow the surface area heuristic
    /// over binned centres of accept boxes (accept_box.hpp); triangles are not split, so each lies
    /// in one leaf. O(N log N).
    /// Sources: Wald, Benthin and Boulos, "Getting rid of packets: efficient SIMD single-ray
    /// traversal using multi-branching BVHs", IEEE Symposium on Interactive Ray Tracing 2008;
    /// Wald, "On fast construction of SAH-based bounding volume hierarchies", the same 2007.
    /// @throws Error(invalid_argument) on options out of range; Error(invalid_input) on coordinates
    ///         beyond 1e36 metres.
    template <Executor E>
    WideBvh(const WorldGeometry& geometry, const WideBvhOptions& options, E& executor);

    [[nodiscard]] WideBvhView<Space::host> view() const {
        return {nodes_.data(), triangles_.data(), indices_.data(), reach_};
    }
    [[nodiscard]] const WideBvhStatistics& statistics() const { return statistics_; }

    [[nodiscard]] std::span<const WideNode> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const TriangleRows> triangles() const { return triangles_.span(); }
    [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_.span(); }

    /// Memory held, bytes.
    [[nodiscard]] std::size_t bytes() const {
        return nodes().size_bytes() + triangles().size_bytes() + indices().size_bytes();
    }

 private:
    void count_parts(const detail::WideTally& tally);

    std::vector<WideNode> nodes_;
    detail::RawArray<TriangleRows> triangles_;
    detail::RawArray<std::uint32_t> indices_;
    float reach_ = 0.0f;
    WideBvhStatistics statistics_;
};

}  // namespace mir
