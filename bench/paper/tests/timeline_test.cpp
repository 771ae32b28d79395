// SPDX-License-Identifier: MIT
#include "paper/timeline.hpp"

#include "paper/spread.hpp"
#include "support/catch.hpp"

using mirpaper::Interval;
using mirpaper::Work;

TEST_CASE("A timeline says how long each kind of work took and what was saved by overlap") {
    // upload   |---|     |-|
    // shading    |---|
    const auto s = mirpaper::summarise(
        {{Work::upload, 1.0, 4.0}, {Work::shading, 3.0, 6.0}, {Work::upload, 8.0, 9.0}});
    CHECK(s.of[static_cast<std::size_t>(Work::upload)] == 4.0);
    CHECK(s.of[static_cast<std::size_t>(Work::shading)] == 3.0);
    CHECK(s.sum() == 7.0);
    CHECK(s.busy == 6.0);
    CHECK(s.span == 8.0);
    CHECK(s.overlap() == mirtest::Approx(1.0 / 7.0));
    CHECK(s.hidden_transfer() == mirtest::Approx(0.25));
}

TEST_CASE("Intervals inside others, touching, unordered or empty are counted once") {
    const auto any = [](Work) { return true; };
    CHECK(mirpaper::busy_seconds({{Work::fused, 2.0, 3.0}, {Work::fused, 0.0, 10.0}}, any) == 10.0);
    CHECK(mirpaper::busy_seconds(
              {{Work::fused, 0.0, 10.0}, {Work::fused, 2.0, 3.0}, {Work::fused, 4.0, 11.0}}, any) ==
          11.0);
    CHECK(mirpaper::busy_seconds({{Work::fused, 2.0, 3.0}, {Work::fused, 1.0, 2.0}}, any) == 2.0);
    CHECK(mirpaper::busy_seconds({{Work::fused, 5.0, 5.0}}, any) == 0.0);
    CHECK(mirpaper::busy_seconds({{Work::fused, -3.0, -1.0}}, any) == 2.0);
}

TEST_CASE("An empty timeline takes no time") {
    const auto s = mirpaper::summarise({});
    CHECK(s.sum() == 0.0);
    CHECK(s.overlap() == 0.0);
    CHECK(s.hidden_transfer() == 0.0);
}

TEST_CASE("A spread holds the median and both ends") {
    const mirpaper::Spread odd = mirpaper::spread_of({3.0, 9.0, 1.0});
    CHECK(odd.median == 3.0);
    CHECK(odd.min == 1.0);
    CHECK(odd.max == 9.0);
    CHECK(odd.count == 3);
    CHECK(mirpaper::spread_of({4.0, 1.0, 2.0, 100.0}).median == 3.0);
    CHECK(mirpaper::spread_of({}).count == 0);
}
