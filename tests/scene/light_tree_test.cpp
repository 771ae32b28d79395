// SPDX-License-Identifier: MIT
#include "mir/scene/lights/light_tree.hpp"

#include "conformance/worlds.hpp"
#include "mir/core/frame.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/lights/lamp_along_ray.hpp"
#include "mir/scene/shapes.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::LightReceiver;
using mir::LightTable;
using mir::Scene;
using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;

/// Small triangles in a cube, some of which shine from both sides, of powers over four decades.
void add_triangles(Scene& scene, std::uint32_t count, mir::Random& random) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const float light = std::pow(10.0f, 4.0f * random.next());
        mir::Material m = mir::emitter("lamp", {}, {light, light, light});
        m.emits_from_both_sides = i % 3 == 0;
        mir::Mesh mesh;
        mesh.material = scene.add(m);
        const Vec3 at = mirtest::point_in_cube(random);
        const float size = 0.2f * random.next();
        mesh.positions = {at, at + size * mirtest::direction(random),
                          at + size * mirtest::direction(random)};
        mesh.triangles = {{0, 1, 2}};
        scene.place(mesh);
    }
}

/// Points and spots of all widths.
void add_places(Scene& scene, std::uint32_t count, mir::Random& random) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const float light = std::pow(10.0f, 4.0f * random.next());
        const Vec3 at = mirtest::point_in_cube(random);
        if (i % 2 == 0) {
            scene.point_lights.push_back({"bulb", at, {light, light, light}});
            continue;
        }
        mir::SpotLight spot;
        spot.position = at;
        spot.direction = mirtest::direction(random);
        spot.intensity = {light, light, light};
        spot.cos_outer = random.next();
        spot.cos_inner = spot.cos_outer + (1.0f - spot.cos_outer) * random.next();
        scene.spot_lights.push_back(spot);
    }
}

struct Lit {
    Scene scene;
    mir::WorldGeometry geometry{scene};
    LightTable lights{scene, geometry};

    explicit Lit(Scene s) : scene(std::move(s)) {}
    [[nodiscard]] std::size_t size() const {
        return lights.lamps().triangles().size() + lights.listed().size();
    }
};

/// Lamps of all kinds that a tree may hold.
Lit mixed(std::uint32_t triangles, std::uint32_t places, std::uint64_t seed) {
    Scene scene;
    mir::Random random = mirtest::test_random(seed);
    add_triangles(scene, triangles, random);
    add_places(scene, places, random);
    return Lit(std::move(scene));
}

/// In the cube of the lamps or around it; the shading normal is not the geometric one.
LightReceiver random_receiver(mir::Random& random) {
    const Vec3 normal = mirtest::direction(random);
    const Vec3 tilted = glm::normalize(normal + 0.5f * mirtest::direction(random));
    return {(1.0f + 2.0f * random.next()) * mirtest::point_in_cube(random), tilted, normal};
}

/// Probability of each light for a receiver, by all ways down the tree.
void add_chances(const mir::LightTreeView<mir::Space::host>& tree, const mir::LightNode& node,
                 const LightReceiver& at, double chance, std::vector<double>& all) {
    if (node.is_leaf()) {
        all[node.rest()] += chance;
        return;
    }
    const auto first = static_cast<double>(tree.chance_of_first(node, at));
    if (first < 0.0) return;
    add_chances(tree, tree.nodes[node.rest()], at, chance * first, all);
    add_chances(tree, tree.nodes[node.rest() + 1], at, chance * (1.0 - first), all);
}
std::vector<double> chances(const Lit& lit, const LightReceiver& at) {
    std::vector<double> all(lit.size());
    const auto tree = lit.lights.tree().view();
    add_chances(tree, tree.nodes[0], at, 1.0, all);
    return all;
}

