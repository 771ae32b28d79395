// SPDX-License-Identifier: MIT
#include "conformance/worlds.hpp"
#include "mir/accel/kd/detail/kd_bins.hpp"
#include "mir/accel/kd/detail/kd_prepare.hpp"
#include "mir/accel/kd/detail/kd_sweep.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <limits>

using namespace mirtest;
using mir::Vec3;
namespace kd = mir::detail;

namespace {

struct Prepared {
    mir::detail::RawArray<mir::TriangleRows> rows;
    kd::KdPrepared parts;

    explicit Prepared(const World& world) {
        mir::InlineExecutor executor;
        parts = kd::prepare(world.geometry, rows, executor);
    }
    [[nodiscard]] std::span<const kd::KdFragment> fragments() const {
        return parts.fragments.span();
    }
};

/// Relative cost of a plane, from the definition of the surface area heuristic.
double cost_of(std::span<const kd::KdFragment> fragments, const kd::KdCell& cell, int axis,
               float at, double bonus) {
    double w[3];
    for (int k = 0; k < 3; ++k) w[k] = double(cell.high[k]) - double(cell.low[k]);
    const auto area = [&](double extent) {
        const double a = w[(axis + 1) % 3];
        const double b = w[(axis + 2) % 3];
        return a * b + extent * (a + b);
    };
    double below = 0.0;
    double above = 0.0;
    for (const kd::KdFragment& f : fragments) {
        below += f.low[axis] < at ? 1 : 0;
        above += f.high[axis] > at ? 1 : 0;
    }
    const double cost = (below * area(double(at) - double(cell.low[axis])) +
                         above * area(double(cell.high[axis]) - double(at))) /
                        area(w[axis]);
    return below == 0.0 || above == 0.0 ? cost * (1.0 - bonus) : cost;
}

/// Cheapest of all planes through begins and ends, asked one by one.
double least_cost(std::span<const kd::KdFragment> fragments, const kd::KdCell& cell, double bonus) {
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
        for (const kd::KdFragment& f : fragments)
            for (float at : {f.low[axis], f.high[axis]})
                if (at > cell.low[axis] && at < cell.high[axis])
                    least = std::min(least, cost_of(fragments, cell, axis, at, bonus));
    return least;
}

kd::KdCell grown(kd::KdCell cell, float by) {
    for (int axis = 0; axis < 3; ++axis) {
        cell.low[axis] -= by;
        cell.high[axis] += by;
    }
    return cell;
}

}  // namespace

TEST_CASE("Keys are sorted in every lane, for every number of keys") {
    mir::Random random = test_random(20);
    const std::size_t n = GENERATE(range(std::size_t{1}, 2 * kd::kd_sweep_limit + 1));
    alignas(64) kd::Int4 keys[2 * kd::kd_sweep_limit];
    std::vector<std::int32_t> expected[4];
    for (std::size_t i = 0; i < n; ++i)
        for (int lane = 0; lane < 4; ++lane) {
            // Few values, so that many are equal.
            keys[i][lane] = static_cast<std::int32_t>(random.next() * 40.0f) - 20;
            expected[lane].push_back(keys[i][lane]);
        }
    kd::sort_lanes(keys, n);
    for (int lane = 0; lane < 4; ++lane) {
        std::sort(expected[lane].begin(), expected[lane].end());
        std::vector<std::int32_t> sorted;
        for (std::size_t i = 0; i < n; ++i) sorted.push_back(keys[i][lane]);
        CHECK(sorted == expected[lane]);
    }
}

TEST_CASE("Keys of numbers are ordered as the numbers are and give them back") {
    const std::vector<float> numbers{-1e30f, -2.0f, -0x1p-120f, 0.0f, 0x1p-120f, 3.0f, 1e30f};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const float even = kd::even_lanes(kd::all_lanes(numbers[i]))[0];
        CHECK(kd::number_of(kd::ordered_key(even)) == even);
        CHECK((kd::ordered_key(even) & 1) == 0);
        if (i > 0) {
            CHECK(kd::ordered_key(kd::even_lanes(kd::all_lanes(numbers[i - 1]))[0]) <
                  kd::ordered_key(even));
        }
    }
}

