// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"
#include "support/wedge.hpp"

#include <array>
#include <cmath>

// A path of k edges can be built with 0 to k - 1 vertices from the light. Each way by itself, all
// ways with the mixture density, and the two generators must estimate the same mean luminance.

namespace {

using mir::CookTorrance;
using mir::Lambert;
using mir::Path;
using mir::PathMeasure;
using mir::PathTechniques;
using mir::Technique;
using mir::TechniqueTable;
using mirtest::generator_weights;
using mirtest::Moments;
using mirtest::PathLab;
using mirtest::technique_weights;
using mirtest::Wedge;
using mirtest::WedgeLights;
using mirtest::welch_p_value;

constexpr std::uint64_t paths = 60'000;
constexpr std::uint32_t longest = 5;

/// Density of a path under one technique; tests of the tests hand in wrong ones.
struct RightDensity {
    double operator()(Technique t, const Path&, const PathMeasure& m) const {
        return technique_density(m, t.edges, t.from_light);
    }
};

/// p-value, after Sidak, of "techniques and generators agree at every length".
template <class World, class Density = RightDensity>
double agreement(const World& world, std::uint32_t shortest, std::uint64_t seed,
                 const Density& density = {}) {
    std::vector<double> p;
    const bool delta_lights = world.lights.lamps.count == 0;
    for (std::uint32_t k = shortest; k <= longest; ++k) {
        const TechniqueTable all(k, k, PathTechniques::bidirectional);
        const TechniqueTable camera(k, k, PathTechniques::camera);
        const Moments wanted = generator_weights(world, all, seed++, 4 * paths);
        REQUIRE(wanted.mean() > 0.0);
        p.push_back(welch_p_value(generator_weights(world, camera, seed++, paths), wanted));
        for (std::uint32_t s = delta_lights ? 1 : 0; s < k; ++s) {
            const Technique t{k, s};
            const Moments alone = technique_weights(
                world, t, seed++, paths,
                [&](const Path& path, const PathMeasure& m) { return density(t, path, m); });
            CAPTURE(k, s, alone.mean(), wanted.mean(), alone.standard_error());
            p.push_back(welch_p_value(alone, wanted));
            UNSCOPED_INFO("k " << k << " s " << s << " alone " << alone.mean() << " +- "
                               << alone.standard_error() << ", all " << wanted.mean() << " +- "
                               << wanted.standard_error() << ", p " << p.back());
        }
    }
    const double smallest = *std::min_element(p.begin(), p.end());
    return -std::expm1(static_cast<double>(p.size()) * std::log1p(-smallest));
}

}  // namespace

// H0 of each case: all ways to build paths of 2 (or 3) to 5 edges have the same mean weight.
// Welch's test against the bidirectional generator, 1 % per case after Sidak; seeds in the cases.

TEST_CASE("all techniques agree under a glowing ceiling", "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    CHECK(agreement(lab.world(), 2, 1000) > 0.01);
}

TEST_CASE("all techniques agree around a lamp that shines from both sides", "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::two_sided).scene());
    CHECK(agreement(lab.world(), 2, 1100) > 0.01);
}

TEST_CASE("all techniques agree around a lamp with holes and a picture on it", "[statistical]") {
    mir::Scene scene = Wedge(WedgeLights::ceiling).scene();
    for (mir::Mesh& m : scene.meshes)
        if (scene.materials[m.material].emits())
            for (mir::Vec3 p : m.positions)
                m.texture_coordinates.emplace_back(p.x + 0.3f * p.y, p.z - 0.4f * p.y);
    scene.images = {{"lamp", 2, 2, {0xFFFFFFFFu, 0xFF404040u, 0x00FFFFFFu, 0xFF808080u}}};
    for (mir::Material& m : scene.materials) {
        if (!m.emits()) continue;
        m.textures.base_color.image = m.textures.emission.image = 0;
        m.textures.base_color.nearest = m.textures.emission.nearest = true;
        m.alpha_cutoff = 0.5f;
    }
    const PathLab<Lambert> lab(scene);
    CHECK(agreement(lab.world(), 2, 2900) > 0.01);
}

