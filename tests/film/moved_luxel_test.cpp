// SPDX-License-Identifier: MIT
#include "mir/film/moved_luxel.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

namespace {

/// Largest difference between the share of `passes` luxels on one side of a straight edge and the
/// area there, over edges of 16 directions and 16 places.
template <class Place>
double worst_edge(std::uint64_t passes, const Place& place) {
    double worst = 0.0;
    for (int i = 0; i < 256; ++i) {
        const double angle = (i % 16) * 0.3926990816987241;
        const double x = std::cos(angle);
        const double y = std::sin(angle);
        const double offset = (i / 16 - 7.5) / 16.0;
        double seen = 0.0;
        for (std::uint64_t p = 0; p < passes; ++p) {
            const mir::Vec2 at = place(p);
            if (x * (double{at.x} - 0.5) + y * (double{at.y} - 0.5) < offset) ++seen;
        }
        double area = 0.0;
        constexpr int side = 256;
        for (int k = 0; k < side * side; ++k)
            if (x * ((k % side + 0.5) / side - 0.5) + y * ((k / side + 0.5) / side - 0.5) < offset)
                area += 1.0 / (side * side);
        worst = std::max(worst, std::fabs(seen / static_cast<double>(passes) - area));
    }
    return worst;
}

constexpr mir::Vec2 centre{0.5f, 0.5f};

}  // namespace

TEST_CASE("the only luxel of a pixel starts where it is told and stays in the pixel") {
    static_assert(mir::moved_luxel(centre, 0) == centre);
    for (const mir::Vec2 first : {centre, mir::Vec2{1e-6f, 0.99999994f}}) {
        CHECK(mir::moved_luxel(first, 0) == first);
        for (std::uint64_t pass = 1; pass < 5000; ++pass) {
            const mir::Vec2 at = mir::moved_luxel(first, pass);
            CHECK((at.x > 0.0f && at.x < 1.0f && at.y > 0.0f && at.y < 1.0f));
        }
    }
    CHECK(mir::moved_luxel(centre, 1) != mir::moved_luxel(centre, 2));
}

TEST_CASE("however many passes there are, their luxels fill the pixel evenly") {
    const auto moved = [](std::uint64_t pass) { return mir::moved_luxel(centre, pass); };
    CHECK(worst_edge(4, moved) < 0.5);
    CHECK(worst_edge(16, moved) < 0.25);
    CHECK(worst_edge(64, moved) < 0.07);
    CHECK(worst_edge(250, moved) < 0.025);
    const auto stays = [](std::uint64_t) { return centre; };
    CHECK(worst_edge(64, stays) > 0.4);
    const auto along_one_axis = [](std::uint64_t pass) {
        const float x = mir::moved_luxel(centre, pass).x;
        return mir::Vec2{x, x};
    };
    CHECK(worst_edge(64, along_one_axis) > 0.1);
}
