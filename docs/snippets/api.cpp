// SPDX-License-Identifier: MIT
//
// Quoted by docs/api.md: errors and progress of a render, VPLs made by hand, an axiom checked.
#include "mir/mir.hpp"
#include "mir/render.hpp"
#include "mir/scenes.hpp"
#include "mir/validation/executor.hpp"
#include "mir/validation/visibility.hpp"
#include "support/catch.hpp"

#include <string>
#include <vector>

namespace {

// region: errors
/// What a host shows to its user; empty where all went well.
std::string draw(const mir::Scene& scene, mir::Monitor& monitor, mir::RenderResult& result) {
    try {
        result = mir::render(scene, {.image = {32, 24}, .vpls = 64}, &monitor);
    } catch (const mir::Error& e) {
        if (e.code() == mir::ErrorCode::cancelled) return "stopped";
        return e.what();  // problem, reason, remedy
    }
    return {};
}
// endregion: errors

}  // namespace

TEST_CASE("The page of names shows how errors and progress reach a host") {
    mir::Monitor monitor;
    mir::RenderResult result =
        mir::render(mir::builtin::make("sphere"), {.image = {8, 8}, .vpls = 8});
    CHECK(draw(mir::builtin::make("sphere"), monitor, result).empty());
    CHECK(result.beauty.extent() == mir::Extent{32, 24});
    CHECK_FALSE(draw(mir::Scene{}, monitor, result).empty());
    monitor.cancelled = true;
    CHECK(draw(mir::builtin::make("sphere"), monitor, result) == "stopped");
}

TEST_CASE("VPLs that the page of names makes by hand light an image") {
    const mir::Scene scene = mir::builtin::make("sphere");
    // region: vpls
    using Bsdf = mir::Lambert;
    mir::InlineExecutor executor;  // one thread; your own pool fits in as well
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<Bsdf> surfaces(scene);
    const mir::KdTreeScene tree(geometry);

    // What the camera sees, one luxel a pixel.
    const mir::CameraRays rays{scene.cameras[0], {{32, 24}}};
    mir::BlockedGBuffer<Bsdf::Params> gbuffer(rays.grid.luxels(), {32, 32});
    fill_gbuffer(gbuffer, 0, rays, tree.ray_caster(), surfaces, executor);

    // What lights it: a place, lifted off its surface; the unit normal of the side that shines;
    // W/sr.
    mir::VplList vpls;
    vpls.push_back({{0.0f, 1.5f, 0.5f}, {0.0f, -1.0f, 0.0f}, {2.0f, 2.0f, 2.0f}}, {});
    vpls.push_back({{-0.5f, 1.0f, 1.0f}, {0.0f, 0.0f, -1.0f}, {0.5f, 0.2f, 0.1f}}, {});

    // Every VPL through every luxel: radiance, W m^-2 sr^-1. The bound tames 1/d^2.
    const mir::Image<mir::Rgb> light =
        reconstruct(mir::sched::CpuBlocks{executor}, gbuffer, vpls.span(), tree.visibility(),
                    mir::VplShading<Bsdf>{.bound = 20.0f});
    // endregion: vpls
    double sum = 0.0;
    for (const mir::Rgb& c : light.pixels()) sum += static_cast<double>(luminance(c));
    CHECK(sum > 0.0);

    // region: checks
    mir::validation::Report report = mir::validation::check_executor(executor);
    // endregion: checks
    INFO(report.text());
    CHECK(report.passed());
}
