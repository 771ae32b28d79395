// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh_view.hpp"

#include <span>
#include <utility>
#include <vector>

namespace mir {

/// A wide bounding volume hierarchy in host memory. Const use from any thread. build_wide_bvh()
/// makes one of a scene.
class WideBvh {
 public:
    /// Of parts that keep what WideBvhView promises. There is a root at least, and as many
    /// `indices` as `triangles`.
    WideBvh(std::vector<WideNode> nodes, std::vector<TriangleRows> triangles,
            std::vector<std::uint32_t> indices, float reach)
        : nodes_(std::move(nodes)),
          triangles_(std::move(triangles)),
          indices_(std::move(indices)),
          reach_(reach) {}

    /// What traversal reads. Valid, as the spans below, until the hierarchy is assigned to, moved
    /// or ends.
    [[nodiscard]] WideBvhView<Space::host> view() const {
        return {nodes_.data(), triangles_.data(), indices_.data(), reach_};
    }

    /// The root first; children are numbered as WideNode::ref says.
    [[nodiscard]] std::span<const WideNode> nodes() const { return nodes_; }
    /// Rows of the triangles of leaves, leaf by leaf. One that was split stands in each of its
    /// leaves.
    [[nodiscard]] std::span<const TriangleRows> triangles() const { return triangles_; }
    /// Which triangle of WorldGeometry stands at each place of triangles().
    [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_; }

    /// Memory held, bytes.
    [[nodiscard]] std::size_t bytes() const {
        return nodes().size_bytes() + triangles().size_bytes() + indices().size_bytes();
    }

 private:
    std::vector<WideNode> nodes_;
    std::vector<TriangleRows> triangles_;
    std::vector<std::uint32_t> indices_;
    float reach_;
};

}  // namespace mir
