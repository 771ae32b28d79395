// SPDX-License-Identifier: MIT
//
// A scene below a node that scales or turns it, by way of a file: its picture stays. Radiance of
// lamps does not depend on the size of a scene, intensity of lights without extent grows with its
// square. docs/validation.md, "Invariances".
#include "images/support.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/io/gltf_writer.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"
#include "support/temporary_folder.hpp"
#include "support/wrapped_glb.hpp"

#include <string>
#include <vector>

namespace {

using mir::Vec3;

/// A box with lamps of every kind, seen so that no edge lies in the middle of a pixel.
mir::Scene lit_box() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    scene.cameras[0].position += Vec3(0.031f, 0.053f, 0.0f);
    const Vec3 eye = scene.cameras[0].position;
    scene.point_lights.push_back({"bulb", {0.25f, 1.5f, 0.5f}, {1, 2, 3}});
    mir::SpotLight spot;
    spot.name = "spot";
    spot.position = eye + Vec3(0.2f, 0.3f, 0.0f);
    spot.direction = glm::normalize(Vec3(-0.1f, -0.2f, -1.0f));
    spot.intensity = {9, 6, 6};
    scene.spot_lights.push_back(spot);
    scene.directional_lights.push_back(
        {"sun", glm::normalize(Vec3(0.2f, -0.5f, -1.0f)), {1.0f, 1.0f, 0.5f}});
    return scene;
}

/// The box as read from a file in which `root`, a node of that scale, holds everything. Of its lamp
/// so many triangles.
mir::Scene below(nlohmann::json root, double scale, std::size_t lamp_triangles = 2) {
    const mirtest::TemporaryFolder folder("scaled_nodes");
    const auto file = folder / "box.glb";
    mir::Scene scene = lit_box();
    scene.meshes.back().triangles.resize(lamp_triangles);
    const auto square = static_cast<float>(scale * scale);
    for (mir::PointLight& light : scene.point_lights) light.intensity = light.intensity * square;
    for (mir::SpotLight& light : scene.spot_lights) light.intensity = light.intensity * square;
    mir::write_glb(scene, file);
    root["scale"] = {scale, scale, scale};
    mirtest::wrap_glb(file, std::move(root));
    return mir::read_gltf(file).scene;
}

struct Way {
    std::string name;
    mir::RenderSettings settings;
    double rounding = 0.0;  ///< what may become of the mean of indirect light where digits change
};

/// Every integrator, VPLs by every structure and two samplers.
std::vector<Way> ways() {
    mir::RenderSettings s = mirtest::small_settings(40, 64);
    s.bound.kind = mir::BoundPolicy::Kind::automatic;
    s.backend = mir::BackendKind::cpu;
    s.metropolis.chains = 32;  // fewer than VPLs, or nothing would mutate
    s.metropolis.bootstrap = {1.0, 1u << 12, 1u << 12};
    s.direct_samples = 4;
    s.path.samples = 4;
    s.micro.surfels = 2000;
    std::vector<Way> all;
    for (const auto sampler : {mir::SamplerKind::instant_radiosity, mir::SamplerKind::metropolis}) {
        s.sampler = sampler;
        s.acceleration = mir::Acceleration::kd_tree;
        all.push_back({"kdtree", s, 1e-5});
        s.acceleration = mir::Acceleration::bvh;
        all.push_back({"bvh", s, 1e-5});
        s.acceleration = mir::Acceleration::embree;
        all.push_back({"embree", s, 1e-5});
    }
    // Here and there a path turns elsewhere.
    s.integrator = mir::Integrator::path;
    all.push_back({"path", s, 1e-3});
    // Triangles as large as others are cut first or last.
    s.integrator = mir::Integrator::micro;
    all.push_back({"micro", s, 1e-2});
    return all;
}

mir::RenderResult picture(const mir::Scene& scene, const mir::RenderSettings& settings) {
    mir::Registry registry;
    mir::add_all_to(registry);
    return registry.make(settings.backend, settings.scheduler)->render(scene, settings, nullptr);
}

/// Ratio of two pictures' mean luminances less 1.
double excess(const mir::Image<mir::Rgb>& picture, const mir::Image<mir::Rgb>& reference) {
    return mirtest::mean_luminance(picture) / mirtest::mean_luminance(reference) - 1.0;
}