TEST_CASE("The search in small nodes finds the cheapest of all planes") {
    const std::uint32_t count = GENERATE(1u, 2u, 3u, 5u, 8u, 9u, 15u, 16u, 17u, 23u, 31u, 32u);
    const float room = GENERATE(0.0f, 1.5f);
    const World world = triangle_soup(count, 21 + count);
    const Prepared prepared(world);
    const kd::KdCell cell = grown(prepared.parts.cell, room);
    mir::KdTreeOptions options;
    options.traversal_cost = 1e-3f;
    options.empty_bonus = 0.3f;
    const kd::KdCost cost(cell, count, options);
    const kd::KdSplit best = kd::KdSweep(prepared.fragments()).best(cost);
    const double least = least_cost(prepared.fragments(), cell, 0.3);
    if (least < double(cost.limit)) {
        REQUIRE(best.kind != kd::KdCutKind::none);
        CHECK(double(best.cost) == Approx(least).epsilon(1e-5));
        CHECK(cost_of(prepared.fragments(), cell, best.axis, best.at, 0.3) ==
              Approx(least).epsilon(1e-5));
    } else {
        CHECK(best.kind == kd::KdCutKind::none);
    }
}

TEST_CASE("The search in large nodes is within two percent of the cheapest plane") {
    const std::uint32_t count = GENERATE(33u, 70u, 300u, 1500u);
    const World world = triangle_soup(count, 40 + count);
    const Prepared prepared(world);
    const mir::KdTreeOptions options;
    const kd::KdCost cost(prepared.parts.cell, count, options);
    kd::KdBinSearch search;
    search.start(prepared.fragments());
    const kd::KdSplit best = search.best(cost);
    REQUIRE(best.kind != kd::KdCutKind::none);
    const double bonus = double(options.empty_bonus);
    const double least = least_cost(prepared.fragments(), prepared.parts.cell, bonus);
    const double found =
        cost_of(prepared.fragments(), prepared.parts.cell, best.axis, best.at, bonus);
    CHECK(double(best.cost) == Approx(found).epsilon(1e-4));
    CHECK(found <= 1.02 * least);
}

TEST_CASE("Costs of planes are the same at any scale") {
    const float scale = GENERATE(0x1p-110f, 0x1p-40f, 0x1p40f, 0x1p110f);
    const kd::KdCell one{{-1, -2, 0, 0}, {2, 1, 0.5f, 0}};
    const kd::KdCell other{one.low * kd::all_lanes(scale), one.high * kd::all_lanes(scale)};
    const kd::KdCost a(one, 10, {});
    const kd::KdCost b(other, 10, {});
    CHECK(a.usable);
    CHECK(b.usable);
    for (int axis = 0; axis < 3; ++axis)
        CHECK(a(axis, 0.25f, 3.0f, 9.0f) == b(axis, scale * 0.25f, 3.0f, 9.0f));
}

TEST_CASE("The exact search reaches the next begin or end on either side of a border") {
    // All bins between the first and the last are empty; the cheapest border lies at one end of
    // them.
    const std::uint32_t below = GENERATE(10u, 40u);
    constexpr std::uint32_t all = 50;
    kd::KdContent content;
    content.low = kd::Float4{0, 0, 0, 0};
    content.high = kd::Float4{1, 1, 1, 0};
    const kd::KdGrid grid(content, all);
    const int last = grid.bins - 1;
    kd::KdBins bins;
    bins.clear(grid.bins);
    for (int axis = 0; axis < 3; ++axis) {
        bins.begins[0][axis] = bins.ends[0][axis] = below;
        bins.begins[last][axis] = bins.ends[last][axis] = all - below;
    }
    const kd::KdCost cost({content.low, content.high}, all, {});
    const kd::KdBorder border = kd::best_border(bins, grid, cost);
    CHECK(border.first_bin == 0);
    CHECK(border.last_bin == last);
    CHECK(border.below == 0);
    CHECK(border.ended == 0);
}

TEST_CASE("A gap wider than a bin between two bodies does not stop the search") {
    // All but two bins on x are empty, the cheapest border is far from where anything ends.
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    for (float x : {-100.0f, 100.0f})
        scene.place(mir::builtin::sphere("s", grey, {x, 0, 0}, 1.0f, 24, 12));
    const World world(std::move(scene));
    const Prepared prepared(world);
    const kd::KdCost cost(prepared.parts.cell, prepared.fragments().size(), {});
    kd::KdBinSearch search;
    search.start(prepared.fragments());
    const kd::KdSplit best = search.best(cost);
    REQUIRE(best.kind == kd::KdCutKind::parts);
    CHECK(best.axis == 0);
    CHECK(std::abs(best.at) == Approx(99.0f).epsilon(1e-3));
}
