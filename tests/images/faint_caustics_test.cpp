// SPDX-License-Identifier: MIT
// When caustics are left out, and that renders say so.
#include "mir/runtime/light_budget.hpp"
#include "support.hpp"
#include "support/catch.hpp"
#include "support/same_images.hpp"

using namespace mirtest;
using mir::RenderResult;
using mir::RenderSettings;

namespace {

/// As many light paths as make it worth its while to try some first.
RenderSettings usual() {
    RenderSettings s = small_settings(64, 256);
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.luxels_per_pixel = 1;
    s.caustics = 128;
    s.measure_missing = true;
    s.skip_faint_caustics = true;
    return s;
}

/// A room with a mirror of a square centimetre in its darkest corner.
mir::Scene room_with_a_glint() {
    mir::Scene scene = mir::builtin::make("cornell-box");
    mir::Material mirror = mir::lambertian("mirror", {0.9f, 0.9f, 0.9f});
    mirror.metallic = 1.0f;
    mirror.roughness = 0.0f;
    scene.place(mir::builtin::quad("glint", scene.add(mirror), {-0.99f, -0.995f, -0.99f},
                                   {0.0f, 0.0f, 0.01f}, {0.01f, 0.0f, 0.0f}));
    return scene;
}

const mir::LightClass* caustics_of(const std::vector<mir::LightClass>& classes) {
    for (const mir::LightClass& c : classes)
        if (c.light.find("caustics") != std::string::npos) return &c;
    return nullptr;
}

}  // namespace

TEST_CASE("caustics that bring much light are traced, whether some are tried first or not") {
    const mir::Scene scene = mir::builtin::make("caustics");
    RenderSettings s = usual();
    const RenderResult tried = render(scene, s);
    CHECK_FALSE(tried.statistics.faint_caustics);
    s.skip_faint_caustics = false;
    const RenderResult all = render(scene, s);
    CHECK(same_bits(tried.beauty, all.beauty));
    CHECK(tried.statistics.caustic_paths == all.statistics.caustic_paths);
}

TEST_CASE("caustics that bring next to nothing are left out, and the light budget says so") {
    const mir::Scene scene = room_with_a_glint();
    RenderSettings s = usual();
    const RenderResult r = render(scene, s);
    REQUIRE(r.statistics.faint_caustics);
    CHECK(*r.statistics.faint_caustics < 1e-3);
    CHECK(*r.statistics.faint_caustics > 0.0);
    CHECK(r.statistics.caustic_paths < 64 * 64 * 128);
    const auto classes = light_budget(r, s);
    const mir::LightClass* const caustics = caustics_of(classes);
    REQUIRE(caustics != nullptr);
    CHECK(caustics->brought_by.find("left out") != std::string::npos);

    // Half a picture knows the same of all of it.
    s.rows = {20, 9};
    CHECK(render(scene, s).statistics.faint_caustics == r.statistics.faint_caustics);
    s.rows = {};
    s.skip_faint_caustics = false;
    const RenderResult all = render(scene, s);
    CHECK_FALSE(all.statistics.faint_caustics);
    CHECK(all.statistics.caustic_paths == 64 * 64 * 128);
    const double share = mean_luminance(all.beauty) / mean_luminance(r.beauty) - 1.0;
    CHECK(std::abs(share) < 1e-3);
}

TEST_CASE(
    "caustics stay where it would cost as much to try them, or nothing is known of the light") {
    const mir::Scene scene = room_with_a_glint();
    RenderSettings s = usual();
    SECTION("few paths") { s.caustics = 1; }
    SECTION("no estimate") { s.measure_missing = false; }
    CHECK_FALSE(render(scene, s).statistics.faint_caustics);
}