TEST_CASE("all techniques agree under lights without extent", "[statistical]") {
    const auto lights = GENERATE(WedgeLights::point, WedgeLights::spot, WedgeLights::directional);
    CAPTURE(static_cast<int>(lights));
    const PathLab<Lambert> lab(Wedge(lights).scene());
    CHECK(agreement(lab.world(), 3, 1200 + 100 * static_cast<std::uint64_t>(lights)) > 0.01);
}

TEST_CASE("all techniques agree between glossy surfaces", "[statistical]") {
    const auto lights = GENERATE(WedgeLights::two_sided, WedgeLights::spot);
    CAPTURE(static_cast<int>(lights));
    const PathLab<CookTorrance> lab(Wedge(lights, 1.0f).scene());
    const std::uint32_t shortest = lights == WedgeLights::spot ? 3 : 2;
    CHECK(agreement(lab.world(), shortest, 1700 + 100 * static_cast<std::uint64_t>(lights)) > 0.01);
}

// What leaves x2 from the camera's side is drawn by its cosine, whatever the lobe there is.
TEST_CASE("all techniques agree between metals", "[statistical]") {
    mir::Scene scene = Wedge(WedgeLights::two_sided).scene();
    for (mir::Material& m : scene.materials) {
        if (m.emits()) continue;
        m.metallic = 1.0f;
        m.roughness = 0.6f;
    }
    const PathLab<CookTorrance> lab(scene);
    CHECK(agreement(lab.world(), 2, 3000) > 0.01);
}

TEST_CASE("all techniques agree through a thin lens and with a bounded kernel", "[statistical]") {
    mir::Scene scene = Wedge(WedgeLights::two_sided).scene();
    scene.cameras[0].lens_radius = 0.1f;
    scene.cameras[0].focus_distance = 2.0f;
    const PathLab<Lambert> lab(scene);
    CHECK(agreement(lab.world(0.5f), 2, 2200) > 0.01);
}

// Environments have no surface, so no path runs into them, as into lights without extent.
TEST_CASE("all techniques agree under a sky, with more lights and gloss below it",
          "[statistical]") {
    const PathLab<Lambert> alone(Wedge(WedgeLights::environment).scene());
    CHECK(agreement(alone.world(), 3, 2600) > 0.01);
    mir::Scene scene = Wedge(WedgeLights::environment, 1.0f).scene();
    scene.point_lights = Wedge(WedgeLights::point).scene().point_lights;
    scene.directional_lights = Wedge(WedgeLights::directional).scene().directional_lights;
    const PathLab<CookTorrance> mixed(scene);
    CHECK(agreement(mixed.world(), 3, 2700) > 0.01);
}

namespace {

/// A wedge whose floor and ceiling let light through, above a cellar that sends it back.
mir::Scene leafy(WedgeLights lights, float specular) {
    mir::Scene scene = Wedge(lights, specular).scene();
    for (std::size_t i = 0; i < 2; ++i) {
        scene.materials[i].diffuse_transmission = 0.6f;
        scene.materials[i].diffuse_transmission_color = {0.5f, 0.9f, 0.4f};
    }
    const std::uint32_t wall = scene.add(mir::lambertian("cellar", {0.8f, 0.8f, 0.8f}));
    scene.place(mir::builtin::quad("cellar", wall, {-1, -0.4f, 1}, {2, 0.1f, 0}, {0, 0.05f, -2}));
    return scene;
}

}  // namespace

TEST_CASE("all techniques agree where light goes through floor and ceiling", "[statistical]") {
    const PathLab<Lambert> matte(leafy(WedgeLights::two_sided, 0.0f));
    CHECK(agreement(matte.world(), 2, 3100) > 0.01);
    const PathLab<CookTorrance> waxed(leafy(WedgeLights::environment, 1.0f));
    CHECK(agreement(waxed.world(), 3, 3200) > 0.01);
}

