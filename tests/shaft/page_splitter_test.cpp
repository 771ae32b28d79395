// SPDX-License-Identifier: MIT
#include "mir/shaft/host/detail/page_splitter.hpp"

#include "mir/core/random.hpp"
#include "mir/scene/bounds.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

namespace {

using mir::Vec3;
using Points = std::vector<Vec3>;

/// Luxels times the sum of the extents of their box.
double cost_of(const Points& points, std::size_t first, std::size_t end) {
    mir::Bounds box;
    for (std::size_t i = first; i < end; ++i) box.add(points[i]);
    const Vec3 size = box.high - box.low;
    return static_cast<double>(end - first) * (size.x + size.y + size.z);
}

/// Of the medians along the axes on which the points are at least a quarter as wide as on the
/// widest, the cheapest.
double least_cost(Points points, std::size_t part) {
    mir::Bounds box;
    for (const Vec3& p : points) box.add(p);
    const Vec3 size = box.high - box.low;
    const float widest = std::max(size.x, std::max(size.y, size.z));
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] < 0.25f * widest) continue;
        std::sort(points.begin(), points.end(),
                  [&](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
        least = std::min(least, cost_of(points, 0, part) + cost_of(points, part, points.size()));
    }
    return least;
}

struct Cuts {
    std::size_t count = 0;
    std::size_t dear = 0;  ///< cost more than the cheapest median
};

/// Compares all cuts of an order with the cheapest ones.
void check_cuts(const Points& ordered, Cuts& cuts) {
    if (ordered.size() <= mir::detail::smallest_cluster) return;
    const std::size_t part = mir::detail::first_part(ordered.size());
    const double found = cost_of(ordered, 0, part) + cost_of(ordered, part, ordered.size());
    ++cuts.count;
    // Places are told apart in 2^16 steps.
    cuts.dear += found > 1.001 * least_cost(ordered, part) ? 1 : 0;
    const auto middle = ordered.begin() + static_cast<std::ptrdiff_t>(part);
    check_cuts(Points(ordered.begin(), middle), cuts);
    check_cuts(Points(middle, ordered.end()), cuts);
}

Points in_order(const Points& points) {
    const auto coordinates = std::make_unique<mir::detail::PageCoordinates>();
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            (*coordinates)[static_cast<std::size_t>(axis)][i] = points[i][axis];
    const auto count = static_cast<std::uint32_t>(points.size());
    const mir::detail::PageSplitter splitter(*coordinates, count);
    Points ordered;
    std::vector<std::uint32_t> numbers(splitter.order().begin(), splitter.order().begin() + count);
    for (const std::uint32_t i : numbers) ordered.push_back(points[i]);
    std::sort(numbers.begin(), numbers.end());
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    CHECK(numbers == all);
    return ordered;
}

Points points_on(Vec3 size, std::uint32_t count) {
    mir::Random random = mirtest::test_random(count);
    Points points;
    for (std::uint32_t i = 0; i < count; ++i)
        points.push_back(size * Vec3(random.next(), random.next(), random.next()) - 0.3f * size);
    return points;
}

}  // namespace

TEST_CASE("All cuts of a page are the cheapest of three medians") {
    const std::uint32_t count = GENERATE(1u, 15u, 17u, 100u, 256u, 700u, 1024u);
    for (const Vec3 size : {Vec3(1, 1, 1), Vec3(0, 2, 1), Vec3(0.3f, 0.4f, 9), Vec3(0, 0, 1e-3f)}) {
        Cuts cuts;
        check_cuts(in_order(points_on(size, count)), cuts);
        CHECK(cuts.count == (count - 1) / 16);
        CHECK(cuts.dear == 0);
    }
}

TEST_CASE("A cut takes two surfaces apart that the widest axis would cut through") {
    // Two strips one above the other: half as far apart as they are long.
    Points points;
    for (std::uint32_t i = 0; i < 512; ++i)
        points.emplace_back(0.01f * static_cast<float>(i % 256), i < 256 ? 0.0f : 1.3f, 0.0f);
    const Points ordered = in_order(points);
    CHECK(std::all_of(ordered.begin(), ordered.begin() + 256,
                      [&](const Vec3& p) { return p.y == ordered.front().y; }));
}

TEST_CASE("Points that are all one keep their order") {
    const Points points(300, Vec3(1, 2, 3));
    CHECK(in_order(points) == points);
}
