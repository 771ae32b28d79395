// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/quantised_node.hpp"
#include "mir/concepts/backend.hpp"

namespace mir {

/// The boxes of a wide hierarchy in short (QuantisedNode), in a backend's memory beside it.
template <Backend B>
class QuantisedBoxes {
 public:
    /// Starts to make them on `queue`. `bvh` has `nodes` nodes.
    QuantisedBoxes(const B& backend, typename B::Queue& queue, const WideBvhView<B::space>& bvh,
                   std::size_t nodes)
        : boxes_(backend.template buffer<QuantisedNode>(nodes)) {
        queue.for_each(static_cast<std::uint32_t>(nodes),
                       QuantiseNodes<B::space>{bvh, boxes_.data()});
    }

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] const QuantisedNode* data() const { return boxes_.data(); }

 private:
    typename B::template Buffer<QuantisedNode> boxes_;
};

}  // namespace mir
