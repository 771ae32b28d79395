// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/vpl_tree.hpp"
#include "mir/resident/uploaded_array.hpp"

namespace mir {

/// A VplTree in a backend's memory.
template <Backend B>
class UploadedVplTree {
 public:
    /// Starts the copies on `queue`; `tree` must live until they are done.
    UploadedVplTree(const B& backend, typename B::Queue& queue, const VplTree& tree)
        : leaves_(backend, queue, {tree.leaves().first, tree.size()}),
          sums_(backend, queue, tree.sums()),
          bounds_(backend, queue, tree.node_bounds()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] VplTreeView<B::space> view() const {
        return {leaves_.data(), sums_.data(), bounds_.data(),
                static_cast<std::uint32_t>(leaves_.size())};
    }

 private:
    UploadedArray<B, Vpl> leaves_;
    UploadedArray<B, std::uint64_t> sums_;
    UploadedArray<B, VplBounds> bounds_;
};

}  // namespace mir