// H0: light goes through as often as the chance of the material says. Student's t, 1 %.
TEST_CASE("what is drawn at a vertex has the weight of its chance", "[statistical]") {
    const PathLab<Lambert> lab(leafy(WedgeLights::two_sided, 0.0f));
    const auto view = lab.surfaces.view();
    const double chance = view.through_chance(0, {});
    CHECK(chance > 0.3);
    CHECK(chance < 0.7);
    mirtest::Moments through;
    mir::Random random(3300, mir::Stream::test, 0);
    for (int i = 0; i < 4000; ++i) {
        const mir::Ray down{{random.next() - 0.5f, 0.2f, random.next() - 0.5f}, {0, -1, 0}};
        mir::PathVertex v;
        if (!lab.world().hit(down, v) || v.material != 0) continue;
        through.add(v.is_through ? 1.0 : 0.0);
        const double weight = lab.world().event_weight(v);
        REQUIRE(weight == mirtest::Approx(1.0 / (v.is_through ? chance : 1.0 - chance)));
        mir::PathVertex lit;
        REQUIRE(lab.world().hit_from_light(down, lit));
        // The camera's side of what light goes through from above lies below.
        REQUIRE(lit.is_through == v.is_through);
        REQUIRE((lit.normal.y < 0.0f) == v.is_through);
        REQUIRE((lit.position.y < 0.0f) == v.is_through);
    }
    CHECK(mirtest::mean_p_value(through, chance) > 0.01);
}

TEST_CASE("light goes through a waxed leaf at every vertex of a path", "[statistical]") {
    const PathLab<CookTorrance> lab(leafy(WedgeLights::environment, 1.0f));
    const mir::PathGenerator generator(lab.world(),
                                       TechniqueTable(5, 5, PathTechniques::bidirectional));
    mir::WeightedPath p;
    std::array<std::uint32_t, 4> lit{};
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        generator.generate(mir::Random(3400, mir::Stream::test, i), p);
        for (std::uint32_t k = 1; p.weight > 0.0 && k <= lit.size(); ++k)
            lit[k - 1] += p.path.x(k).is_through;
    }
    for (const std::uint32_t paths_through : lit) CHECK(paths_through > 20);
}

