// SPDX-License-Identifier: MIT
//
// Pictures of scenes with alpha masks: what is known in closed form, and the path tracer against
// VPLs by every ray engine.
#include "reference/studio.hpp"
#include "support.hpp"
#include "support/catch.hpp"
#include "support/masked_scene.hpp"

using namespace mirtest;

namespace {

constexpr std::array accelerations{mir::Acceleration::embree, mir::Acceleration::kd_tree,
                                   mir::Acceleration::bvh};

/// A white unit square under the sun, E = pi, below a checkerboard of 8 x 8 fields of the same
/// size; the camera stands between them and sees exactly the square.
mir::Scene under_checkerboard() {
    mir::Scene scene;
    const auto white = scene.add(mir::lambertian("white", {1, 1, 1}));
    scene.place(mir::builtin::quad("square", white, {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}));
    hang_curtain(scene, mir::lambertian("black", {0, 0, 0}), 8, {-0.5f, 1, -0.5f}, {1, 0, 0},
                 {0, 0, 1});
    scene.directional_lights.push_back({"sun", {0, -1, 0}, {mir::pi, mir::pi, mir::pi}});
    scene.cameras = {
        mir::Camera::look_at({0, 0.9f, 0}, {0, 0, 0}, {0, 0, -1}, 2.0f * std::atan(0.5f / 0.9f))};
    return scene;
}

/// The Cornell box with a curtain of holes under its lamp.
mir::Scene curtained_box() {
    mir::Scene scene = mir::builtin::make("cornell-box");
    hang_curtain(scene, mir::lambertian("curtain", {0.7f, 0.6f, 0.5f}), 6, {-0.7f, 1.3f, -0.6f},
                 {1.4f, 0.1f, 0.0f}, {0.0f, -0.1f, 1.2f});
    return scene;
}

}  // namespace

TEST_CASE("the sun through a checkerboard lights half of a square, field by field") {
    // Radiance 1 under holes, 0 under fields; eight pixels are a field.
    const mir::Scene scene = under_checkerboard();
    for (const mir::Acceleration acceleration : accelerations) {
        CAPTURE(static_cast<int>(acceleration));
        auto settings = small_settings(64, 4);
        settings.acceleration = acceleration;
        settings.sampler = mir::SamplerKind::instant_radiosity;
        const auto r = render(scene, settings);
        std::size_t wrong = 0;
        for (std::uint32_t y = 0; y < 64; ++y)
            for (std::uint32_t x = 0; x < 64; ++x) {
                const float wanted = (x / 8 + y / 8) % 2 == 0 ? 0.0f : 1.0f;
                wrong += std::fabs(r.direct(x, y).g - wanted) > 1e-5f ? 1 : 0;
            }
        CHECK(wrong == 0);
    }
}

TEST_CASE("VPLs bring through holes what the path tracer brings", "[statistical]") {
    // H0: equal means of the indirect light. Welch's test over 16 seeds each, 1 % over the three
    // engines; path tracer with seeds 100 to 115. A curtain without holes must be rejected.
    mir::Scene scene = curtained_box();
    const auto indirect = [&](mir::RenderSettings settings, std::uint64_t first_seed) {
        Moments m;
        for (settings.seed = first_seed; settings.seed < first_seed + 16; ++settings.seed)
            m.add(mean_luminance(render(scene, settings).indirect));
        return m;
    };
    auto settings = small_settings(32, 256);
    settings.max_bounce = 3;
    settings.sampler = mir::SamplerKind::instant_radiosity;
    auto traced = settings;
    traced.integrator = mir::Integrator::path;
    traced.path.samples = 64;
    const Moments truth = indirect(traced, 100);
    for (const mir::Acceleration acceleration : accelerations) {
        settings.acceleration = acceleration;
        const Moments vpls = indirect(settings, 0);
        CAPTURE(static_cast<int>(acceleration), vpls.mean(), truth.mean(), vpls.standard_error());
        CHECK(vpls.standard_error() < 0.02 * truth.mean());
        CHECK(welch_p_value(vpls, truth) > sidak(0.01, accelerations.size()));
    }
    scene.materials.back().alpha_cutoff = 0.0f;
    CHECK(welch_p_value(indirect(settings, 0), truth) < 1e-4);
}
