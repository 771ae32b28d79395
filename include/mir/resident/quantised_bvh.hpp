// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/quantised_bvh.hpp"
#include "mir/concepts/backend.hpp"

namespace mir {

/// The nodes of a wide hierarchy in short, in a backend's memory. They are QuantisedNode and
/// NodeLinks and lie beside it.
template <Backend B>
class QuantisedBvh {
 public:
    /// Starts to make them on `queue`. `bvh` has `nodes` nodes and must outlive what view() gives.
    QuantisedBvh(const B& backend, typename B::Queue& queue, const WideBvhView<B::space>& bvh,
                 std::size_t nodes)
        : exact_(bvh),
          boxes_(backend.template buffer<QuantisedNode>(nodes)),
          links_(backend.template buffer<NodeLinks>(nodes)) {
        queue.for_each(static_cast<std::uint32_t>(nodes),
                       QuantiseNodes<B::space>{bvh, boxes_.data(), links_.data()});
    }

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] QuantisedBvhView<B::space> view() const {
        return {exact_, boxes_.data(), links_.data()};
    }

 private:
    WideBvhView<B::space> exact_;
    typename B::template Buffer<QuantisedNode> boxes_;
    typename B::template Buffer<NodeLinks> links_;
};

}  // namespace mir
