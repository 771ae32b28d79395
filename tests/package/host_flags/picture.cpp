// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include <mir/mir.hpp>
#include <mir/runtime/pass_goal.hpp>
#include <mir/scenes.hpp>

#include <bit>
#include <cstdint>
#include <span>

namespace {

using Bsdf = mir::Lambert;
using Picture = mir::Image<mir::Rgb>;

/// FNV-1a of the pixels' bits.
std::string fingerprint(const Picture& picture) {
    std::uint64_t hash = 14695981039346656037u;
    for (const mir::Rgb& p : picture.pixels())
        for (const float channel : {p.r, p.g, p.b})
            hash = (hash ^ std::bit_cast<std::uint32_t>(channel)) * 1099511628211u;
    return std::to_string(hash);
}

mir::MetropolisOptions few_chains() {
    mir::MetropolisOptions o;
    o.states = 64;
    o.chains = 8;
    o.emitter_vpls = true;
    o.bootstrap = {0.05, 2000, 20'000};
    return o;
}

}  // namespace

std::string fingerprints() {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<Bsdf> surfaces(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::KdTreeScene tree(geometry);
    const mir::ShaftScene shafts(geometry);
    mir::InlineExecutor executor;

    const mir::CameraRays rays{scene.cameras[0], mir::luxel_grid({48, 40}, 2)};
    mir::BlockedGBuffer<Bsdf::Params> luxels(rays.grid.luxels(), {32, 32});
    fill_gbuffer(luxels, 0, rays, tree.ray_caster(), surfaces, executor);
    const mir::VplShading<Bsdf> shading{.bound = 20.0f};
    const mir::PathWorld world{geometry,          lights,      surfaces, tree.ray_caster(),
                               tree.visibility(), rays.camera, 1.2f,     shading.bound};
    const mir::PlacedVpls placed = place_vpls(mir::MetropolisSampler(world, few_chains()), luxels,
                                              shafts.visibility(), shading, executor);
    const auto vpls = placed.vpls.span();
    const Picture one_by_one =
        reconstruct(mir::sched::Cpu{executor}, luxels, vpls, tree.visibility(), shading);
    const Picture in_blocks =
        reconstruct(mir::sched::CpuBlocks{executor}, luxels, vpls, shafts.visibility(), shading);
    mir::Film film(rays.grid, mir::default_filter(mir::FilterKind::lanczos), 0);
    film.add_rows(0, in_blocks);
    return fingerprint(one_by_one) + " " + fingerprint(in_blocks) + " " +
           fingerprint(film.develop());
}

namespace {

/// Whether `use` is an error of this library.
template <class Use>
bool is_refused(const Use& use) {
    try {
        use();
    } catch (const mir::Error&) {
        return true;
    }
    return false;
}

}  // namespace

std::string accepted_values() {
    // What a program computes, which no compiler knows.
    volatile float zero = 0.0f;
    const float nan = zero / zero;
    const float infinity = 1.0f / zero;
    std::string accepted;
    const auto expect = [&](const char* what, const auto& use) {
        for (const float bad : {nan, infinity})
            if (!is_refused([&] { use(bad); })) accepted += std::string(what) + "\n";
    };
    expect("position", [](float bad) {
        mir::Scene scene = mir::builtin::make("sphere");
        scene.meshes[0].positions[0].x = bad;
        const mir::WorldGeometry geometry(scene);
    });
    expect("filter", [](float bad) {
        mir::Filter filter = mir::default_filter(mir::FilterKind::box);
        filter.half_width = bad;
        const mir::Film film(mir::luxel_grid({4, 4}, 1), filter, 0);
    });
    expect("goal",
           [](float bad) { mir::PassGoal{.relative_error = static_cast<double>(bad)}.validate(); });
    expect("weights", [](float bad) {
        const std::vector<double> weights{1.0, static_cast<double>(bad)};
        static_cast<void>(mir::systematic_resampling(weights, 2, 0.5));
    });
    return accepted;
}

void fail() { throw mir::Error(mir::ErrorCode::unsupported, "thrown on purpose"); }
