// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/split_triangles.hpp"
#include "mir/resident/detail/counter.hpp"
#include "mir/resident/wait_at_end.hpp"

#include <bit>

namespace mir::detail {

/// Which triangles are split before a tree is built, and how often. Decided in a backend's memory,
/// the same everywhere.
template <Backend B>
class SplitPlan {
 public:
    /// `plan` says how many splits there may be. It learns how many references come of them.
    /// `queue` must outlive it.
    SplitPlan(const B& backend, typename B::Queue& queue, GeometryView<B::space> geometry,
              ClusterPlan& plan)
        : room_(plan.splits == 0 ? 1 : std::size_t{plan.triangles} + 1),
          gains_(backend.template buffer<float>(room_)),
          counts_(backend.template buffer<std::uint32_t>(room_)),
          sums_(backend.template buffer<std::uint32_t>(room_)),
          scratch_(backend.template buffer<std::byte>(
              queue.scratch_bytes(static_cast<std::uint32_t>(room_)))),
          total_(backend),
          splits_{gains_.data(), counts_.data(), plan.triangles, 0, 0.0f},
          wait_(queue) {
        if (plan.splits == 0) return;
        // So many that their sum does not overflow.
        splits_.most = std::min(most_splits, 0xFFFFFFFFu / plan.triangles);
        queue.for_each(plan.triangles, RateTriangles<B::space>{geometry, plan, gains_.data()});
        choose_density(queue, plan.splits);
        queue.for_each(plan.triangles + 1,
                       CountParts<B::space>{geometry, plan, splits_, counts_.data()});
        plan.hold(sum(queue));
    }

    [[nodiscard]] const SplitCounts& splits() const { return splits_; }
    /// First reference of each triangle; nullptr if none is split.
    [[nodiscard]] const std::uint32_t* first() const { return room_ == 1 ? nullptr : sums_.data(); }

 private:
    /// The largest density without too many splits, from 2^-32 to 2^32. There are 16 to an octave.
    /// At the least there are none: gains are below 2^14, since no accept triangle that is cut
    /// leaves the reach.
    void choose_density(typename B::Queue& queue, std::uint32_t splits) {
        const auto density = [](std::uint32_t step) {
            return std::bit_cast<float>(0x2F800000u + (step << 19));
        };
        std::uint32_t low = 0;
        std::uint32_t high = 64 * 16;
        while (high - low > 1) {
            const std::uint32_t middle = (low + high) / 2;
            splits_.density = density(middle);
            queue.for_each(splits_.triangles + 1, splits_);
            (sum(queue) <= splits ? low : high) = middle;
        }
        splits_.density = density(low);
    }

    [[nodiscard]] std::uint32_t sum(typename B::Queue& queue) {
        queue.sum_before(splits_.triangles + 1, counts_.data(), sums_.data(), scratch_);
        queue.for_each(1, CopyWord{sums_.data() + splits_.triangles, total_.data()});
        return total_.read(queue);
    }

    std::size_t room_;
    typename B::template Buffer<float> gains_;
    typename B::template Buffer<std::uint32_t> counts_;
    typename B::template Buffer<std::uint32_t> sums_;
    typename B::template Buffer<std::byte> scratch_;
    Counter<B> total_;
    SplitCounts splits_;
    WaitAtEnd<typename B::Queue> wait_;
};

}  // namespace mir::detail
