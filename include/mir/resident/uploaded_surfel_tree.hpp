// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_tree.hpp"
#include "mir/resident/uploaded_array.hpp"

namespace mir {

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