/// Members of a node that turns by 84 degrees about an oblique axis, and moves.
nlohmann::json turn() {
    return {{"rotation", {0.18, -0.36, 0.54, 0.74}}, {"translation", {3.7, -1.1, 0.4}}};
}

}  // namespace

TEST_CASE("a scene below a node that scales it by a power of two gives the same bits") {
    const mir::Scene home = below({}, 1.0);
    for (const Way& way : ways()) {
        const mir::RenderResult reference = picture(home, way.settings);
        REQUIRE(mirtest::mean_luminance(reference.indirect) > 0.0);
        for (const double scale : {0x1p-20, 0x1p-7, 0x1p20}) {
            const mir::RenderResult scaled = picture(below({}, scale), way.settings);
            CAPTURE(way.name, int(way.settings.sampler), scale);
            CHECK(mirtest::same_bits(scaled.direct, reference.direct));
            CHECK(mirtest::same_bits(scaled.indirect, reference.indirect));
            CHECK(mirtest::same_bits(scaled.beauty, reference.beauty));
        }
    }
}

TEST_CASE("a scene below a node that scales it by a power of ten looks the same up to rounding") {
    const mir::Scene home = below({}, 1.0);
    for (const Way& way : ways()) {
        const mir::RenderResult reference = picture(home, way.settings);
        for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
            const mir::RenderResult scaled = picture(below({}, scale), way.settings);
            CAPTURE(way.name, int(way.settings.sampler), scale);
            CHECK(mirtest::share_of_changed_pixels(scaled.direct, reference.direct, 1e-3f) < 0.005);
            CHECK(std::fabs(excess(scaled.direct, reference.direct)) < 1e-4);
            CHECK(std::fabs(excess(scaled.indirect, reference.indirect)) < way.rounding);
        }
    }
}

TEST_CASE("a scene below a node that turns it shows the same emission and direct light") {
    // How a tree divides several lamps follows the axes, and so do the lamps that it picks.
    const mir::Scene home = below({}, 1.0, 1);
    for (const Way& way : ways()) {
        const mir::RenderResult reference = picture(home, way.settings);
        const mir::RenderResult turned = picture(below(turn(), 1.0, 1), way.settings);
        CAPTURE(way.name, int(way.settings.sampler));
        CHECK(mirtest::share_of_changed_pixels(turned.emission, reference.emission, 1e-3f) < 0.005);
        CHECK(std::fabs(excess(turned.direct, reference.direct)) < 5e-3);
        // Paths also find lamps by directions, which turned frames lead elsewhere.
        if (way.settings.integrator != mir::Integrator::path)
            CHECK(mirtest::share_of_changed_pixels(turned.direct, reference.direct, 1e-3f) < 0.005);
    }
}

// H0: both scenes have the same mean indirect light. Welch's test over 16 seeds each, 1 % over VPLs
// and paths; a tenth more light must be seen.
TEST_CASE("a scene below a node that turns it has the same mean indirect light", "[statistical]") {
    const mir::Scene home = below({}, 1.0);
    const mir::Scene other = below(turn(), 1e-6);
    for (Way& way : ways()) {
        const bool paths = way.settings.integrator == mir::Integrator::path;
        const bool chains =
            way.name == "bvh" && way.settings.sampler == mir::SamplerKind::metropolis;
        if (!paths && !chains) continue;
        mirtest::Moments reference;
        mirtest::Moments turned;
        mirtest::Moments brighter;
        for (std::uint64_t seed = 0; seed < 16; ++seed) {
            way.settings.seed = seed;
            reference.add(mirtest::mean_luminance(picture(home, way.settings).indirect));
            way.settings.seed = seed + 1000;
            const double mean = mirtest::mean_luminance(picture(other, way.settings).indirect);
            turned.add(mean);
            brighter.add(1.1 * mean);
        }
        CAPTURE(way.name, reference.mean(), turned.mean());
        CHECK(mirtest::welch_p_value(reference, turned) > mirtest::sidak(0.01, 2));
        CHECK(mirtest::welch_p_value(reference, brighter) < mirtest::sidak(0.01, 2));
    }
}
