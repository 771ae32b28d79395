// SPDX-License-Identifier: MIT
#include "mir/scene/light_table.hpp"
#include "mir/scene/shapes.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

namespace {

using mir::Scene;
using mir::Vec3;
using mir::WorldGeometry;
namespace builtin = mir::builtin;

/// A ceiling of 4 x 4 m at a height of 2 m, seen from below.
Scene ceiling() {
    Scene s;
    s.add(mir::lambertian("white", {0.5f, 0.5f, 0.5f}));
    s.place(builtin::quad("ceiling", 0, {-2, 2, -2}, {4, 0, 0}, {0, 0, 4}));
    return s;
}

std::uint32_t lamp_material(Scene& s, float radiance, bool both_sides = false) {
    mir::Material m = mir::emitter("lamp", {}, {radiance, radiance, radiance});
    m.emits_from_both_sides = both_sides;
    return s.add(m);
}

/// One square metre that shines downwards, or upwards where it is `turned`.
void hang(Scene& s, std::uint32_t material, float height = 2.0f, bool turned = false) {
    const Vec3 x(1, 0, 0);
    const Vec3 z(0, 0, 1);
    s.place(
        builtin::quad("lamp", material, {-0.5f, height, -0.5f}, turned ? z : x, turned ? x : z));
}

/// Materials in the order of their heights.
std::vector<std::uint32_t> layers(const WorldGeometry& g) {
    std::vector<std::uint32_t> order(g.triangles().size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return g.corner(a, 0).y < g.corner(b, 0).y;
    });
    std::vector<std::uint32_t> materials;
    for (const std::uint32_t t : order) materials.push_back(g.material_of(t));
    materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
    return materials;
}

/// Edges of triangles [first, last) that no other of them runs along the other way.
std::size_t open_edges(const WorldGeometry& g, std::uint32_t first, std::uint32_t last) {
    using Place = std::array<float, 3>;
    std::set<std::pair<Place, Place>> edges;
    for (std::uint32_t t = first; t < last; ++t)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vec3 a = g.corner(t, k);
            const Vec3 b = g.corner(t, (k + 1) % 3);
            edges.insert({{a.x, a.y, a.z}, {b.x, b.y, b.z}});
        }
    return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const auto& e) {
        return edges.count({e.second, e.first}) == 0;
    }));
}

using Layers = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("a lamp in a wall is lifted off it to the side from which it shines") {
    Scene s = ceiling();
    const std::uint32_t lamp = lamp_material(s, 3.0f);
    hang(s, lamp, 2.0f, GENERATE(false, true));
    const WorldGeometry g(s);
    const float down = g.front_normal(2).y;
    CHECK(layers(g) == (down < 0.0f ? Layers{lamp, 0} : Layers{0, lamp}));
    CHECK(g.coinciding_triangles() == 4);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const float off = down * (g.corner(2, k).y - 2.0f);
        CHECK(off >= 4.0f * g.view().offset_at(g.corner(2, k), 0.5f));
        CHECK(off < 5e-4f);
    }
    CHECK_FALSE(g.is_split(2));
}

TEST_CASE("lamps that keep off walls, or close a hole in one, stay where they are") {
    Scene s;
    s.add(mir::lambertian("white", {0.5f, 0.5f, 0.5f}));
    for (const float side : {-1.5f, 0.5f})
        s.place(builtin::quad("rest", 0, {side, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}));
    const std::uint32_t lamp = lamp_material(s, 3.0f);
    hang(s, lamp);
    hang(s, lamp, 1.999f);
    const WorldGeometry g(s);
    CHECK(g.coinciding_triangles() == 0);
    CHECK(g.positions().size() == 16);
    CHECK(g.corner(4, 0).y == 2.0f);
}

TEST_CASE("a lamp that shines from both sides of a wall has a half on each") {
    Scene s = ceiling();
    const std::uint32_t lamp = lamp_material(s, 3.0f, true);
    hang(s, lamp);
    const WorldGeometry g(s);
    CHECK(layers(g) == Layers{lamp, 0, lamp});
    REQUIRE(g.triangles().size() == 6);
    for (std::uint32_t t = 2; t < 6; ++t) {
        CHECK(g.is_split(t));
        CHECK(g.front_normal(t).y * (g.corner(t, 0).y - 2.0f) > 0.0f);
    }
    const mir::LightTable lights(s, g);
    CHECK(lights.power() == mirtest::Approx(2.0 * 3.0 * 3.14159265).epsilon(1e-5));
    CHECK_FALSE(lights.lamps().view().lamp_triangles[0].both_sides);
    Scene free;
    hang(free, lamp_material(free, 3.0f, true));
    const WorldGeometry alone(free);
    const mir::LightTable free_lights(free, alone);
    CHECK(free_lights.lamps().view().lamp_triangles[0].both_sides);
    CHECK(free_lights.power() == mirtest::Approx(lights.power()).epsilon(1e-5));
}

TEST_CASE("of lamps in one place the first lies before the others") {
    Scene s = ceiling();
    const std::uint32_t first = lamp_material(s, 3.0f);
    const std::uint32_t second = lamp_material(s, 5.0f);
    hang(s, first);
    hang(s, second);
    CHECK(layers(WorldGeometry(s)) == Layers{first, second, 0});
}

TEST_CASE("lamps back to back lie on the sides from which they shine") {
    Scene s;
    const std::uint32_t down = lamp_material(s, 3.0f);
    const std::uint32_t up = lamp_material(s, 5.0f);
    hang(s, down);
    hang(s, up, 2.0f, true);
    const WorldGeometry g(s);
    CHECK(layers(g) == Layers{down, up});
    CHECK(g.coinciding_triangles() == 4);
}

TEST_CASE("a curved lamp in a curved wall stays closed") {
    Scene s;
    s.add(mir::lambertian("white", {0.5f, 0.5f, 0.5f}));
    const std::uint32_t lamp = lamp_material(s, 1.0f);
    for (const std::uint32_t material : {0u, lamp})
        s.place(builtin::sphere("ball", material, {0.3f, 1, 2}, 1.0f, 24, 12));
    const WorldGeometry g(s);
    const auto all = static_cast<std::uint32_t>(g.triangles().size());
    CHECK(g.coinciding_triangles() == all);
    // The ball's seam is open already: the sine of a whole turn is not 0.
    CHECK(open_edges(g, all / 2, all) == open_edges(g, 0, all / 2));
    CHECK(open_edges(g, 0, all / 2) < all / 8);
}

TEST_CASE("lifted lamps are the same in any number of threads") {
    Scene s = ceiling();
    for (int i = 0; i < 3; ++i) hang(s, lamp_material(s, 1.0f, i == 1), 2.0f, i == 2);
    s.place(builtin::sphere("ball", 0, {0, 0, 0}, 1.0f, 128, 96));
    mirtest::BackwardsExecutor backwards{3};
    const WorldGeometry one(s);
    const WorldGeometry other(s, {}, backwards);
    CHECK(std::equal(one.positions().begin(), one.positions().end(), other.positions().begin(),
                     other.positions().end()));
    CHECK(std::equal(one.triangles().begin(), one.triangles().end(), other.triangles().begin(),
                     other.triangles().end()));
}
