// SPDX-License-Identifier: MIT
#include "mir/accel/kd_ropes.hpp"

#include "accel/brute_force_rows.hpp"
#include "accel/hard_segments.hpp"
#include "accel/simple_kd_tree.hpp"
#include "conformance/worlds.hpp"
#include "support/catch.hpp"

TEST_CASE("A walk along ropes hides exactly what asking every triangle hides") {
    const int kind = GENERATE(0, 1, 2, 3);
    const mirtest::World world = kind == 0   ? mirtest::triangle_soup(150, 1)
                                 : kind == 1 ? mirtest::needle_soup(100, 2)
                                 : kind == 2 ? mirtest::triangle_soup(150, 1, 1e4f, {10, 10, 10})
                                             : mirtest::sphere_in_box();
    const mirtest::SimpleKdTree tree(world.geometry, 4, 12);
    const mir::KdRopes ropes(tree.nodes());
    const auto view = ropes.view(tree.view());
    mirtest::HardSegments segments(world.geometry, tree.nodes(), 3);
    std::size_t wrong = 0;
    for (int i = 0; i < 50000; ++i) {
        const mirtest::HardSegment s = segments.next();
        const bool truth = mirtest::hidden_by_any(tree.triangles(), view.reach, s.from, s.to);
        if (mir::is_hidden(view, s.from, s.to) != truth) ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("Ropes lead to the cell behind a face") {
    const mirtest::World world = mirtest::triangle_soup(150, 4);
    const mirtest::SimpleKdTree tree(world.geometry);
    const mir::KdRopes ropes(tree.nodes());
    std::size_t checked = 0;
    for (const mir::KdRopeLeaf& leaf : ropes.leaves()) {
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const bool border = std::isinf(leaf.high[axis]);
            REQUIRE(border == (leaf.above[axis] == mir::KdRopeLeaf::outside));
            if (border || !ropes.nodes()[leaf.above[axis]].is_leaf()) continue;
            const mir::KdRopeLeaf& next = ropes.leaves()[ropes.nodes()[leaf.above[axis]].first()];
            REQUIRE(next.low[axis] == leaf.high[axis]);
            const std::uint32_t other = (axis + 1) % 3;
            REQUIRE(next.low[other] <= leaf.low[other]);
            REQUIRE(next.high[other] >= leaf.high[other]);
            ++checked;
        }
    }
    CHECK(checked > 10);
}

TEST_CASE("Ropes of a tree without triangles hide nothing") {
    const mirtest::World world{mir::Scene{}};
    const mirtest::SimpleKdTree tree(world.geometry);
    const mir::KdRopes ropes(tree.nodes());
    CHECK_FALSE(mir::is_hidden(ropes.view(tree.view()), {0, 0, 0}, {1, 2, 3}));
}
