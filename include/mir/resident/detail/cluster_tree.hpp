// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/find_partners.hpp"
#include "mir/accel/detail/join_clusters.hpp"
#include "mir/accel/detail/make_clusters.hpp"
#include "mir/accel/detail/wide_children.hpp"
#include "mir/resident/detail/counter.hpp"

#include <array>

namespace mir::detail {

/// A binary tree over all triangles of a scene in a backend's memory, made by joining clusters that
/// lie next to each other. Equal in bytes on every backend.
template <Backend B>
class ClusterTree {
 public:
    ClusterTree(const B& backend, const ClusterPlan& plan)
        : plan_(plan),
          nodes_(backend.template buffer<BinaryNode>(2 * std::size_t{plan.room()} - 1)),
          costs_(backend.template buffer<SlotCosts>(2 * std::size_t{plan.room()} - 1)),
          clusters_{backend.template buffer<Cluster>(plan.room()),
                    backend.template buffer<Cluster>(plan.room())},
          keys_(backend.template buffer<std::uint64_t>(plan.room())),
          partners_(backend.template buffer<std::uint32_t>(plan.room())),
          kept_(backend.template buffer<std::uint32_t>(std::size_t{plan.room()} + 1)),
          kept_before_(backend.template buffer<std::uint32_t>(std::size_t{plan.room()} + 1)),
          left_(backend) {}

    /// Does all of it but the last steps, which it starts. There are triangles. The scratch is for
    /// one element more than these.
    void build(typename B::Queue& queue, GeometryView<B::space> geometry,
               typename B::template Buffer<std::byte>& scratch) {
        const std::uint32_t n = plan_.triangles;
        queue.for_each(
            n, MakeBoxes<B::space>{geometry, plan_, next(), keys_.data(), partners_.data()});
        queue.sort_by_key(n, keys_.data(), partners_.data(), scratch);
        queue.for_each(n, PlaceLeaves{next(), partners_.data(), nodes_.data(), costs_.data(), now(),
                                      plan_.area_scale});
        std::uint32_t count = n;
        for (std::uint32_t rounds = 0; count > 1; ++rounds) {
            find_partners(queue, rounds, count);
            count = join(queue, count, 2 * n - count, scratch);
        }
    }

    [[nodiscard]] CostedTree view() const { return {nodes_.data(), costs_.data()}; }
    /// The cluster that holds everything.
    [[nodiscard]] const Cluster* all() const { return clusters_[turn_].data(); }

 private:
    [[nodiscard]] Cluster* now() { return clusters_[turn_].data(); }
    [[nodiscard]] Cluster* next() { return clusters_[1 - turn_].data(); }

    void find_partners(typename B::Queue& queue, std::uint32_t rounds, std::uint32_t count) {
        if (plan_.may_search(rounds, count))
            queue.for_each(
                count, FindNearest{now(), partners_.data(), count, plan_.radius, plan_.area_scale});
        else
            queue.for_each(count, PairNeighbours{partners_.data(), count});
    }

    /// How many clusters are left.
    [[nodiscard]] std::uint32_t join(typename B::Queue& queue, std::uint32_t count,
                                     std::uint32_t first_node,
                                     typename B::template Buffer<std::byte>& scratch) {
        queue.for_each(count + 1, MarkKept{partners_.data(), kept_.data(), count});
        queue.sum_before(count + 1, kept_.data(), kept_before_.data(), scratch);
        queue.for_each(count + 1,
                       JoinClusters{now(), partners_.data(), kept_before_.data(), nodes_.data(),
                                    costs_.data(), next(), left_.data(), count, first_node,
                                    plan_.leaf_size, plan_.area_scale});
        turn_ = 1 - turn_;
        return left_.read(queue);
    }

    template <class T>
    using Buffer = typename B::template Buffer<T>;

    ClusterPlan plan_;
    Buffer<BinaryNode> nodes_;  ///< leaves by place along the curve, then others as they were made
    Buffer<SlotCosts> costs_;   ///< of the same
    std::array<Buffer<Cluster>, 2> clusters_;  ///< of this round and of the next, by turns
    Buffer<std::uint64_t> keys_;
    Buffer<std::uint32_t> partners_;
    Buffer<std::uint32_t> kept_;
    Buffer<std::uint32_t> kept_before_;
    Counter<B> left_;
    std::size_t turn_ = 0;
};

}  // namespace mir::detail
