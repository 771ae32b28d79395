// SPDX-License-Identifier: MIT
#include "io/detail/polygon.hpp"

#include "support/catch.hpp"

#include <numbers>
#include <vector>

using mir::Vec3;
using mir::detail::PolygonCutter;

namespace {

double signed_area(const std::vector<Vec3>& p, const mir::TriangleIndices& t) {
    return 0.5 * glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z;
}

/// Sum and least of the signed areas of a polygon's triangles, as seen along -z.
struct Areas {
    double sum = 0.0;
    double least = 1e30;
    std::size_t triangles = 0;
};

Areas cut(const std::vector<Vec3>& polygon) {
    PolygonCutter cutter;
    Areas areas;
    for (const mir::TriangleIndices& t : cutter.cut(polygon)) {
        const double area = signed_area(polygon, t);
        areas.sum += area;
        areas.least = std::min(areas.least, area);
        ++areas.triangles;
    }
    return areas;
}

/// The polygon in another place.
std::vector<Vec3> moved(std::vector<Vec3> polygon, Vec3 by) {
    for (Vec3& p : polygon) p += by;
    return polygon;
}

/// A star of `tips` points around the origin, counter-clockwise.
std::vector<Vec3> star(int tips, float inner) {
    std::vector<Vec3> p;
    for (int i = 0; i < 2 * tips; ++i) {
        const float angle =
            std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(tips);
        const float radius = i % 2 == 0 ? 1.0f : inner;
        p.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0f);
    }
    return p;
}

/// A spiral corridor: nothing but dents along its inside.
std::vector<Vec3> spiral(int turns) {
    std::vector<Vec3> p;
    const int n = 16 * turns;
    for (int side = 0; side < 2; ++side)
        for (int k = 0; k < n; ++k) {
            const int i = side == 0 ? k : n - 1 - k;
            const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / 8.0f;
            const float radius =
                1.0f + 0.1f * static_cast<float>(i) - 0.4f * static_cast<float>(side);
            p.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0f);
        }
    return p;
}

/// Twice-signed shoelace sum: the area whatever the triangles are.
double shoelace(const std::vector<Vec3>& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 a = p[i];
        const Vec3 b = p[(i + 1) % p.size()];
        sum += 0.5 * (double{a.x} * b.y - double{b.x} * a.y);
    }
    return sum;
}

}  // namespace

TEST_CASE("a convex polygon becomes a fan") {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    PolygonCutter cutter;
    CHECK(cutter.is_convex(square));
    CHECK(cutter.cut(square) == std::vector<mir::TriangleIndices>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("polygons with dents are covered exactly once wherever they lie") {
    const std::vector<Vec3> arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5f, 1, 0}};
    for (const auto& polygon : {arrow, star(5, 0.3f), star(40, 0.05f), spiral(3)})
        for (const Vec3 by : {Vec3(0), Vec3(-100, 50, 7), Vec3(3, -4, 0)}) {
            const auto p = moved(polygon, by);
            const Areas areas = cut(p);
            CHECK(areas.triangles == p.size() - 2);
            CHECK(areas.sum == Approx(shoelace(polygon)).epsilon(1e-4));
            // Nothing is covered twice and taken away again.
            CHECK(areas.least >= 0.0);
        }
}

TEST_CASE("a polygon seen from behind keeps turning as it did") {
    auto polygon = star(5, 0.3f);
    std::reverse(polygon.begin(), polygon.end());
    PolygonCutter cutter;
    for (const mir::TriangleIndices& t : cutter.cut(polygon)) CHECK(signed_area(polygon, t) <= 0.0);
}

TEST_CASE("an outline that is tied to its hole is cut with the hole left open") {
    const std::vector<Vec3> ring{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                 {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    const Areas areas = cut(ring);
    CHECK(areas.sum == Approx(12.0));
    CHECK(areas.least >= 0.0);
}

TEST_CASE("polygons without a right answer still end, with two triangles fewer than corners") {
    std::vector<Vec3> repeated;
    for (int i = 0; i < 1000; ++i) repeated.push_back({i % 4 / 2, (i + 1) % 4 / 2, 0});
    const std::vector<Vec3> bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Vec3> point(7, Vec3(1, 2, 3));
    const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {1, 1, 1}};
    for (const auto& polygon : {repeated, bow, point, line})
        CHECK(cut(polygon).triangles == polygon.size() - 2);
}
