// SPDX-License-Identifier: MIT
#include "mir/scene/detail/coincidence.hpp"

#include "mir/scene/detail/box_tree.hpp"
#include "support/catch.hpp"
#include "support/random_segments.hpp"

#include <algorithm>

namespace {

using mir::DVec3;
using mir::detail::coincide;
using mir::detail::Corners;
using mir::detail::Facet;

const Corners lamp{DVec3(1, 0, 1), DVec3(2, 0, 1), DVec3(1, 0, 2)};

Corners moved(Corners t, DVec3 by) {
    for (DVec3& corner : t) corner += by;
    return t;
}

/// Either way round.
bool each_coincides(const Corners& a, const Corners& b) {
    const bool found = coincide(Facet(a), Facet(b), 1e-5);
    CHECK(coincide(Facet(b), Facet(a), 1e-5) == found);
    return found;
}

mir::Bounds some_box(mir::Random& random) {
    mir::Bounds box;
    box.add(mirtest::point_in_cube(random));
    box.add(box.low + 0.2f * mirtest::point_in_cube(random));
    return box;
}

}  // namespace

TEST_CASE("triangles coincide where they lie in one plane and overlap") {
    const Corners wall{DVec3(0, 0, 0), DVec3(9, 0, 0), DVec3(0, 0, 9)};
    CHECK(each_coincides(lamp, lamp));
    CHECK(each_coincides(lamp, wall));
    CHECK(each_coincides(lamp, {wall[0], wall[2], wall[1]}));
    CHECK(each_coincides(moved(lamp, {0.5, 5e-6, -0.3}), wall));
    CHECK_FALSE(each_coincides(moved(lamp, {0, 2e-5, 0}), wall));
    CHECK_FALSE(each_coincides(moved(lamp, {0, -2e-5, 0}), wall));
    CHECK_FALSE(each_coincides(moved(lamp, {9, 0, 9}), wall));
}

TEST_CASE("triangles that share an edge or a corner, or cross, do not coincide") {
    CHECK_FALSE(each_coincides(lamp, {DVec3(2, 0, 1), DVec3(2, 0, 2), DVec3(1, 0, 2)}));
    CHECK_FALSE(each_coincides(lamp, {DVec3(2, 1e-6, 1), DVec3(2, 0, 2), DVec3(1, 1e-6, 2)}));
    CHECK_FALSE(each_coincides(lamp, {DVec3(1, 0, 1), DVec3(0, 0, 1), DVec3(1, 0, 0)}));
    CHECK_FALSE(each_coincides(lamp, {DVec3(1.2, -1, 1.2), DVec3(1.2, 1, 1.2), DVec3(1.4, 1, 1)}));
    CHECK_FALSE(each_coincides(lamp, {DVec3(0, 0, 1.5), DVec3(3, 0, 1.5), DVec3(1, 1, 1.5)}));
    // A cubic micrometre in the plane: it has no extent there that rounding would leave.
    CHECK_FALSE(
        each_coincides(lamp, {DVec3(1.2, 0, 1.2), DVec3(1.2, 1e-6, 1.2), DVec3(1.200001, 0, 1.2)}));
}

TEST_CASE("a tree of boxes finds what asking every box finds") {
    mir::Random random = mirtest::test_random(40);
    for (const std::size_t count : {0u, 1u, 4u, 5u, 333u}) {
        std::vector<mir::Bounds> boxes(count);
        std::generate(boxes.begin(), boxes.end(), [&] { return some_box(random); });
        const mir::detail::BoxTree tree(boxes);
        for (int i = 0; i < 100; ++i) {
            const mir::Bounds asked = some_box(random);
            std::vector<std::uint32_t> found;
            std::vector<std::uint32_t> expected;
            tree.each_touching(asked, [&](std::uint32_t b) { found.push_back(b); });
            std::sort(found.begin(), found.end());
            for (std::uint32_t b = 0; b < count; ++b)
                if (mir::detail::touch(boxes[b], asked)) expected.push_back(b);
            CHECK(found == expected);
        }
    }
}
