// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh.hpp"
#include "mir/resident/quantised_bvh.hpp"
#include "mir/resident/uploaded_array.hpp"

namespace mirtest {

/// A WideBvh in a backend's memory, and its nodes in short.
template <mir::Backend B>
class UploadedWideBvh {
 public:
    /// Starts the copies on `queue`; `bvh` must live until they are done.
    UploadedWideBvh(const B& backend, typename B::Queue& queue, const mir::WideBvh& bvh)
        : nodes_(backend, queue, bvh.nodes()),
          triangles_(backend, queue, bvh.triangles()),
          indices_(backend, queue, bvh.indices()),
          reach_(bvh.view().reach),
          short_(backend, queue, view(), bvh.nodes().size()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] mir::WideBvhView<B::space> view() const {
        return {nodes_.data(), triangles_.data(), indices_.data(), reach_};
    }
    /// The same, for shafts.
    [[nodiscard]] mir::QuantisedBvhView<B::space> quantised() const { return short_.view(); }

 private:
    mir::UploadedArray<B, mir::WideNode> nodes_;
    mir::UploadedArray<B, mir::TriangleRows> triangles_;
    mir::UploadedArray<B, std::uint32_t> indices_;
    float reach_;
    mir::QuantisedBvh<B> short_;
};

}  // namespace mirtest
