// SPDX-License-Identifier: MIT
#include "mir/runtime/vpl_frame.hpp"

#include "images/support.hpp"
#include "mir/metropolis/metropolis_options.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/shading/surface_table.hpp"
#include "support/catch.hpp"

namespace {

mir::RenderSettings light_paths() {
    mir::RenderSettings s = mirtest::small_settings(24, 32);
    s.backend = mir::BackendKind::cpu;
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.bound.kind = mir::BoundPolicy::Kind::automatic;
    s.seed = 7;
    return s;
}

}  // namespace

TEST_CASE("A frame with VPLs of the caller's is the picture by the same sampler of the renderer") {
    const mir::Scene scene = mir::builtin::make("sphere");
    const mir::RenderSettings s = light_paths();
    mir::VplFrame frame(scene, s);
    const mir::SurfaceTable<mir::Lambert> surfaces(scene);
    mir::InstantRadiosityOptions options;
    options.vpls = s.vpls;
    options.seed = s.seed;
    options.max_bounce = s.bounce_limit();
    const mir::InstantRadiositySampler<mir::Lambert, mir::AnyRayCaster> sampler(
        {frame.geometry(), frame.lights(), surfaces, frame.ray_caster()}, options);
    const mir::RenderResult found =
        render_vpls(frame, {sampler.sample(frame.executor()), mir::Normalisation::none});
    const mir::RenderResult wanted = mirtest::render(scene, s);
    CHECK(found.vpls.size() == wanted.vpls.size());
    CHECK(mirtest::same_bits(found.beauty, wanted.beauty));
    CHECK(found.statistics.bound == wanted.statistics.bound);
    CHECK(frame.bound() == wanted.statistics.bound);
    CHECK(found.statistics.scheduler == "cpu-blocks");
    CHECK(found.statistics.acceleration == wanted.statistics.acceleration);
    CHECK(found.statistics.scene_hash == wanted.statistics.scene_hash);
    CHECK(found.warnings == wanted.warnings);
}

TEST_CASE("The VPLs that a frame places are those of the picture by its settings") {
    const mir::Scene scene = mir::builtin::make("sphere");
    mir::RenderSettings s = light_paths();
    for (const auto sampler : {mir::SamplerKind::instant_radiosity, mir::SamplerKind::metropolis}) {
        s.sampler = sampler;
        const mir::VplList placed = mir::VplFrame(scene, s).place_vpls();
        const mir::VplList wanted = mirtest::render(scene, s).vpls;
        REQUIRE(placed.size() == wanted.size());
        bool same = true;
        for (std::uint32_t i = 0; i < placed.size(); ++i)
            same = same && placed.vpls()[i].position == wanted.vpls()[i].position &&
                   placed.vpls()[i].intensity == wanted.vpls()[i].intensity;
        CHECK(same);
    }
}

TEST_CASE("A frame refuses settings that no renderer takes, and schedulers that are not there") {
    const mir::Scene scene = mir::builtin::make("sphere");
    mir::RenderSettings s = light_paths();
    s.vpls = 0;
    CHECK_THROWS_AS(mir::VplFrame(scene, s), mir::Error);
    s = light_paths();
    s.scheduler = "warp";
    CHECK_THROWS_AS(mir::VplFrame(scene, s), mir::Error);
}
