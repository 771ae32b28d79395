// SPDX-License-Identifier: MIT
#include "mir/accel/wide/waiting_nodes.hpp"

#include "support/catch.hpp"

#include <bit>

namespace {

/// A node whose child in slot k is node 100 + k between the planes k and k + 1, 10 + k and so on.
mir::WideNode numbered_node() {
    mir::WideNode node;
    for (std::uint32_t k = 0; k < mir::WideNode::width; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto low = static_cast<float>(10 * axis) + static_cast<float>(k);
            node.set_bounds(axis, k, low, low + 1.0f);
        }
        node.ref[k] = 100 + k;
        node.count[k] = mir::WideNode::inner;
    }
    return node;
}

}  // namespace

TEST_CASE("Nodes wait with their boxes, and the last one leaves first") {
    mir::WaitingNodes waiting;
    CHECK(waiting.groups() == 0);
    waiting.push_root(7.0f);
    CHECK(waiting.last() == mir::WideBvhView<mir::Space::host>::root);
    CHECK(waiting.group(0).low(2, 0) < -7.0f);
    CHECK(waiting.group(0).high(0, 0) > 7.0f);
    waiting.pop();
    const mir::WideNode parent = numbered_node();
    for (std::uint32_t n = 0; n < 19; ++n) waiting.push(parent, n * 3 % 8);
    REQUIRE(waiting.size() == 19);
    CHECK(waiting.groups() == 3);
    CHECK(waiting.slots_of(1) == 0xFFu);
    CHECK(waiting.slots_of(2) == 0x07u);
    for (std::uint32_t n = 0; n < 19; ++n) {
        const mir::WideNode& group = waiting.group(n / 8);
        CHECK(group.is_inner(n % 8));
        CHECK(group.ref[n % 8] == 100 + n * 3 % 8);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(group.low(axis, n % 8) == parent.low(axis, n * 3 % 8));
            CHECK(group.high(axis, n % 8) == parent.high(axis, n * 3 % 8));
        }
    }
    for (std::uint32_t n = 19; n > 0; --n) {
        CHECK(waiting.last() == 100 + (n - 1) * 3 % 8);
        waiting.pop();
    }
    CHECK(waiting.size() == 0);
}

TEST_CASE("There is room for as many nodes as can wait") {
    const mir::WideNode parent = numbered_node();
    mir::WaitingNodes waiting;
    for (std::uint32_t n = 0; n < mir::WaitingNodes::capacity; ++n) waiting.push(parent, n % 8);
    CHECK(waiting.size() == mir::WaitingNodes::capacity);
    std::uint32_t slots = 0;
    for (std::uint32_t g = 0; g < waiting.groups(); ++g)
        slots += static_cast<std::uint32_t>(std::popcount(waiting.slots_of(g)));
    CHECK(slots == mir::WaitingNodes::capacity);
}
