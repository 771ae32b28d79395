// SPDX-License-Identifier: MIT
//
// The path tracer against estimators that share nothing with it but the conventions: next-event
// direct light of luxels, and the VPLs of instant radiosity, bounce by bounce.
#include "mir/direct_light.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/scenes.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "studio.hpp"
#include "support/catch.hpp"
#include "wrong_models.hpp"

using namespace mirtest;
using mir::Lambert;
using mir::Rgb;
using mir::builtin::Lamp;

namespace {

constexpr std::uint32_t side = 64;  // luxels
constexpr std::uint32_t tile = 16;
constexpr std::uint32_t tiles = (side / tile) * (side / tile);
constexpr std::uint32_t runs = 16;
constexpr std::uint8_t last = 5;  // bounces 2 to 5 are compared
constexpr std::uint64_t seed = 511;

/// The same luxels for every estimator.
class Luxels {
 public:
    explicit Luxels(const Studio<Lambert>& studio)
        : studio_(studio), rays_(studio.rays(side, seed)), gbuffer_({side, side}, {side, side}) {
        mir::fill_gbuffer<Lambert>(gbuffer_, 0, rays_, studio.engine.ray_caster(), studio.surfaces,
                                   executor_);
    }

    /// Direct light of `runs` seeds.
    TileMeans direct() {
        TileMeans means(tile);
        for (std::uint64_t r = 0; r < runs; ++r)
            means.add(mir::direct_light<Lambert>(gbuffer_, studio_.lights,
                                                 studio_.engine.visibility(),
                                                 {0, rays_.grid, seed + r}, 8, executor_));
        return means;
    }

    /// Light of the VPLs of bounces 2 to `last`, of `runs` seeds.
    template <mir::Shading F = mir::VplShading<Lambert>>
    std::vector<TileMeans> indirect(std::uint32_t vpls, const F& shading = {}) {
        std::vector<TileMeans> means(last + 1, TileMeans(tile));
        using Sampler = mir::InstantRadiositySampler<Lambert, mir::cpu::EmbreeRayCaster>;
        mir::InstantRadiosityOptions options;
        options.vpls = vpls;
        options.max_bounce = last;
        for (options.seed = seed; options.seed < seed + runs; ++options.seed) {
            const Sampler sampler(
                {studio_.geometry, studio_.lights, studio_.surfaces, studio_.engine.ray_caster()},
                options);
            const mir::VplRecords records = sampler.sample(executor_);
            for (std::uint8_t b = 2; b <= last; ++b) means[b].add(light_of(records, b, shading));
        }
        return means;
    }

 private:
    template <mir::Shading F>
    mir::Image<Rgb> light_of(const mir::VplRecords& records, std::uint8_t bounce,
                             const F& shading) {
        std::vector<mir::Vpl> vpls;
        for (const mir::VplRecord& r : records.records)
            if (r.bounce == bounce) vpls.push_back(r.vpl);
        const mir::VplSpan<mir::Space::host> span{vpls.data(),
                                                  static_cast<std::uint32_t>(vpls.size())};
        return mir::reconstruct(mir::sched::CpuBlocks{executor_}, gbuffer_, span,
                                studio_.engine.visibility(), shading);
    }

    const Studio<Lambert>& studio_;
    mir::CameraRays rays_;
    mir::BlockedGBuffer<Lambert::Params> gbuffer_;
    mir::TbbExecutor executor_;
};

template <class Rules = mir::BalanceRules>
std::vector<mir::ReferenceImage> traced(const Studio<Lambert>& studio, std::uint8_t max_bounce,
                                        float bound = std::numeric_limits<float>::max()) {
    mir::ReferenceOptions options;
    options.samples = 16;
    return replicates(studio.tracer<Rules>({.max_bounce = max_bounce, .bound = bound}),
                      studio.rays(side, seed), options, runs);
}

/// Smallest p-value over tiles and bounces.
double smallest_p_of(const std::vector<mir::ReferenceImage>& images,
                     const std::vector<TileMeans>& vpls) {
    double p = 1.0;
    for (std::uint8_t b = 2; b <= last; ++b)
        p = std::min(p, smallest_p(tiles_of(images, b, tile), vpls[b]));
    return p;
}

}  // namespace

// H0: equal means of every tile. Welch's test over 16 replicates each, seed 511, level 1 % over
// two scenes of 16 tiles.
TEST_CASE("D_1 is the direct light of the sphere scenes", "[statistical]") {
    const double level = sidak(0.01, 2 * tiles);
    for (Lamp lamp : {Lamp::down, Lamp::up}) {
        const Studio<Lambert> studio(mir::builtin::sphere_room(lamp));
        const TileMeans direct = Luxels(studio).direct();
        CAPTURE(int(lamp));
        CHECK(smallest_p(tiles_of(traced(studio, 1), 1, tile), direct) > level);
        CHECK(smallest_p(tiles_of(traced<NoEmitterCosine>(studio, 1), 1, tile), direct) < level);
        CHECK(smallest_p(tiles_of(traced<DoubleCounting>(studio, 1), 1, tile), direct) < level);
    }
}

// H0: equal means of every tile and bounce. Welch's test over 16 replicates each, seed 511, level
// 1 % over two scenes, four bounces and 16 tiles.
TEST_CASE("D_2 to D_5 are the light of VPLs of that bounce", "[statistical][extended]") {
    const double level = sidak(0.01, 2 * (last - 1) * tiles);
    for (Lamp lamp : {Lamp::down, Lamp::up}) {
        const Studio<Lambert> studio(mir::builtin::cornell_box(lamp));
        const std::vector<TileMeans> vpls = Luxels(studio).indirect(1024);
        CAPTURE(int(lamp));
        CHECK(smallest_p_of(traced(studio, last), vpls) > level);
        CHECK(smallest_p_of(traced<DoubleCounting>(studio, last), vpls) < level);
        CHECK(smallest_p_of(traced<NoEmitterCosine>(studio, last), vpls) < level);
        CHECK(smallest_p_of(traced<NoCompensation>(studio, last), vpls) < level);
    }
}

// H0 and test as above, one scene, both under a bound that removes a good share of the light.
TEST_CASE("D_2 to D_5 under a bound are the light of VPLs under that bound", "[statistical]") {
    const double level = sidak(0.01, (last - 1) * tiles);
    const Studio<Lambert> studio(mir::builtin::cornell_box(Lamp::down));
    constexpr float bound = 1.0f;
    const auto bounded = traced(studio, last, bound);
    const auto vpls = Luxels(studio).indirect(1024, mir::VplShading<Lambert>{bound});
    CHECK(smallest_p_of(bounded, vpls) > level);
    CHECK(smallest_p_of(traced(studio, last), vpls) < level);
    CHECK(smallest_p_of(traced(studio, last, 1.5f * bound), vpls) < level);
}
