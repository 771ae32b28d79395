// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree.hpp"
#include "mir/resident/uploaded_array.hpp"

namespace mir {

/// A KdTree in a backend's memory.
template <Backend B>
class UploadedKdTree {
 public:
    /// Starts the copies on `queue`; `tree` must live until they are done.
    UploadedKdTree(const B& backend, typename B::Queue& queue, const KdTree& tree)
        : nodes_(backend, queue, tree.nodes()),
          references_(backend, queue, tree.references()),
          triangles_(backend, queue, tree.triangles()),
          bounds_(tree.view()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] KdTreeView<B::space> view() const {
        return {nodes_.data(), references_.data(), triangles_.data(),
                bounds_.low,   bounds_.high,       bounds_.reach};
    }

 private:
    UploadedArray<B, KdNode> nodes_;
    UploadedArray<B, std::uint32_t> references_;
    UploadedArray<B, TriangleRows> triangles_;
    KdTreeView<Space::host> bounds_;
};

}  // namespace mir
