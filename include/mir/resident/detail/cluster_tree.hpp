// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/find_partners.hpp"
#include "mir/accel/wide/join_clusters.hpp"
#include "mir/accel/wide/make_clusters.hpp"
#include "mir/accel/wide/wide_children.hpp"
#include "mir/resident/detail/split_plan.hpp"

#include <array>

namespace mir::detail {

/// A binary tree over all triangles of a scene, or parts of them. A backend makes it in its memory
/// by joining clusters that lie next to each other. Equal in bytes on every backend.
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
          left_{Counter<B>(backend), Counter<B>(backend)} {}

    /// Does all of it but the last steps, which it starts. There are triangles. The scratch is for
    /// one element more than these.
    void build(typename B::Queue& queue, GeometryView<B::space> geometry, const SplitPlan<B>& split,
               typename B::template Buffer<std::byte>& scratch) {
        const std::uint32_t n = plan_.references;
        queue.for_each(plan_.triangles,
                       MakeBoxes<B::space>{geometry, plan_, split.splits(), split.first(), next(),
                                           keys_.data(), partners_.data()});
        queue.sort_by_key(n, keys_.data(), partners_.data(), scratch);
        queue.for_each(
            n, PlaceLeaves{next(), partners_.data(), nodes_.data(), costs_.data(), now(), rule()});
        left_[turn_].set(queue, n);
        // Never less than there are; exact where the host has just looked.
        std::uint32_t bound = n;
        for (std::uint32_t rounds = 0; bound > 1;) {
            const bool searches = plan_.may_search(rounds, bound);
            find_partners(queue, searches, bound);
            join(queue, bound, scratch);
            bound = searches ? bound - 1 : (bound + 1) / 2;
            if (++rounds % rounds_between_looks == 0) bound = left_[turn_].read(queue);
        }
    }

    [[nodiscard]] CostedTree view() const { return {nodes_.data(), costs_.data()}; }
    /// The cluster that holds everything.
    [[nodiscard]] const Cluster* all() const { return clusters_[turn_].data(); }

 private:
    [[nodiscard]] Cluster* now() { return clusters_[turn_].data(); }
    [[nodiscard]] Cluster* next() { return clusters_[1 - turn_].data(); }

    [[nodiscard]] CostRule rule() const {
        return {plan_.leaf_size, plan_.node_cost, plan_.area_scale};
    }

    /// Rounds after which the host looks how many clusters are left. It waits for the backend then,
    /// which takes longer than rounds of few clusters do.
    static constexpr std::uint32_t rounds_between_looks = 4;

    void find_partners(typename B::Queue& queue, bool searches, std::uint32_t bound) {
        if (searches)
            queue.for_each(bound, FindNearest{now(), left_[turn_].data(), partners_.data(),
                                              plan_.radius, plan_.area_scale});
        else
            queue.for_each(bound, PairNeighbours{left_[turn_].data(), partners_.data()});
    }

    void join(typename B::Queue& queue, std::uint32_t bound,
              typename B::template Buffer<std::byte>& scratch) {
        const std::uint32_t* const left = left_[turn_].data();
        queue.for_each(bound + 1, MarkKept{left, partners_.data(), kept_.data()});
        queue.sum_before(bound + 1, kept_.data(), kept_before_.data(), scratch);
        queue.for_each(bound + 1, JoinClusters{now(), left, partners_.data(), kept_before_.data(),
                                               nodes_.data(), costs_.data(), next(),
                                               left_[1 - turn_].data(), plan_.references, rule()});
        turn_ = 1 - turn_;
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
    std::array<Counter<B>, 2> left_;  ///< how many clusters, by the same turns
    std::size_t turn_ = 0;
};

}  // namespace mir::detail
