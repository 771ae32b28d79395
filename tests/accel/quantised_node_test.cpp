// SPDX-License-Identifier: MIT
#include "mir/accel/wide/quantised_node.hpp"

#include "conformance/worlds.hpp"
#include "mir/accel/wide/quantised_bvh.hpp"
#include "mir/host/wide_build.hpp"
#include "support/catch.hpp"

#include <cmath>

namespace {

constexpr float unit = 0x1p-24f;

/// Children within [-m, m]^3, from flat to the whole of it, some slots empty.
mir::WideNode random_node(mir::Random& random, float m) {
    mir::WideNode node{};
    const float size = m * std::pow(10.0f, -6.0f * random.next());
    const mir::Vec3 middle = (m - size) * mirtest::point_in_cube(random);
    for (std::uint32_t k = 0; k < mir::WideNode::width; ++k) {
        node.count[k] = k == 0                 ? 3
                        : random.next() < 0.3f ? mir::WideNode::empty
                        : k % 2 == 0           ? 1
                                               : 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float a = middle[axis] + size * (2.0f * random.next() - 1.0f);
            const float b = random.next() < 0.3f ? a : middle[axis] + size * random.next();
            node.set_bounds(axis, k, std::min(a, b), std::max(a, b));
        }
    }
    return node;
}

long double plane_at(const mir::QuantisedNode& q, int axis, bool upper, std::uint32_t k) {
    return static_cast<long double>(q.origin[axis]) +
           static_cast<long double>(q.plane(axis, upper, k)) * q.step(axis);
}

/// By how much the boxes exceed those of the node, in units of e m where `least` and in steps
/// beyond the margin where `most`.
struct Excess {
    long double least = 1e9L;
    long double most = 0;
};

Excess excess_of(int draws, float margin_units) {
    Excess excess;
    mir::Random random = mirtest::test_random(1);
    for (int i = 0; i < draws; ++i) {
        const float m = std::pow(10.0f, static_cast<float>(i % 5 - 2) * 3.0f);
        const mir::WideNode node = random_node(random, m);
        const mir::QuantisedNode q = mir::quantised(node, margin_units * unit * m);
        for (std::uint32_t k = 0; k < mir::WideNode::width; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                if (node.count[k] == mir::WideNode::empty) continue;
                const long double below = node.low(axis, k) - plane_at(q, axis, false, k);
                const long double above = plane_at(q, axis, true, k) - node.high(axis, k);
                const long double margin = margin_units * unit * m;
                excess.least = std::min({excess.least, below / (unit * m), above / (unit * m)});
                excess.most = std::max({excess.most, (below - margin) / q.step(axis),
                                        (above - margin) / q.step(axis)});
            }
    }
    return excess;
}

}  // namespace

TEST_CASE("Quantised boxes hold those of the node with their margin, and little more") {
    const Excess excess = excess_of(20000, 24.0f);
    CHECK(excess.least > 16.0L);
    CHECK(excess.most < 9.0L);  // at a node as small as the margin, where the origin rounds
    CHECK(excess_of(20000, 0.0f).least < 1.0L);
}

TEST_CASE("A quantised node says which children are nodes, and turns empty slots inside out") {
    mir::Random random = mirtest::test_random(2);
    for (int i = 0; i < 1000; ++i) {
        const mir::WideNode node = random_node(random, 1.0f);
        const mir::QuantisedNode q = mir::quantised(node, 24.0f * unit);
        for (std::uint32_t k = 0; k < mir::WideNode::width; ++k) {
            CHECK((q.inner >> k & 1u) == (node.is_inner(k) ? 1u : 0u));
            if (node.count[k] == mir::WideNode::empty)
                CHECK((q.plane(0, false, k) == 255u && q.plane(0, true, k) == 0u));
        }
    }
}

TEST_CASE("The kernel quantises every node of a hierarchy, that without triangles too") {
    for (const mirtest::World& world : {mirtest::triangle_soup(200, 3, 1.0f, mir::Vec3(0.0f)),
                                        mirtest::triangle_soup(0, 3, 1.0f, mir::Vec3(0.0f))}) {
        mir::InlineExecutor executor;
        const mir::WideBvh bvh = mir::build_wide_bvh(world.geometry, executor);
        std::vector<mir::QuantisedNode> boxes(bvh.nodes().size());
        std::vector<mir::NodeLinks> links(bvh.nodes().size());
        const mir::QuantiseNodes<mir::Space::host> kernel{bvh.view(), boxes.data(), links.data()};
        for (std::uint32_t i = 0; i < boxes.size(); ++i) kernel(i);
        for (std::size_t i = 0; i < boxes.size(); ++i)
            for (std::uint32_t k = 0; k < mir::WideNode::width; ++k) {
                if (bvh.nodes()[i].count[k] == mir::WideNode::empty) continue;
                for (int axis = 0; axis < 3; ++axis) {
                    CHECK(plane_at(boxes[i], axis, false, k) < bvh.nodes()[i].low(axis, k));
                    CHECK(plane_at(boxes[i], axis, true, k) > bvh.nodes()[i].high(axis, k));
                }
            }
    }
}