// H0: P_c of k edges is L_e rho^(k - 1). Student's t, 1 % over 5 lengths, seeds 3502 to 3506.
TEST_CASE("a leaf in the furnace sends out rho of the light of either side", "[statistical]") {
    mir::Scene scene = mir::builtin::make("furnace");
    mir::Material leaf = scene.materials.at(0);
    leaf.base_color = {0.8f, 0.8f, 0.8f};
    leaf.diffuse_transmission = 0.75f;
    leaf.diffuse_transmission_color = {0.4f, 0.4f, 0.4f};
    leaf.emits_from_both_sides = true;
    const mir::Camera& eye = scene.cameras.at(0);
    const mir::Vec3 corner = eye.position - 0.4f * eye.back - 0.3f * eye.right - 0.3f * eye.up;
    scene.place(mir::builtin::quad("leaf", scene.add(leaf), corner, 0.5f * eye.right,
                                   0.5f * eye.up - 0.1f * eye.back));
    const PathLab<Lambert> lab(scene);
    for (std::uint32_t k = 2; k <= 6; ++k) {
        const TechniqueTable table(k, k, PathTechniques::bidirectional);
        const Moments m = generator_weights(lab.world(), table, 3500 + k, 60'000);
        CAPTURE(k, m.mean(), m.standard_error());
        CHECK(mirtest::mean_p_value(m, 0.5 * std::pow(0.5, k - 1)) > mirtest::sidak(0.01, 5));
        CHECK(m.standard_error() < 0.05 * m.mean());
    }
}

// H0: P_c of k edges is L_e rho^(k - 1). Student's t, 1 % over 7 lengths, seeds 2300 to 2306.
TEST_CASE("in the furnace every bounce is rho times the one before", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    for (std::uint32_t k = 2; k <= 8; ++k) {
        const TechniqueTable table(k, k, PathTechniques::bidirectional);
        const Moments m = generator_weights(lab.world(), table, 2298 + k, 60'000);
        CAPTURE(k, m.mean(), m.standard_error());
        CHECK(mirtest::mean_p_value(m, 0.5 * std::pow(0.5, k - 1)) > mirtest::sidak(0.01, 7));
        CHECK(m.standard_error() < 0.01 * m.mean());
    }
}

// H0: camera and bidirectional paths bring the same light. Welch, 1 % over 4 lengths and 2 scenes.
TEST_CASE("camera and bidirectional paths agree in the Cornell box", "[statistical]") {
    const auto* name = GENERATE("cornell-box", "cornell-inverted");
    const PathLab<Lambert> lab(mir::builtin::make(name));
    for (std::uint32_t k = 2; k <= 5; ++k) {
        const auto camera = generator_weights(
            lab.world(), TechniqueTable(k, k, PathTechniques::camera), 2400 + k, 200'000);
        const auto both = generator_weights(
            lab.world(), TechniqueTable(k, k, PathTechniques::bidirectional), 2410 + k, 200'000);
        CAPTURE(name, k, camera.mean(), both.mean());
        CHECK(welch_p_value(camera, both) > mirtest::sidak(0.01, 8));
    }
}

TEST_CASE("a two-sided lamp whose sides are each started with full density is rejected",
          "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::two_sided).scene());
    const auto wrong = [](Technique t, const Path&, PathMeasure m) {
        m.emission = m.next_event;
        return technique_density(m, t.edges, t.from_light);
    };
    CHECK(agreement(lab.world(), 2, 1100, wrong) < 0.001);
}

TEST_CASE("light paths from a sky whose disc is forgotten are rejected", "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::environment).scene());
    const double disc = mir::pi * lab.lights.sphere().radius * lab.lights.sphere().radius;
    const auto wrong = [&](Technique t, const Path&, PathMeasure m) {
        m.from_light[t.edges - 1] *= disc;
        return technique_density(m, t.edges, t.from_light);
    };
    CHECK(agreement(lab.world(), 3, 2600, wrong) < 0.001);
}

TEST_CASE("light samples weighed like starts of light paths are rejected", "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::two_sided).scene());
    const auto wrong = [](Technique t, const Path&, PathMeasure m) {
        m.next_event = m.emission;
        return technique_density(m, t.edges, t.from_light);
    };
    CHECK(agreement(lab.world(), 2, 1100, wrong) < 0.001);
}

TEST_CASE("densities with the cosine of the wrong end are rejected", "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    const bool from_eye = GENERATE(true, false);
    const auto wrong = [&](Technique t, const Path& path, PathMeasure m) {
        for (std::uint32_t i = 2; i < t.edges; ++i) {
            const std::uint32_t other = from_eye ? i - 1 : i + 1;
            const mir::Vec3 w = glm::normalize(path.position(other) - path.position(i));
            const double ratio = std::fabs(static_cast<double>(glm::dot(w, path.x(other).normal) /
                                                               glm::dot(w, path.x(i).normal)));
            (from_eye ? m.from_eye : m.from_light)[i] *= ratio;
        }
        return technique_density(m, t.edges, t.from_light);
    };
    CHECK(agreement(lab.world(), 2, 1000, wrong) < 0.001);
}

// All techniques of one length, each weighed by the mixture; `without` is left out of it.
TEST_CASE("a mixture that forgets one of its techniques is rejected", "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    constexpr std::uint32_t k = 4;
    const TechniqueTable table(k, k, PathTechniques::bidirectional);
    const Moments wanted = generator_weights(lab.world(), table, 2500, paths);
    const std::uint32_t without = GENERATE(0u, 1u, 2u, 3u, 99u);
    const auto mixture = [&](const Path&, const PathMeasure& m) {
        double density = 0.0;
        for (std::uint32_t s = 0; s < k; ++s)
            if (s != without) density += technique_density(m, k, s) / k;
        return density;
    };
    double mean = 0.0;
    double variance = 0.0;
    for (std::uint32_t s = 0; s < k; ++s) {
        const Moments m = technique_weights(lab.world(), {k, s}, 2501 + s, paths, mixture);
        mean += m.mean() / k;
        variance += m.standard_error() * m.standard_error() / (k * k);
    }
    const double z =
        (mean - wanted.mean()) / std::hypot(std::sqrt(variance), wanted.standard_error());
    CAPTURE(without, mean, wanted.mean());
    if (without < k)
        CHECK(std::fabs(z) > 5.0);
    else
        CHECK(std::fabs(z) < 2.576);
}
