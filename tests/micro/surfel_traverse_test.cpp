// SPDX-License-Identifier: MIT
#include "mir/micro/surfel_traverse.hpp"

#include "micro/brute_force_cut.hpp"
#include "micro/nearest_triangle.hpp"
#include "micro/surfel_worlds.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::StopShape;
using mir::Surfel;
using mir::SurfelHit;
using mir::SurfelNode;
using mir::SurfelRay;
using mir::SurfelTree;
using mir::Vec3;

namespace {

bool same(const SurfelHit& a, const SurfelHit& b) {
    return a.t == b.t && a.node == b.node && a.front == b.front;
}

/// Nearest disc of all, by asking each.
SurfelHit brute_force(const SurfelTree& tree, const SurfelRay& ray) {
    SurfelHit hit;
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i)
        if (tree.nodes()[i].is_leaf())
            mir::detail::meet_disc(tree.view(), tree.nodes()[i], i, ray, hit);
    return hit;
}

/// From anywhere around a scene within [-1, 1]^3, or from one of its surfaces.
SurfelRay random_ray(const World& world, mir::Random& random) {
    if (random.next() < 0.5f) return {2.0f * point_in_cube(random), direction(random)};
    const mir::SurfacePoint p = random_surface_point(world.geometry, random);
    const Vec3 n = p.geometric_normal;
    Vec3 d = direction(random);
    if (glm::dot(d, n) < 0.0f) d = -d;
    return {mir::lift(p), d, n};
}

/// True when all discs below a node show the same side to a point, seen in double precision.
bool same_side(const SurfelTree& tree, const SurfelNode& node, Vec3 from, bool front) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Surfel& s = tree.surfels()[i];
        const double height = glm::dot(glm::dvec3(s.normal), glm::dvec3(from - s.position));
        if ((height > 0.0) != front) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("Exact rays meet what asking every disc finds, in every bit") {
    const World worlds[] = {triangle_soup(40, 940), needles(10, 1e3f, 941), sphere_in_box(),
                            coincident(30)};
    const float areas[] = {5e-3f, 1e-3f, 1e-2f, 0.05f};
    mir::SurfelTreeOptions options;
    options.sphere = GENERATE(mir::SphereFit::mean, mir::SphereFit::smallest);
    options.split = GENERATE(mir::SurfelSplit::median, mir::SurfelSplit::orientation);
    const auto extent = GENERATE(mir::DiscExtent::piece, mir::DiscExtent::cover);
    mir::Random random = test_random(942);
    std::uint32_t met = 0;
    for (std::size_t w = 0; w < 4; ++w) {
        const SurfelTree tree = tree_of(worlds[w], areas[w], options, extent);
        std::uint32_t wrong = 0;
        for (int i = 0; i < 1500; ++i) {
            SurfelRay ray = random_ray(worlds[w], random);
            // A threshold that no node stays below makes no difference.
            ray.solid_angle = i % 2 == 0 ? 0.0f : 1e-30f;
            const SurfelHit hit = mir::closest_surfel(tree.view(), ray);
            wrong += same(hit, brute_force(tree, ray)) ? 0 : 1;
            met += hit.node != SurfelHit::none ? 1 : 0;
        }
        CHECK(wrong == 0);
    }
    CHECK(met > 900);
}

TEST_CASE(
    "Exact rays through the very rim of discs, from far away, meet what asking every disc finds") {
    const SurfelTree tree = tree_of(triangle_soup(12, 949), 10.0f, {}, mir::DiscExtent::cover);
    mir::Random random = test_random(950);
    std::uint32_t met = 0;
    std::uint32_t wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const Surfel& s = tree.surfels()[i % 12];
        const Vec3 out = glm::normalize(glm::cross(s.normal, direction(random)));
        // Perpendicular to the radius: the ray touches the sphere of the disc there.
        const mir::Vec2 turn = mir::unit_circle(random.next());
        const Vec3 d = glm::normalize(turn.x * s.normal + turn.y * glm::cross(s.normal, out));
        const SurfelRay ray{s.position + s.radius * out - 50.0f * d, d};
        const SurfelHit hit = mir::closest_surfel(tree.view(), ray);
        wrong += same(hit, brute_force(tree, ray)) ? 0 : 1;
        met += hit.node != SurfelHit::none && tree.nodes()[hit.node].first == i % 12u ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK((met > 4000 && met < 16000));  // rounding decides
}

