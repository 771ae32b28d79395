// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/tree_levels.hpp"
#include "mir/cuts/vpl_tree_view.hpp"
#include "mir/resident/backend_shining_vpls.hpp"
#include "mir/resident/wait_at_end.hpp"

namespace mir {

/// A VplTree that a backend makes in its memory, level by level from the root. Leaves, weights and
/// bounds are those of VplTree; leaves have no bounds here, because nobody asks for them. Move only
/// if the backend's buffers are.
template <Backend B>
class BackendVplTree {
 public:
    /// Copies the VPLs that shine. All work is done when it returns.
    /// @throws Error(invalid_argument) for an intensity, place or normal that is not finite;
    ///         Error(limit_exceeded) for 2^22 VPLs and more; what the backend throws.
    BackendVplTree(const B& backend, typename B::Queue& queue, VplSpan<Space::host> vpls)
        : BackendVplTree(backend, queue, BackendShiningVpls<B>(backend, queue, vpls)) {}

    /// For kernels on any queue; valid until this is moved or ends.
    [[nodiscard]] VplTreeView<B::space> view() const {
        return {leaves_.data(), sums_.data(), bounds_.data(), size()};
    }
    /// Number of leaves.
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(leaves_.size()); }

 private:
    template <class T>
    using Buffer = typename B::template Buffer<T>;

    BackendVplTree(const B& backend, typename B::Queue& queue, const BackendShiningVpls<B>& shining)
        : leaves_(backend.template buffer<Vpl>(shining.span().size())),
          sums_(backend.template buffer<std::uint64_t>(leaves_.size() + 1)),
          bounds_(backend.template buffer<VplBounds>(2 * leaves_.size())) {
        if (size() == 0) return;
        auto order = backend.template buffer<std::uint32_t>(size());
        auto scratch = backend.template buffer<std::byte>(queue.scratch_bytes(size() + 1));
        halve(backend, queue, shining.span(), shining.normal_scale(), order, scratch);
        weigh(backend, queue, shining.span(), shining.most(), order, scratch);
    }

    /// Brings `order` into leaf order and finds the bounds of all nodes.
    void halve(const B& backend, typename B::Queue& queue, VplSpan<B::space> vpls, float scale,
               Buffer<std::uint32_t>& order, Buffer<std::byte>& scratch) {
        const std::uint32_t n = size();
        auto keys = backend.template buffer<std::uint64_t>(n);
        auto numbers = backend.template buffer<std::uint32_t>(n);
        auto axes = backend.template buffer<std::uint32_t>(n);
        auto parts = backend.template buffer<KeyBounds>(n);  // more than parts of any level
        const WaitAtEnd wait(queue);
        queue.for_each(n, StartOrder{order.data(), numbers.data()});
        for (TreeLevel level{n, 0}; level.largest() > 1; ++level.depth) {
            const std::uint32_t of_node =
                (level.largest() - 1) / BoundParts<B::space>::part_size + 1;
            queue.for_each_group(
                level.size() * of_node,
                BoundParts<B::space>{vpls, order.data(), level, scale, of_node, parts.data()});
            queue.for_each(level.size(),
                           JoinParts{level, of_node, parts.data(), bounds_.data(), axes.data()});
            queue.for_each(n, SortKeys<B::space>{vpls, scale, numbers.data(), axes.data(),
                                                 keys.data(), order.data()});
            queue.sort_by_key(n, keys.data(), order.data(), scratch);
            queue.for_each(n, NumberNodes{{n, level.depth + 1}, order.data(), numbers.data()});
        }
    }

    /// Puts the VPLs into `order` and adds up their weights.
    void weigh(const B& backend, typename B::Queue& queue, VplSpan<B::space> vpls, float most,
               const Buffer<std::uint32_t>& order, Buffer<std::byte>& scratch) {
        const std::uint32_t n = size() + 1;
        auto low = backend.template buffer<std::uint32_t>(n);
        auto high = backend.template buffer<std::uint32_t>(n);
        auto low_sums = backend.template buffer<std::uint32_t>(n);
        auto high_sums = backend.template buffer<std::uint32_t>(n);
        const WaitAtEnd wait(queue);
        const PlaceVpls<B::space> placing{vpls,           order.data(), most,
                                          leaves_.data(), low.data(),   high.data()};
        queue.for_each(n, placing);
        queue.sum_before(n, low.data(), low_sums.data(), scratch);
        queue.sum_before(n, high.data(), high_sums.data(), scratch);
        queue.for_each(n,
                       JoinSums{low_sums.data(), high_sums.data(), sums_.data(), placing.low_bits});
        queue.record().sync();
    }

    Buffer<Vpl> leaves_;
    Buffer<std::uint64_t> sums_;
    Buffer<VplBounds> bounds_;
};

}  // namespace mir