/// Whether a random point of a light lights a receiver, as next-event estimation says.
bool lights_up(const Lit& lit, std::uint32_t light, const LightReceiver& at, Vec2 u) {
    return lit.lights.visit(light, [&](const auto& source) {
        const mir::LightPoint p = source.sample(u, at.position);
        const Vec3 wi = glm::normalize(p.position - at.position);
        return source.share(p.normal, -wi) > 0.0f && glm::dot(wi, at.shading) > 0.0f &&
               glm::dot(wi, at.geometric) > 0.0f;
    });
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("a tree's choices have probabilities that add up to one, and it makes no others") {
    for (const std::uint32_t count : {1u, 2u, 3u, 17u, 100u}) {
        const Lit lit = mixed(count, count, count);
        mir::Random random = mirtest::test_random(200 + count);
        for (int i = 0; i < 200; ++i) {
            const LightReceiver at = random_receiver(random);
            const std::vector<double> all = chances(lit, at);
            const mir::LightPick pick =
                lit.lights.tree().view().pick(at, static_cast<double>(random.next()));
            if (!pick.is_found()) {
                CHECK(sum(all) < 1.0);
                continue;
            }
            CHECK(pick.probability == Approx(all[pick.light]).epsilon(1e-12));
            CHECK(sum(all) <= 1.0 + 1e-12);
        }
    }
}

TEST_CASE("point and spot lights join the tree when they are many") {
    const auto is_joined = [](std::uint32_t places) {
        return mixed(1, places, 3).lights.view().is_listed_in_tree;
    };
    CHECK_FALSE(is_joined(LightTable::most_summed));
    CHECK(is_joined(LightTable::most_summed + 1));
    CHECK(mixed(5, 16, 3).lights.tree().nodes().size() == 9);
    CHECK(mixed(5, 17, 3).lights.tree().nodes().size() == 43);
    CHECK(mixed(0, 3, 3).lights.tree().nodes().empty());
}

// H0: picks have the probabilities that they say. Chi-square over 94 lamps, 20 receivers of 20 000
// numbers each; family level 1 %, seed 204.
TEST_CASE("a tree picks each lamp as often as it says", "[statistical]") {
    const Lit lit = mixed(54, 40, 4);
    mir::Random random = mirtest::test_random(204);
    constexpr int receivers = 20;
    constexpr double draws = 20'000;
    const double level = mirtest::sidak(0.01, receivers);
    for (int i = 0; i < receivers; ++i) {
        const LightReceiver at = random_receiver(random);
        std::vector<double> expected = chances(lit, at);
        // Numbers that find no lamp are one more cell.
        expected.push_back(std::max(1.0 - sum(expected), 0.0));
        if (expected.back() < 1e-9) expected.back() = 0.0;
        std::vector<double> observed(expected.size());
        for (int k = 0; k < static_cast<int>(draws); ++k) {
            const auto pick = lit.lights.tree().view().pick(at, static_cast<double>(random.next()));
            ++observed[pick.is_found() ? pick.light : observed.size() - 1];
        }
        for (double& e : expected) e *= draws;
        CHECK(mirtest::chi_square(observed, expected).p_value > level);
    }
}

TEST_CASE("a lamp that lights a receiver can be picked, for a million pairs") {
    const Lit lit = mixed(120, 80, 5);
    mir::Random random = mirtest::test_random(205);
    int lit_pairs = 0;
    bool are_all_possible = true;
    for (int i = 0; i < 5000; ++i) {
        const LightReceiver at = random_receiver(random);
        const std::vector<double> all = chances(lit, at);
        for (std::uint32_t light = 0; light < lit.size(); ++light) {
            if (!lights_up(lit, light, at, random.next_2d())) continue;
            ++lit_pairs;
            are_all_possible = are_all_possible && all[light] > 0.0;
        }
    }
    CHECK(are_all_possible);
    CHECK(lit_pairs > 100'000);
}

TEST_CASE("lamps that face away or lie behind a receiver are never picked") {
    Scene scene;
    const std::uint32_t lamp = scene.add(mir::emitter("lamp", {}, {1, 1, 1}));
    using mir::builtin::quad;
    scene.place(quad("down", lamp, {-5, 1, 0}, {1, 0, 0}, {0, 0, 1}));
    scene.place(quad("up", lamp, {5, 1, 0}, {0, 0, 1}, {1, 0, 0}));
    scene.place(quad("below", lamp, {0, -9, 0}, {0, 0, 1}, {1, 0, 0}));
    const Lit lit(std::move(scene));
    const Vec3 up(0, 1, 0);
    const std::vector<double> all = chances(lit, {{0, 0, 0}, up, up});
    CHECK(all[0] > 0.0);
    CHECK(all[1] > 0.0);
    CHECK(all[0] + all[1] == sum(all));
    const std::vector<double> none = chances(lit, {{0, 3, 0}, up, up});
    CHECK(sum(none) == 0.0);
    CHECK_FALSE(lit.lights.tree().view().pick({{0, 3, 0}, up, up}, 0.5).is_found());
}

TEST_CASE("a cone around two holds the directions of both") {
    mir::Random random = mirtest::test_random(206);
    for (int i = 0; i < 2000; ++i) {
        const auto cone = [&random] {
            return mir::LightCone{mirtest::direction(random), random.next(), random.next(),
                                  random.next() < 0.3f};
        };
        const mir::LightCone a = cone();
        const mir::LightCone b = cone();
        const mir::LightCone both = a.with(b);
        CHECK(both.emission >= std::max(a.emission, b.emission));
        for (const mir::LightCone& part : {a, b})
            for (const float sign : {1.0f, part.is_double ? -1.0f : 1.0f}) {
                const mir::Frame frame = mir::Frame::around(sign * part.axis);
                const Vec2 edge(std::cos(part.spread), std::sin(part.spread));
                const float turn = 2.0f * mir::pi * random.next();
                const Vec3 w =
                    frame.to_world({edge.y * std::cos(turn), edge.y * std::sin(turn), edge.x});
                float cosine = glm::dot(w, both.axis);
                if (both.is_double) cosine = std::fabs(cosine);
                CHECK(cosine >= std::cos(both.spread) - 1e-5f);
            }
    }
}

TEST_CASE("a cone around parallel lamps stays narrow") {
    mir::Random random = mirtest::test_random(207);
    for (int i = 0; i < 500; ++i) {
        const Vec3 axis = mirtest::direction(random);
        const Vec3 next = glm::normalize(axis + 1e-6f * mirtest::direction(random));
        const mir::LightCone lamp{axis, 0.0f, 0.5f * mir::pi, i % 2 == 0};
        const mir::LightCone other{i % 4 == 0 ? -next : next, 0.0f, 0.5f * mir::pi, i % 2 == 0};
        CHECK(lamp.with(other).spread < 2e-3f);
    }
}

// 2 pi (1 - cos o) + what a cosine leaves of the ring: a plane lamp has pi, a point 4 pi.
TEST_CASE("the measure of a cone is that of the paper") {
    CHECK(mir::LightCone{{0, 0, 1}, 0.0f, 0.5f * mir::pi, false}.measure() ==
          Approx(mirtest::pi).epsilon(1e-6));
    CHECK(mir::LightCone::everywhere().measure() == Approx(4 * mirtest::pi).epsilon(1e-6));
    CHECK(mir::LightCone{{0, 0, 1}, 0.0f, 0.5f * mir::pi, true}.measure() ==
          Approx(2 * mirtest::pi).epsilon(1e-6));
}

TEST_CASE("lamps at one place, or one by one twice as far, make a tree that ends") {
    Scene scene;
    for (int i = 0; i < 300; ++i) scene.point_lights.push_back({"same", {1, 2, 3}, {1, 1, 1}});
    float far = 1e-18f;
    for (int i = 0; i < 120; ++i, far *= 2.0f)
        scene.point_lights.push_back({"far", {far, 0, 0}, {1, 1, 1}});
    const Lit lit(std::move(scene));
    CHECK(lit.lights.tree().nodes().size() == 839);
    const Vec3 up(0, 1, 0);
    CHECK(sum(chances(lit, {{0, -1, 0}, up, up})) == Approx(1.0));
}

namespace {

/// What lamp_along() promises, by asking every lamp.
std::uint32_t nearest_lamp(const Lit& lit, const LightReceiver& at, Vec3 w,
                           const std::vector<double>& chances) {
    const auto lamps = lit.lights.view().lamps;
    std::uint32_t nearest = mir::LightPick::none;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < lamps.count; ++i) {
        const std::uint32_t t = lamps.triangles[i];
        const auto corner = [&](std::uint32_t k) {
            return glm::dvec3(lit.geometry.view().corner(t, k)) - glm::dvec3(at.position);
        };
        const glm::dmat3 edges(corner(1) - corner(0), corner(2) - corner(0), -glm::dvec3(w));
        const glm::dvec3 place = glm::inverse(edges) * -corner(0);
        const bool is_met = place.x > 0.0 && place.y > 0.0 && place.x + place.y < 1.0;
        const bool is_front = glm::dot(w, lamps.lamp_triangles[i].normal) < 0.0f;
        if (is_met && place.z > 0.0 && place.z < least && chances[i] > 0.0 &&
            (is_front || lamps.lamp_triangles[i].both_sides)) {
            nearest = i;
            least = place.z;
        }
    }
    return nearest;
}

}  // namespace

TEST_CASE("a ray finds the nearest lamp that shines along it, with the probability of its choice") {
    std::size_t met = 0;
    for (const std::uint32_t count : {1u, 2u, 30u, 1000u}) {
        const Lit lit = mixed(count, 20, 400 + count);
        mir::Random random = mirtest::test_random(500 + count);
        for (int k = 0; k < 300; ++k) {
            const LightReceiver at = random_receiver(random);
            const std::vector<double> all = chances(lit, at);
            const Vec3 w = glm::normalize(mirtest::point_in_cube(random) - 0.999f * at.position);
            const auto found = mir::lamp_along(lit.lights.view(), lit.geometry.view(), at, w);
            CHECK(found.lamp == nearest_lamp(lit, at, w, all));
            if (!found.is_found()) continue;
            ++met;
            CHECK(found.probability == Approx(all[found.lamp]).epsilon(1e-5));
            const Vec3 place = lit.geometry.view().position(
                lit.lights.view().lamps.triangles[found.lamp], found.barycentrics);
            CHECK(glm::length(at.position + found.distance * w - place) < 1e-5f);
        }
    }
    CHECK(met > 30);
}