TEST_CASE("Approximate rays stop where a node is small and shows one side, and nowhere else") {
    const World worlds[] = {triangle_soup(40, 943), sphere_in_box(), thin_wall()};
    const float omega = GENERATE(0.03f, 0.5f, 12.0f);
    mir::Random random = test_random(944);
    std::uint32_t stopped = 0;
    for (const World& world : worlds) {
        const SurfelTree tree = tree_of(world, 2e-3f);
        std::uint32_t wrong = 0;
        for (int i = 0; i < 1000; ++i) {
            SurfelRay ray = random_ray(world, random);
            ray.solid_angle = omega;
            const SurfelHit hit = mir::closest_surfel(tree.view(), ray);
            if (hit.node == SurfelHit::none || tree.nodes()[hit.node].is_leaf()) continue;
            const SurfelNode& node = tree.nodes()[hit.node];
            const double d = glm::distance(glm::dvec3(node.centre), glm::dvec3(ray.origin));
            const double s = std::pow(double(node.radius) / d, 2.0);
            const double angle = 2.0 * 3.14159265358979 * (1.0 - std::sqrt(1.0 - s));
            ++stopped;
            const bool small = s < 1.0 && angle <= double(omega) * (1.0 + 1e-5);
            wrong += small && same_side(tree, node, ray.origin, hit.front) ? 0 : 1;
        }
        CHECK(wrong == 0);
    }
    CHECK(stopped > 100);
}

TEST_CASE("A wall is met in few nodes from everywhere, from its own plane too") {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::quad("wall", grey, {-1, -1, 0.37f}, {2, 0.1f, 0}, {0, 2, 0.3f}));
    const SurfelTree tree = tree_of(World(std::move(scene)), 3e-4f);
    REQUIRE(tree.surfels().size() > 10000);
    const Surfel& s = tree.surfels()[0];
    const Vec3 across = glm::normalize(s.corner1);
    const float sine2 = mir::cap_sine_squared(0.02f);
    for (const float height : {0.0f, 1e-6f, 1e-4f, 1e-2f, 1.0f}) {
        const SurfelRay ray{s.position - 4.0f * across + height * s.normal, across};
        std::uint32_t ends = 0;
        for (std::uint32_t i = 0; i < tree.nodes().size();) {
            const SurfelNode& node = tree.nodes()[i];
            const bool is_end =
                node.is_leaf() ||
                mir::detail::stops_at(node, ray.normal, node.centre - ray.origin, sine2);
            i += is_end ? 2 * node.count - 1 : 1;
            ends += is_end ? 1 : 0;
        }
        CHECK(ends < 200);
    }
}

TEST_CASE("Approximate rays meet the nearest of the nodes where they end") {
    const World world = sphere_in_box();
    const SurfelTree tree = tree_of(world, 1e-3f);
    mir::Random random = test_random(945);
    std::uint32_t farther = 0;
    std::uint32_t nearer = 0;
    for (int i = 0; i < 2000; ++i) {
        SurfelRay ray = random_ray(world, random);
        ray.solid_angle = 0.02f;
        const float t = mir::closest_surfel(tree.view(), ray).t;
        const float cut = brute_force_cut(tree, ray).t;
        nearer += t < cut ? 1 : 0;
        farther += t > cut ? 1 : 0;
    }
    // A node's disc may reach out of the spheres above it, where there is nothing to be met.
    CHECK(nearer == 0);
    CHECK(farther < 40);
}

TEST_CASE("No ray that leaves a convex body meets it again, at any scale and place") {
    const auto extent = GENERATE(mir::DiscExtent::piece, mir::DiscExtent::cover);
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    const Vec3 move = scale * GENERATE(Vec3(0, 0, 0), Vec3(30, -10, 5));
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::sphere("sphere", grey, move, scale, 12, 6));
    const World world(std::move(scene));
    const SurfelTree tree = tree_of(world, 0.01f * scale * scale, {}, extent);
    mir::Random random = test_random(946);
    std::uint32_t met = 0;
    std::uint32_t rims = 0;
    for (int i = 0; i < 2000; ++i) {
        const mir::SurfacePoint p = random_surface_point(world.geometry, random);
        const Vec3 n = world.geometry.front_normal(p.triangle);
        Vec3 d = direction(random);
        if (glm::dot(d, n) < 0.0f) d = -d;
        SurfelRay ray{mir::lift(p.position, n, p.offset), d, n};
        met += mir::closest_surfel(tree.view(), ray).node != SurfelHit::none ? 1 : 0;
        ray.normal = {0, 0, 0};
        rims += mir::closest_surfel(tree.view(), ray).node != SurfelHit::none ? 1 : 0;
    }
    CHECK(met == 0);
    // Without the tangent plane, whole discs beyond the next edge stick out.
    if (extent == mir::DiscExtent::cover) CHECK(rims > 50);
}

