// SPDX-License-Identifier: MIT
#include "mir/accel/wide/node_links.hpp"

#include "conformance/worlds.hpp"
#include "mir/accel/wide/quantised_bvh.hpp"
#include "support/catch.hpp"
#include "wide_nodes.hpp"

namespace {

constexpr std::uint32_t all_slots = (1u << mir::WideNode::width) - 1u;

/// Children in the order that WideBvhView promises, of as many triangles as `counts` says.
mir::WideNode node_of(const std::int32_t (&counts)[mir::WideNode::width]) {
    mir::WideNode node{};
    std::uint32_t next_node = 40;
    std::uint32_t next_triangle = 1000;
    for (std::uint32_t k = 0; k < mir::WideNode::width; ++k) {
        node.count[k] = counts[k];
        if (node.is_inner(k)) node.ref[k] = next_node++;
        if (!node.is_leaf(k)) continue;
        node.ref[k] = next_triangle;
        next_triangle += static_cast<std::uint32_t>(counts[k]);
    }
    return node;
}

std::uint32_t inner_slots(const mir::WideNode& node) {
    std::uint32_t inner = 0;
    for (std::uint32_t k = 0; k < mir::WideNode::width; ++k)
        if (node.is_inner(k)) inner |= 1u << k;
    return inner;
}

/// Triangles of the leaves among `slots`, as the node lists them.
std::vector<std::uint32_t> listed(const mir::WideNode& node, std::uint32_t slots) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t k = 0; k < mir::WideNode::width; ++k)
        for (std::int32_t i = 0; (slots >> k & 1u) != 0 && i < node.count[k]; ++i)
            triangles.push_back(node.ref[k] + static_cast<std::uint32_t>(i));
    return triangles;
}

std::vector<std::uint32_t> visited(const mir::LeafTriangles& triangles) {
    std::vector<std::uint32_t> places;
    triangles.for_each([&](std::uint32_t place) { places.push_back(place); });
    return places;
}

std::vector<std::uint32_t> popped(mir::LeafTriangles triangles) {
    std::vector<std::uint32_t> places;
    while (!triangles.empty()) places.push_back(triangles.pop());
    return places;
}

/// True when the links name the children and triangles that the node does, for every set of slots.
bool name_the_same(const mir::NodeLinks& links, const mir::WideNode& node) {
    const std::uint32_t inner = inner_slots(node);
    for (std::uint32_t k = 0; k < mir::WideNode::width; ++k)
        if (node.is_inner(k) && mir::NodeLinks::node(links.first_node, inner, k) != node.ref[k])
            return false;
    for (std::uint32_t slots = 0; slots <= all_slots; ++slots) {
        const mir::LeafTriangles triangles = links.leaves(slots & ~inner);
        const std::vector<std::uint32_t> expected = listed(node, slots & ~inner);
        if (triangles.count() != expected.size() || triangles.empty() != expected.empty() ||
            visited(triangles) != expected || popped(triangles) != expected)
            return false;
    }
    return true;
}

}  // namespace

TEST_CASE("Links name the children of a node and the triangles of any of its leaves") {
    CHECK(name_the_same(mir::links_of(node_of({-1, -1, -1, -1, -1, -1, -1, -1})),
                        node_of({-1, -1, -1, -1, -1, -1, -1, -1})));
    CHECK(name_the_same(mir::links_of(node_of({8, 8, 8, 8, 8, 8, 8, 8})),
                        node_of({8, 8, 8, 8, 8, 8, 8, 8})));
    mir::Random random = mirtest::test_random(1);
    for (int i = 0; i < 200; ++i) {
        std::int32_t counts[mir::WideNode::width];
        for (std::int32_t& count : counts)
            count = static_cast<std::int32_t>(10.0f * random.next()) - 1;
        CHECK(name_the_same(mir::links_of(node_of(counts)), node_of(counts)));
    }
}

TEST_CASE("Hierarchies number children and triangles so that links name them all") {
    const mirtest::World world = mirtest::triangle_soup(700, 5, 1.0f, mir::Vec3(0.0f));
    for (std::uint32_t leaf_size = 1; leaf_size <= mir::WideBvhOptions::largest_leaf; ++leaf_size) {
        mir::WideBvhOptions options;
        options.leaf_size = leaf_size;
        options.splits = leaf_size % 2 == 0 ? 0.2f : 0.0f;
        const mir::WideBvh bvh = mirtest::build_wide(world.geometry, options);
        std::vector<mir::QuantisedNode> boxes(bvh.nodes().size());
        std::vector<mir::NodeLinks> links(bvh.nodes().size());
        const mir::QuantiseNodes<mir::Space::host> kernel{bvh.view(), boxes.data(), links.data()};
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            kernel(i);
            CHECK(name_the_same(links[i], bvh.nodes()[i]));
        }
    }
}
