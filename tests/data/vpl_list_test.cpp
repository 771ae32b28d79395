// SPDX-License-Identifier: MIT
#include "mir/data/vpl_list.hpp"

#include "support/catch.hpp"

namespace {

using mir::Rgb;

mir::Vpl shining(float red) { return {{red, 0, 0}, {0, 0, 1}, {red, 0, 0}}; }

mir::VplOrigin at(std::uint32_t triangle) {
    mir::VplOrigin o;
    o.triangle = triangle;
    o.barycentrics = {0.25f, 0.5f};
    return o;
}

/// Two points; three paths of two bounces and two light groups meet at the first.
mir::VplList two_points() {
    mir::VplList list;
    list.append(shining(1), at(5), 3, 0);
    list.append(shining(2), at(5), 2, 7);
    list.append(shining(4), at(5), 3, 7, 2.0f);
    list.append(shining(8), at(6), 254, 0);
    return list;
}

}  // namespace

TEST_CASE("Consecutive path VPLs of one point become one VPL with their summed intensity") {
    const mir::VplList list = two_points();
    REQUIRE(list.size() == 2);
    CHECK(list.vpls()[0].intensity == Rgb{7, 0, 0});
    // The place is that of the first.
    CHECK(list.vpls()[0].position.x == 1.0f);
    CHECK(list.origins()[0].multiplicity == 4.0f);
    CHECK(list.origins()[1].multiplicity == 1.0f);
}

TEST_CASE("Path VPLs keep bounce, light group, weight and share of what they joined") {
    const mir::VplList list = two_points();
    REQUIRE(list.path_vpls().size() == 4);
    const mir::PathVpl third = list.path_vpls()[2];
    CHECK(third.vpl == 0);
    CHECK(third.bounce == 3);
    CHECK(third.light_group == 7);
    CHECK(third.weight == 2.0f);
    CHECK(third.intensity == Rgb{4, 0, 0});
    CHECK(list.path_vpls()[3].vpl == 1);
}

TEST_CASE("Every part of a point's identity keeps VPLs apart, and so does its side") {
    mir::VplOrigin other = at(5);
    mir::Vpl vpl = shining(1);
    SECTION("triangle") { other.triangle = 6; }
    SECTION("barycentrics") { other.barycentrics.y = 0.50000006f; }
    SECTION("kind") { other.kind = mir::VplKind::emitter; }
    SECTION("side") { vpl.normal = -vpl.normal; }
    CHECK(same_place(at(5), other) == (vpl.normal.z < 0.0f));
    mir::VplList list;
    list.append(shining(1), at(5));
    list.append(vpl, other);
    CHECK(list.size() == 2);
}

TEST_CASE("Only neighbours are joined, and push_back never joins") {
    mir::VplList list;
    list.append(shining(1), at(5));
    list.append(shining(1), at(6));
    list.append(shining(1), at(5));
    list.push_back(shining(1), at(5));
    CHECK(list.size() == 4);
}

TEST_CASE("A bounce or light group is all places with its share of the intensity") {
    const mir::VplList list = two_points();
    CHECK(list.max_bounce() == 254);
    Rgb sum;
    for (unsigned b : {2u, 3u, 254u}) {
        const std::vector<mir::Vpl> bounce = list.bounce(static_cast<std::uint8_t>(b));
        REQUIRE(bounce.size() == 2);
        CHECK(bounce[0].position == list.vpls()[0].position);
        sum += bounce[0].intensity;
    }
    CHECK(sum == list.vpls()[0].intensity);
    CHECK(list.bounce(3)[0].intensity == Rgb{5, 0, 0});
    CHECK(is_black(list.bounce(3)[1].intensity));
    CHECK(list.bounce(254)[1].intensity == Rgb{8, 0, 0});
    CHECK(is_black(list.bounce(100)[0].intensity));
    CHECK(list.light_group(7)[0].intensity == Rgb{6, 0, 0});
    CHECK(list.light_group(0)[1].intensity == Rgb{8, 0, 0});
}

TEST_CASE("New intensities of path VPLs reach geometric VPLs as sums, black ones included") {
    mir::VplList list = two_points();
    const std::vector<Rgb> light{{1, 1, 1}, {0, 2, 0}, {0, 0, 3}, {}};
    list.relight(light);
    REQUIRE(list.size() == 2);
    CHECK(list.vpls()[0].intensity == Rgb{1, 3, 4});
    CHECK(is_black(list.vpls()[1].intensity));
    CHECK(list.bounce(2)[0].intensity == Rgb{0, 2, 0});
    CHECK_THROWS_AS(list.relight(std::vector<Rgb>(3)), mir::Error);
}

TEST_CASE("An empty list has no VPLs of any bounce") {
    const mir::VplList list;
    CHECK(list.empty());
    CHECK(list.span().size() == 0);
    CHECK(list.bounce(2).empty());
    CHECK(list.max_bounce() == 0);
}
