// SPDX-License-Identifier: MIT
#include "mir/sampling/vpl_roulette.hpp"

#include "conformance/sampler_suite.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/scenes.hpp"
#include "sampling/roulette_stage.hpp"

#include <algorithm>
#include <cmath>

namespace {

using mir::VplRecord;
using mir::VplRecords;
using mirtest::Approx;
using Stage = mirtest::RouletteStage;
using Probe = Stage::Probe;
using Roulette = Stage::Roulette;
using Sampler = Stage::Sampler;
static_assert(mir::Sampler<Sampler>);

}  // namespace

TEST_CASE("odds follow the flux: floor, share of the mean, one. Intensities are divided by them") {
    const Stage stage(mir::builtin::make("door-ajar"));
    const Probe probe = stage.probe(1);
    const VplRecords pilot = stage.plain(2, 2000);
    const VplRecords from = stage.plain(1, 2000);
    const mir::VplRouletteOptions options{.floor = 0.05f, .threshold = 2.0f};
    const Roulette roulette(probe, pilot, options, stage.executor);
    REQUIRE(roulette.mean_flux() > 0.0);
    double mean = 0.0;
    for (const VplRecord& r : pilot.records)
        mean += static_cast<double>(probe.flux(r.vpl, r.vpl.intensity)) *
                static_cast<double>(pilot.paths) / static_cast<double>(pilot.records.size());
    CHECK(roulette.mean_flux() == Approx(mean).epsilon(1e-5));

    std::size_t floored = 0;
    std::size_t sure = 0;
    double share = 0.0;
    for (std::size_t i = 0; i < from.records.size(); ++i) {
        const mir::Vpl& vpl = from.records[i].vpl;
        const double flux =
            static_cast<double>(probe.flux(vpl, vpl.intensity)) * static_cast<double>(from.paths);
        const float odds = roulette.survival(from, i);
        CHECK(odds == Approx(std::clamp(flux / (2 * mean), 0.05, 1.0)).epsilon(1e-4));
        floored += odds == 0.05f ? 1u : 0u;
        sure += odds == 1.0f ? 1u : 0u;
        share += static_cast<double>(odds) / static_cast<double>(from.records.size());
    }
    CHECK(floored > 0);
    CHECK(sure > 0);
    CHECK(roulette.acceptance() == Approx(share).epsilon(0.2));

    const VplRecords kept = roulette.filter(from, 1, stage.executor);
    CHECK(kept.records.size() >= sure);
    CHECK(kept.paths == from.paths);
    std::size_t i = 0;
    for (const VplRecord& r : kept.records) {
        while (from.records[i].vpl.position != r.vpl.position) ++i;
        const float odds = roulette.survival(from, i);
        CHECK(r.vpl.intensity.g == Approx(from.records[i].vpl.intensity.g / odds));
        CHECK(r.bounce == from.records[i].bounce);
    }
}

TEST_CASE("the sampler keeps the axioms of Sampler") {
    const Stage stage(mir::builtin::make("door-ajar"));
    const Probe probe = stage.probe(1);
    mir::TbbExecutor two(2);
    mirtest::sampler_suite(
        [&](std::uint64_t seed) {
            mir::InstantRadiosityOptions options;
            options.seed = seed;
            return Sampler(stage.world(), options, probe, {.pilot_vpls = 500});
        },
        two);
}

TEST_CASE("arrivals stay with their VPLs, and their power is divided by the same odds") {
    const Stage stage(mir::builtin::make("door-ajar"));
    const Probe probe = stage.probe(1);
    const VplRecords kept =
        Sampler(stage.world(), {.vpls = 512, .arrivals = true}, probe).sample(stage.executor);
    REQUIRE(kept.arrivals.size() == kept.records.size());
    CHECK(kept.records.size() > 100);
    for (std::size_t i = 0; i < kept.records.size(); ++i) {
        const mir::VplArrival& a = kept.arrivals[i];
        const float rho = stage.scene.materials[a.material].base_color.g;
        CHECK(kept.records[i].vpl.intensity.g ==
              Approx(a.power.g * rho * mir::inv_pi).epsilon(1e-5));
    }
}

TEST_CASE("where the pilot lights nothing, every VPL is kept as it is") {
    mir::Scene scene = mir::builtin::make("door-ajar");
    scene.cameras[0] = mir::Camera::look_at({0, 9, 0}, {0, 20, 0}, {0, 0, 1}, 0.8f);
    const Stage stage(scene);
    const Probe probe = stage.probe(1);
    const VplRecords records =
        Sampler(stage.world(), {}, probe, {.pilot_vpls = 500}).sample(stage.executor);
    CHECK(mirtest::same_records(records, stage.plain(0, 256)));
}

TEST_CASE("a scene without light yields no record") {
    mir::Scene scene = mir::builtin::make("door-ajar");
    for (mir::Material& m : scene.materials) m.emission = {};
    const Stage stage(scene);
    const Probe probe = stage.probe(1);
    CHECK(Sampler(stage.world(), {}, probe).sample(stage.executor).records.empty());
}

TEST_CASE("roulette options out of range are refused, and more candidates than the limit") {
    const Stage stage(mir::builtin::make("door-ajar"));
    const Probe probe = stage.probe(1);
    const auto make = [&](mir::VplRouletteOptions roulette, std::uint32_t vpls = 10) {
        mir::InstantRadiosityOptions options;
        options.vpls = vpls;
        mir::Limits limits;
        limits.vpls = 1000;
        return Sampler(stage.world(), options, probe, roulette, limits);
    };
    for (const float floor : {0.0f, -0.1f, 1.1f, std::nanf("")})
        CHECK_THROWS_AS(make({.floor = floor}), mir::Error);
    for (const float threshold : {0.0f, -1.0f, std::nanf(""), HUGE_VALF})
        CHECK_THROWS_AS(make({.threshold = threshold}), mir::Error);
    CHECK_THROWS_AS(make({.pilot_vpls = 0}), mir::Error);
    CHECK_THROWS_AS(make({}, 0), mir::Error);
    CHECK_THROWS_AS(make({}, 1001), mir::Error);
    CHECK_NOTHROW(make({.floor = 1.0f}).sample(stage.executor));
    try {
        static_cast<void>(make({}, 1000).sample(stage.executor));
        FAIL("no error");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::limit_exceeded);
    }
}
