// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree.hpp"
#include "mir/micro/surfel_tree.hpp"
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

/// A SurfelTree in a backend's memory.
template <Backend B>
class UploadedSurfelTree {
 public:
    /// Starts the copies on `queue`; `tree` must live until they are done.
    UploadedSurfelTree(const B& backend, typename B::Queue& queue, const SurfelTree& tree)
        : nodes_(backend, queue, tree.nodes()),
          albedo_(backend, queue, tree.albedo()),
          surfels_(backend, queue, tree.surfels()),
          area_(backend, queue, tree.area()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] SurfelTreeView<B::space> view() const {
        return {nodes_.data(), albedo_.data(), surfels_.data(), area_.data(),
                static_cast<std::uint32_t>(nodes_.size())};
    }

 private:
    UploadedArray<B, SurfelNode> nodes_;
    UploadedArray<B, Rgb> albedo_;
    UploadedArray<B, Surfel> surfels_;
    UploadedArray<B, float> area_;
};

}  // namespace mir
