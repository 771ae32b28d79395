// SPDX-License-Identifier: MIT
#include "mir/data/main_bounces.hpp"

#include "support/catch.hpp"

namespace {

mir::Vpl shining(float light) { return {{}, {0, 0, 1}, {light, light, light}}; }

mir::VplOrigin at(std::uint32_t triangle) {
    mir::VplOrigin origin;
    origin.triangle = triangle;
    return origin;
}

}  // namespace

TEST_CASE("the main bounce of a VPL is the one that brings most of its light") {
    mir::VplList list;
    CHECK(main_bounces(list).empty());
    list.append(shining(3), at(0), 2);
    list.append(shining(2), at(0), 5);
    list.append(shining(2), at(0), 5);
    list.append(shining(1), at(1), 255);
    // As much of both: the smaller.
    list.append(shining(2), at(2), 4);
    list.append(shining(2), at(2), 3);
    // Black: the first.
    list.append(shining(0), at(3), 7);
    list.append(shining(0), at(3), 6);
    CHECK(main_bounces(list) == std::vector<std::uint8_t>{5, 255, 3, 7});
}