TEST_CASE("Exact rays meet pieces where they meet triangles") {
    const World worlds[] = {triangle_soup(40, 951), needles(10, 1e3f, 952), sphere_in_box()};
    mir::Random random = test_random(953);
    std::uint32_t met = 0;
    std::uint32_t wrong = 0;
    for (const World& world : worlds) {
        const SurfelTree tree = tree_of(world, 5e-3f);
        for (int i = 0; i < 1500; ++i) {
            const SurfelRay ray = random_ray(world, random);
            const double exact = nearest_triangle(world.geometry, ray);
            const double t = double(mir::closest_surfel(tree.view(), ray).t);
            met += std::isfinite(exact) ? 1 : 0;
            wrong += t == exact || std::fabs(t - exact) < 1e-4 ? 0 : 1;
        }
    }
    CHECK(met > 900);
    CHECK(wrong <= 4);  // edges in profile, where rounding decides
}

TEST_CASE("No ray leaves a closed room between pieces, many do between discs of equal area") {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    // Far from the origin centres of discs are rounded more than rays are.
    const Vec3 middle = GENERATE(Vec3(0.0f), Vec3(1e4f, -2e4f, 1e4f));
    scene.place(mir::builtin::inside_out(
        mir::builtin::box("room", grey, middle - Vec3(1.0f), {2, 0, 0}, {0, 2, 0}, {0, 0, 2})));
    const World world(std::move(scene));
    const float omega = GENERATE(0.0f, 0.05f);
    mir::InlineExecutor executor;
    const auto lost = [&](mir::DiscExtent extent) {
        const SurfelTree tree(surfels_of(world, 2e-3f, extent), base_color(world), {}, executor);
        mir::Random random = test_random(947);
        std::uint32_t count = 0;
        for (int i = 0; i < 4000; ++i) {
            SurfelRay ray{middle + 0.9f * point_in_cube(random), direction(random)};
            ray.solid_angle = omega;
            count += mir::closest_surfel(tree.view(), ray).node == SurfelHit::none ? 1 : 0;
        }
        return count;
    };
    CHECK(lost(mir::DiscExtent::piece) == 0);
    CHECK(lost(mir::DiscExtent::cover) == 0);
    if (omega == 0.0f) CHECK(lost(mir::DiscExtent::equal_area) > 100);
}

TEST_CASE("Approximate rays see the near side of a thin wall, and spheres mix up its sides") {
    const World world = thin_wall();
    const SurfelTree tree = tree_of(world, 1e-3f);
    const auto far_sides = [&](StopShape shape) {
        mir::Random random = test_random(948);
        std::uint32_t count = 0;
        for (int i = 0; i < 2000; ++i) {
            const mir::Vec2 place = random.next_2d();
            const mir::Vec2 target = random.next_2d();
            const float height = i % 2 == 0 ? 0.7f : -0.7f;
            const Vec3 origin(place.x, place.y, height);
            const Vec3 to(0.1f + 0.8f * target.x, 0.1f + 0.8f * target.y, 0.0f);
            const SurfelRay ray{origin, glm::normalize(to - origin), {0, 0, 0}, 0.05f};
            const SurfelHit hit = mir::closest_surfel(tree.view(), ray, shape);
            REQUIRE(hit.node != SurfelHit::none);
            const SurfelNode& node = tree.nodes()[hit.node];
            // The materials of front and back: 0 and 1.
            const std::uint32_t near = height > 0.0f ? 0 : 1;
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
                if (tree.surfels()[k].material != near) {
                    ++count;
                    break;
                }
        }
        return count;
    };
    CHECK(far_sides(StopShape::disc) == 0);
    CHECK(far_sides(StopShape::sphere) > 100);
}

TEST_CASE("Rays through an empty scene and past a single disc meet nothing") {
    const World empty{mir::Scene{}};
    CHECK(mir::closest_surfel(tree_of(empty, 1.0f).view(), {}).node == SurfelHit::none);
    const World world = coincident(1);
    const SurfelTree tree = tree_of(world, 100.0f, {}, mir::DiscExtent::cover);
    const Surfel& disc = tree.surfels()[0];
    const Vec3 side = glm::normalize(glm::cross(disc.normal, Vec3(1, 0, 0)));
    const auto from = [&](float off, float solid_angle) {
        return SurfelRay{disc.position + 2.0f * disc.normal + off * disc.radius * side,
                         -disc.normal,
                         {0, 0, 0},
                         solid_angle};
    };
    for (float omega : {0.0f, 6.0f}) {
        const SurfelHit hit = mir::closest_surfel(tree.view(), from(0.99f, omega));
        CHECK(hit.node == 0);
        CHECK(hit.front);
        CHECK(double(hit.t) == Approx(2.0));
        CHECK(mir::closest_surfel(tree.view(), from(1.01f, omega)).node == SurfelHit::none);
    }
}
