// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/backend_wide_bvh.hpp"
#include "mir/resident/uploaded_scene.hpp"

#include <vector>

namespace mirtest {

/// A BackendWideBvh brought home: what a WideBvh has to say about its nodes.
class CopiedWideBvh {
 public:
    template <mir::Backend B>
    CopiedWideBvh(typename B::Queue& queue, const mir::BackendWideBvh<B>& there)
        : nodes_(there.node_count()),
          triangles_(there.reference_count()),
          indices_(there.reference_count()),
          reach_(there.view().reach),
          depth_(there.depth()) {
        const mir::WaitAtEnd wait(queue);
        there.download(queue, nodes_, triangles_, indices_);
        queue.record().sync();
    }

    [[nodiscard]] std::span<const mir::WideNode> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const mir::TriangleRows> triangles() const { return triangles_; }
    [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_; }
    [[nodiscard]] std::uint32_t depth() const { return depth_; }
    [[nodiscard]] mir::WideBvhView<mir::Space::host> view() const {
        return {nodes_.data(), triangles_.data(), indices_.data(), reach_};
    }

 private:
    std::vector<mir::WideNode> nodes_;
    std::vector<mir::TriangleRows> triangles_;
    std::vector<std::uint32_t> indices_;
    float reach_;
    std::uint32_t depth_;
};

/// The tree that a backend builds.
template <mir::Backend B>
CopiedWideBvh build_wide_on(const B& backend, const mir::WorldGeometry& geometry,
                            const mir::WideBvhOptions& options = {}) {
    auto queue = backend.queue();
    const mir::UploadedGeometry<B> there(backend, queue, geometry);
    const mir::WaitAtEnd wait(queue);
    const mir::BackendWideBvh<B> bvh(backend, queue, geometry, there.view(), options);
    return {queue, bvh};
}

}  // namespace mirtest
