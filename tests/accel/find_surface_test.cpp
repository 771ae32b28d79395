// SPDX-License-Identifier: MIT
#include "mir/accel/exact/find_surface.hpp"

#include "accel/against_brute_force.hpp"
#include "accel/build_worlds.hpp"
#include "accel/wide_nodes.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/wide/wide_bvh.hpp"
#include "mir/accel/wide/wide_rays.hpp"
#include "support/closed_rooms.hpp"

namespace {

using mir::Vec3;

/// What rays from outside of a closed body meet.
struct Met {
    std::size_t points = 0;
    std::size_t by_edges = 0;  ///< hits that rounding may have decided
    std::size_t inside = 0;    ///< points that lie in the body once they are lifted
    std::size_t refused = 0;   ///< those that would without a second look
};

/// Whether a point lies in a convex body around `centre`, on that side of all planes.
bool lies_inside(const mir::WorldGeometry& g, Vec3 centre, Vec3 p) {
    using Double3 = mir::detail::Double3;
    for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
        const mir::detail::TriangleFrame f =
            mir::detail::triangle_frame(g.corner(t, 0), g.corner(t, 1), g.corner(t, 2));
        const double inner = glm::dot(Double3(centre) - f.corner, f.normal);
        if (inner * glm::dot(Double3(p) - f.corner, f.normal) <= 0.0) return false;
    }
    return true;
}

/// Rays from outside, past edges and vertices that are seen from the side: aimed at them from
/// places in the plane of one of their triangles.
template <class Finder>
Met meet_from_outside(const mirtest::World& body, Vec3 centre, const Finder& finder,
                      std::size_t count, std::uint64_t index) {
    const mirtest::ScenePlaces places(body.geometry);
    mir::Random random = mirtest::test_random(index);
    Met met;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t t = places.triangle(random);
        const std::uint32_t k = mirtest::random_index(random, 3);
        const float share = random.next() < 0.3f ? 0.0f : random.next();
        const Vec3 at = (1.0f - share) * body.geometry.corner(t, k) +
                        share * body.geometry.corner(t, (k + 1) % 3);
        const Vec3 aside = places.in_plane(t, random) - at;
        const Vec3 outwards = at - centre;
        const Vec3 way = aside + std::max(0.0f, -glm::dot(aside, outwards)) * outwards;
        const Vec3 from = at + 4.0f * places.extent() * glm::normalize(way + 1e-3f * outwards);
        const mir::Ray ray{from, glm::normalize(at - from)};
        const mir::TriangleHit first = finder.closest(ray);
        met.by_edges += first.by_edge ? 1 : 0;
        mir::SurfacePoint p;
        if (first.triangle != mir::TriangleHit::none) {
            p = body.geometry.surface_point(first.triangle, first.barycentrics, ray);
            met.refused += lies_inside(body.geometry, centre, mir::lift(p)) ? 1 : 0;
        }
        if (!find_surface(finder, body.geometry.view(), ray, p)) continue;
        ++met.points;
        met.inside += lies_inside(body.geometry, centre, mir::lift(p)) ? 1 : 0;
    }
    return met;
}

void check_outside(const Met& met, std::size_t count) {
    INFO(met.points << " points, " << met.by_edges << " by edges, " << met.refused
                    << " would lie inside");
    CHECK(met.points > count / 10);
    CHECK(met.by_edges > count / 10);
    CHECK(met.inside == 0);
    // Else the test asks for nothing: without a second look light would get in.
    CHECK(met.refused > 0);
}

}  // namespace

TEST_CASE("No ray from outside of a closed body meets its inner side") {
    constexpr std::size_t count = 100000;
    const Vec3 centre(0.0f);
    const mirtest::World body = mirtest::closed_ball(4, 0.0f, 3);
    SECTION("by a kd-tree") {
        mir::InlineExecutor executor;
        const mir::KdTree tree(body.geometry, {}, executor);
        check_outside(meet_from_outside(
                          body, centre,
                          mir::KdRayFinder<mir::Space::host, mir::Opaque>{tree.view()}, count, 4),
                      count);
    }
    SECTION("by a wide hierarchy") {
        const mir::WideBvh bvh = mirtest::build_wide(body.geometry);
        check_outside(meet_from_outside(
                          body, centre,
                          mir::WideRayFinder<mir::Space::host, mir::Opaque>{bvh.view()}, count, 5),
                      count);
    }
}

TEST_CASE("Rays from inside of a rough closed body meet it, and leave it inside") {
    const mirtest::World body = mirtest::closed_ball(4, 0.4f, 6);
    const mir::WideBvh bvh = mirtest::build_wide(body.geometry);
    const mir::WideRayFinder<mir::Space::host, mir::Opaque> finder{bvh.view()};
    mirtest::LeakSegments segments(body.geometry, Vec3(0.0f), 7);
    std::size_t lost = 0;
    std::size_t outside = 0;
    for (int i = 0; i < 100000; ++i) {
        const mirtest::SegmentEnds s = segments.next();
        const mir::Ray ray{s.from, glm::normalize(s.to - s.from)};
        mir::SurfacePoint p;
        if (!find_surface(finder, body.geometry.view(), ray, p))
            ++lost;
        else if (finder.hides(ray.origin, mir::lift(p)))
            ++outside;
    }
    CHECK(lost == 0);
    CHECK(outside == 0);
}
