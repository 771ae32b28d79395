// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/vpl_node.hpp"

#include <cstdint>

namespace mir {

/// A cut while its nodes are divided, the one that deviates most first. In memory of the caller. A
/// list keeps the nodes in leaf order, a heap finds the next to divide; equal deviations go by leaf
/// order. The caller knows the number of nodes.
struct GrowingCut {
    /// A node of the list.
    struct Listed {
        VplNode node;
        std::uint32_t next = 0;  ///< place of the one behind it; of no meaning for the last
    };
    /// A node of the heap.
    struct Ranked {
        float deviation = 0.0f;
        std::uint32_t place = 0;  ///< in the list
    };

    Listed* list = nullptr;  ///< room for all nodes; the first is that of the first leaf
    Ranked* heap = nullptr;  ///< the same

    /// Begins with one node.
    MIR_HD void start(const VplNode& root, float deviation) const {
        list[0] = {root, 0};
        heap[0] = {deviation, 0};
    }
    /// The deviation of the node to divide next; none is to be divided if it is 0.
    [[nodiscard]] MIR_HD float deviation() const { return heap[0].deviation; }
    /// The node to divide next.
    [[nodiscard]] MIR_HD const VplNode& widest() const { return list[heap[0].place].node; }
    /// Replaces it by its halves, whose deviations are given. There were `size` nodes and are one
    /// more.
    MIR_HD void divide(std::uint32_t size, float left, float right) const {
        const std::uint32_t place = heap[0].place;
        const Listed whole = list[place];
        list[size] = {whole.node.right(), whole.next};
        list[place] = {whole.node.left(), size};
        sink(size, {left, place});
        rise(size, {right, size});
    }
    /// Writes the nodes in leaf order.
    MIR_HD void write(std::uint32_t size, VplNode* to) const {
        std::uint32_t place = 0;
        for (std::uint32_t i = 0; i < size; ++i) {
            to[i] = list[place].node;
            place = list[place].next;
        }
    }

 private:
    [[nodiscard]] MIR_HD bool is_before(const Ranked& a, const Ranked& b) const {
        if (a.deviation != b.deviation) return a.deviation > b.deviation;
        return list[a.place].node.first < list[b.place].node.first;
    }
    /// Puts a node at the top of a heap of `size` and brings it to where it belongs.
    MIR_HD void sink(std::uint32_t size, const Ranked& node) const {
        std::uint32_t at = 0;
        for (;;) {
            std::uint32_t child = 2 * at + 1;
            if (child >= size) break;
            if (child + 1 < size && is_before(heap[child + 1], heap[child])) ++child;
            if (!is_before(heap[child], node)) break;
            heap[at] = heap[child];
            at = child;
        }
        heap[at] = node;
    }
    /// Puts a node behind a heap of `size` and brings it to where it belongs.
    MIR_HD void rise(std::uint32_t size, const Ranked& node) const {
        std::uint32_t at = size;
        while (at > 0 && is_before(node, heap[(at - 1) / 2])) {
            heap[at] = heap[(at - 1) / 2];
            at = (at - 1) / 2;
        }
        heap[at] = node;
    }
};

}  // namespace mir
