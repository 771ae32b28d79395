// SPDX-License-Identifier: MIT
#include "mir/data/vpl_list.hpp"

#include "support/catch.hpp"

namespace {

mir::Vpl shining(float red) { return {{red, 0, 0}, {0, 0, 1}, {red, 0, 0}}; }

mir::VplOrigin at(std::uint32_t triangle, std::uint8_t bounce = 2) {
    mir::VplOrigin o;
    o.triangle = triangle;
    o.bounce = bounce;
    o.barycentrics = {0.25f, 0.5f};
    return o;
}

}  // namespace

TEST_CASE("Consecutive path VPLs of one point become one VPL with their summed intensity") {
    mir::VplList list;
    list.append(shining(1), at(5));
    list.append(shining(2), at(5));
    mir::VplOrigin twice = at(5);
    twice.multiplicity = 2;
    list.append(shining(4), twice);
    REQUIRE(list.size() == 1);
    CHECK(list.vpls()[0].intensity == mir::Rgb{7, 0, 0});
    // The place is that of the first.
    CHECK(list.vpls()[0].position.x == 1.0f);
    CHECK(list.origins()[0].multiplicity == 4);
}

TEST_CASE("Every part of a point's identity keeps VPLs apart") {
    mir::VplOrigin other = at(5);
    SECTION("triangle") { other.triangle = 6; }
    SECTION("barycentrics") { other.barycentrics.y = 0.50000006f; }
    SECTION("bounce") { other.bounce = 3; }
    SECTION("kind") { other.kind = mir::VplKind::emitter; }
    SECTION("light group") { other.light_group = 1; }
    CHECK_FALSE(same_place(at(5), other));
    mir::VplList list;
    list.append(shining(1), at(5));
    list.append(shining(1), other);
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

TEST_CASE("Sorting by bounce is stable and makes one span of each bounce") {
    mir::VplList list;
    constexpr std::uint8_t bounces[] = {3, 2, 4, 2, 254, 3, 2};
    for (std::uint8_t bounce : bounces)
        list.push_back(shining(static_cast<float>(list.size())), at(list.size(), bounce));
    list.sort_by_bounce();
    CHECK(list.max_bounce() == 254);
    REQUIRE(list.size() == 7);
    const auto second = list.bounce(2);
    REQUIRE(second.size() == 3);
    CHECK(second[0].position.x == 1.0f);
    CHECK(second[1].position.x == 3.0f);
    CHECK(second[2].position.x == 6.0f);
    CHECK(list.bounce(3).size() == 2);
    CHECK(list.bounce(4).size() == 1);
    CHECK(list.bounce(254).size() == 1);
    CHECK(list.bounce(1).size() == 0);
    CHECK(list.bounce(100).size() == 0);
    for (std::uint32_t i = 0; i < list.size(); ++i)
        CHECK(static_cast<float>(list.origins()[i].triangle) == list.vpls()[i].position.x);
}

TEST_CASE("An empty list has no VPLs of any bounce") {
    mir::VplList list;
    list.sort_by_bounce();
    CHECK(list.empty());
    CHECK(list.span().size() == 0);
    CHECK(list.bounce(2).size() == 0);
    CHECK(list.max_bounce() == 0);
}
