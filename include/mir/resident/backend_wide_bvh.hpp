// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh_view.hpp"
#include "mir/resident/wide_builder.hpp"

#include <span>

namespace mir {

/// A wide bounding volume hierarchy that a backend builds in its memory. It holds all triangles of
/// a scene and is the tree that build_wide_bvh() makes on the host, equal in bytes on every backend
/// and for any number of threads. Move only if the backend's buffers are; const use from any
/// thread.
template <Backend B>
class BackendWideBvh {
 public:
    /// Builds from the leaves up. Triangles are sorted by the places of their accept boxes
    /// (accept_box.hpp) along Morton's curve. Of these clusters, those that are nearest to each
    /// other among their neighbours on the curve are joined, all at the same time, until one is
    /// left. The binary tree becomes a wide one from the root down; which of its nodes stay is what
    /// costs least by the surface area heuristic (WideBvhOptions::node_cost). Some dozens of
    /// rounds, never more than three for each node of depth; up to half a kilobyte of the backend's
    /// memory per triangle meanwhile. Triangles whose boxes are mostly empty may be split before
    /// (WideBvhOptions::splits).
    /// `uploaded` views `geometry` in the backend's memory, for which kernels on `queue` need not
    /// wait. All work is done when it returns.
    /// Sources: Meister and Bittner, "Parallel locally-ordered clustering for bounding volume
    /// hierarchy construction", IEEE TVCG 24(3), 2018; Ylitie, Karras and Laine, "Efficient
    /// incoherent ray traversal on GPUs through compressed wide BVHs", High Performance Graphics
    /// 2017.
    /// @throws Error(invalid_argument) on options out of range; Error(invalid_input) on coordinates
    ///         beyond 1e36 metres; Error(limit_exceeded) on 2^31 triangles and more, 2^30
    ///         where they are to be split; what the backend throws.
    BackendWideBvh(const B& backend, typename B::Queue& queue, const WorldGeometry& geometry,
                   GeometryView<B::space> uploaded, const WideBvhOptions& options = {})
        : BackendWideBvh(backend, queue, geometry, uploaded,
                         TriangleChoice<B::space>::all(geometry, uploaded), options) {}

    /// The same of some triangles alone, with the reach of the whole scene.
    BackendWideBvh(const B& backend, typename B::Queue& queue, const WorldGeometry& geometry,
                   GeometryView<B::space> uploaded, const TriangleChoice<B::space>& chosen,
                   const WideBvhOptions& options = {})
        : BackendWideBvh(
              backend, queue,
              detail::WideBuild<B>(backend, queue, geometry, uploaded, chosen, options)) {}

    /// For kernels on any queue; valid until this is moved or ends.
    [[nodiscard]] WideBvhView<B::space> view() const {
        return {nodes_.data(), rows_.data(), indices_.data(), reach_};
    }

    /// Wide nodes, the root included.
    [[nodiscard]] std::size_t node_count() const { return nodes_.size(); }
    /// Triangles in leaves; those that were split lie in several.
    [[nodiscard]] std::size_t reference_count() const { return rows_.size(); }
    /// Most nodes on the way from the root to a triangle; 1 without triangles.
    [[nodiscard]] std::uint32_t depth() const { return depth_; }

    /// Starts copying the tree to the host: node_count() nodes, and reference_count() triangles and
    /// their indices. What it copies to must live until that is done.
    void download(typename B::Queue& queue, std::span<WideNode> nodes,
                  std::span<TriangleRows> triangles, std::span<std::uint32_t> indices) const {
        queue.download(nodes_, nodes);
        queue.download(rows_, triangles);
        queue.download(indices_, indices);
    }

    /// Memory held, bytes.
    [[nodiscard]] std::size_t bytes() const {
        return node_count() * sizeof(WideNode) +
               reference_count() * (sizeof(TriangleRows) + sizeof(std::uint32_t));
    }

 private:
    BackendWideBvh(const B& backend, typename B::Queue& queue, detail::WideBuild<B>&& build)
        : nodes_(backend.template buffer<WideNode>(build.nodes())),
          rows_(backend.template buffer<TriangleRows>(build.references())),
          indices_(backend.template buffer<std::uint32_t>(build.references())),
          reach_(build.reach()),
          depth_(build.depth()) {
        const WaitAtEnd wait(queue);
        build.write(queue, {nodes_.data(), rows_.data(), indices_.data()});
        queue.record().sync();
    }

    template <class T>
    using Buffer = typename B::template Buffer<T>;

    Buffer<WideNode> nodes_;
    Buffer<TriangleRows> rows_;  ///< leaf by leaf
    Buffer<std::uint32_t> indices_;
    float reach_ = 0.0f;
    std::uint32_t depth_ = 1;
};

}  // namespace mir
