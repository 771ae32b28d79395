// SPDX-License-Identifier: MIT
#include "mir/sampling/vpl_roulette.hpp"

#include "conformance/sampler_suite.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/scene/builtin.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using mir::Lambert;
using mir::VplRecord;
using mir::VplRecords;
using mirtest::Approx;
using mirtest::Moments;
using Probe = mir::ImageProbe<Lambert, mir::cpu::EmbreeVisibility>;
using Plain = mir::InstantRadiositySampler<Lambert, mir::cpu::EmbreeRayCaster>;
using Roulette = mir::VplRoulette<Lambert, mir::cpu::EmbreeVisibility>;
using Sampler =
    mir::RouletteRadiositySampler<Lambert, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility>;
static_assert(mir::Sampler<Sampler>);

constexpr std::uint32_t side = 8;  ///< luxels of the test image along either axis
constexpr std::size_t tiles = 4;
constexpr std::size_t bounces = 4;  ///< 2, 3, 4, and all beyond
using TileMeans = std::array<double, tiles * bounces>;

/// A scene, its tracer and a fixed image of 8 x 8 luxels in four tiles.
struct Stage {
    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Lambert> surfaces{scene};
    mir::cpu::EmbreeScene embree{geometry};
    mir::VplShading<Lambert> shading{.bound = 3.0f};
    mutable mir::InlineExecutor executor;

    explicit Stage(mir::Scene s) : scene(std::move(s)) {}

    [[nodiscard]] Plain::World world() const {
        return {geometry, lights, surfaces, embree.ray_caster()};
    }
    [[nodiscard]] Probe probe(std::uint64_t seed, std::uint32_t luxels = 64) const {
        return {{scene.cameras[0], 1.0f, luxels, seed},
                embree.ray_caster(),
                surfaces,
                embree.visibility(),
                shading};
    }
    [[nodiscard]] VplRecords plain(std::uint64_t seed, std::uint32_t vpls) const {
        mir::InstantRadiosityOptions options;
        options.vpls = vpls;
        options.seed = seed;
        return Plain(world(), options).sample(executor);
    }
    /// Luminance of each luxel, and the share that each group of bounces has in each tile's mean.
    [[nodiscard]] std::vector<double> luxels(const VplRecords& from) const;
    [[nodiscard]] TileMeans tile_means(const VplRecords& from) const;

 private:
    template <class Add>
    void each_contribution(const VplRecords& from, const Add& add) const;
};

template <class Add>
void Stage::each_contribution(const VplRecords& from, const Add& add) const {
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const mir::Vec2 film((static_cast<float>(i % side) + 0.5f) / side,
                             (static_cast<float>(i / side) + 0.5f) / side);
        const mir::Ray ray = scene.cameras[0].ray(film, 1.0f, {0.5f, 0.5f});
        const auto point = embree.ray_caster().closest_hit(ray);
        if (!point) continue;
        const mir::Vec3 n = point->geometric_normal;
        const mir::Hit hit{mir::lift(*point), n};
        const auto surface = surfaces.surface(*point, -ray.direction);
        for (const VplRecord& r : from.records)
            add(i, r,
                static_cast<double>(luminance(
                    mir::contribution(hit, surface, r.vpl, embree.visibility(), shading))));
    }
}

std::vector<double> Stage::luxels(const VplRecords& from) const {
    std::vector<double> image(side * side);
    each_contribution(from, [&](std::uint32_t i, const VplRecord&, double l) { image[i] += l; });
    return image;
}

TileMeans Stage::tile_means(const VplRecords& from) const {
    TileMeans means{};
    each_contribution(from, [&](std::uint32_t i, const VplRecord& r, double l) {
        const std::size_t tile = i % side / (side / 2) + 2 * (i / side / (side / 2));
        const std::size_t bounce = std::min<std::size_t>(r.bounce, 5) - 2;
        means[tile * bounces + bounce] += l * tiles / (side * side);
    });
    return means;
}

using Replicates = std::array<Moments, tiles * bounces>;

/// Tile means of `sample(seed)` for 40 seeds from `first` on.
template <class Sample>
Replicates replicates(const Stage& stage, std::uint64_t first, const Sample& sample) {
    Replicates all;
    for (std::uint64_t seed = first; seed < first + 40; ++seed) {
        const TileMeans means = stage.tile_means(sample(seed));
        for (std::size_t i = 0; i < means.size(); ++i) all[i].add(means[i]);
    }
    return all;
}

/// Smallest p-value of "both have the same means" over all tiles and bounces.
double smallest_p_value(const Replicates& a, const Replicates& b) {
    double p = 1.0;
    for (std::size_t i = 0; i < a.size(); ++i) p = std::min(p, mirtest::welch_p_value(a[i], b[i]));
    return p;
}

/// Candidates of a seed and what decides about them.
struct Trial {
    Probe probe;
    VplRecords candidates;
    Roulette roulette;

    Trial(const Stage& stage, std::uint64_t seed, std::uint32_t luxels)
        : probe(stage.probe(seed, luxels)),
          candidates(stage.plain(seed, 1000)),
          roulette(probe, stage.plain(seed + 100'000, 1000), {}, stage.executor) {}

    /// Survivors by a filter with a fault: `fate(odds, flux)` is what the intensity is multiplied
    /// by.
    template <class Fate>
    [[nodiscard]] VplRecords wrong(std::uint64_t seed, const Fate& fate) const {
        VplRecords out = candidates;
        for (std::size_t i = 0; i < out.records.size(); ++i) {
            const float odds = roulette.survival(candidates, i);
            const bool survives = mir::Random(seed, mir::Stream::test, i).next() < odds;
            mir::Vpl& vpl = out.records[i].vpl;
            vpl.intensity =
                vpl.intensity * (survives ? fate(odds, probe.flux(vpl, vpl.intensity)) : 0.0f);
        }
        return out;
    }
};

}  // namespace

// H0: the roulette changes no mean, tile by tile and bounce by bounce. Welch's t between 40 plain
// runs of 2000 VPLs (seeds from 3001 on) and 40 runs of 256 survivors (from 4001 on), level 1 %
// over 2 scenes, 4 tiles and 4 groups of bounces.
TEST_CASE("kept VPLs light the image as all VPLs do, bounce by bounce", "[statistical]") {
    const char* name = GENERATE("door-ajar", "cornell-inverted");
    CAPTURE(name);
    const Stage stage(mir::builtin::make(name));
    const double level = mirtest::sidak(0.01, 2 * tiles * bounces);
    const Replicates all =
        replicates(stage, 3001, [&](std::uint64_t seed) { return stage.plain(seed, 2000); });
    Moments kept;
    const Replicates some = replicates(stage, 4001, [&](std::uint64_t seed) {
        const Probe probe = stage.probe(seed);
        mir::InstantRadiosityOptions options;
        options.seed = seed;
        auto records =
            Sampler(stage.world(), options, probe, {.pilot_vpls = 1000}).sample(stage.executor);
        kept.add(static_cast<double>(records.records.size()));
        return records;
    });
    CHECK(smallest_p_value(all, some) > level);
    CHECK(kept.mean() == Approx(256).epsilon(0.05));
}

// The same comparison on one scene, with 1000 candidates, plain seeds from 5001 and filtered ones
// from 6001 on, for the filter and for two that are wrong.
TEST_CASE("survivors that are not divided, and VPLs dropped for good, are rejected",
          "[statistical]") {
    const Stage stage(mir::builtin::make("cornell-inverted"));
    const double level = mirtest::sidak(0.01, tiles * bounces);
    const Replicates all =
        replicates(stage, 5001, [&](std::uint64_t seed) { return stage.plain(seed, 2000); });

    const auto with = [&](std::uint32_t luxels, const auto& fate) {
        return smallest_p_value(all, replicates(stage, 6001, [&](std::uint64_t seed) {
                                    return Trial(stage, seed, luxels).wrong(seed, fate);
                                }));
    };
    const auto right = [](float odds, float) { return 1.0f / odds; };
    const auto undivided = [](float, float) { return 1.0f; };
    const auto no_floor = [](float odds, float flux) { return flux > 0.0f ? 1.0f / odds : 0.0f; };
    CHECK(with(64, right) > level);
    CHECK(with(64, undivided) < level);
    // A probe of four luxels misses much: what the floor is there for.
    CHECK(with(4, right) > level);
    CHECK(with(4, no_floor) < level);
}

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

// H0: as much as 3 %, or as little as 1 %, of the lamps' power gets through its gap. Student's t
// over 40 runs of 8000 VPLs (seeds from 8001 on), level 1 % over both; both must be rejected.
TEST_CASE("lamps behind a door ajar send 1 to 3 % of their power into the camera's room",
          "[statistical]") {
    const Stage stage(mir::builtin::make("door-ajar"));
    Moments share;
    for (std::uint64_t seed = 8001; seed < 8041; ++seed) {
        const VplRecords records = stage.plain(seed, 8000);
        double power = 0.0;
        bool inside = false;
        for (const VplRecord& r : records.records) {
            const bool was_inside = inside && r.bounce > 2;
            inside = r.vpl.position.z > 0.0f;
            if (!inside || was_inside) continue;
            const auto material = stage.geometry.material_of(r.origin.triangle);
            const mir::Rgb rho = stage.scene.materials[material].base_color;
            const mir::Rgb j = r.vpl.intensity;
            power += mirtest::pi * static_cast<double>(
                                       luminance(mir::Rgb{j.r / rho.r, j.g / rho.g, j.b / rho.b}));
        }
        share.add(power / static_cast<double>(records.emitted_power));
    }
    CAPTURE(share.mean(), share.standard_error());
    CHECK(share.mean() > 0.01);
    CHECK(share.mean() < 0.03);
    CHECK(mirtest::mean_p_value(share, 0.01) < mirtest::sidak(0.01, 2));
    CHECK(mirtest::mean_p_value(share, 0.03) < mirtest::sidak(0.01, 2));
}

// Variance per kept VPL, summed over the luxels, of 60 runs each (seeds from 7001 on); less than
// half of plain instant radiosity's is asked for.
TEST_CASE("with a door ajar a kept VPL is worth several plain ones", "[statistical]") {
    const Stage stage(mir::builtin::make("door-ajar"));
    const auto cost = [&](const auto& sample) {
        std::vector<Moments> luxels(side * side);
        double kept = 0.0;
        for (std::uint64_t seed = 7001; seed < 7061; ++seed) {
            const VplRecords records = sample(seed);
            kept += static_cast<double>(records.records.size()) / 60;
            const std::vector<double> image = stage.luxels(records);
            for (std::size_t i = 0; i < image.size(); ++i) luxels[i].add(image[i]);
        }
        double variance = 0.0;
        for (const Moments& m : luxels) variance += m.variance();
        return variance * kept;
    };
    const double plain = cost([&](std::uint64_t seed) { return stage.plain(seed, 256); });
    const double filtered = cost([&](std::uint64_t seed) {
        const Probe probe = stage.probe(seed);
        mir::InstantRadiosityOptions options;
        options.seed = seed;
        return Sampler(stage.world(), options, probe, {.threshold = 4.0f, .pilot_vpls = 1000})
            .sample(stage.executor);
    });
    CAPTURE(plain, filtered, plain / filtered);
    CHECK(filtered < 0.5 * plain);
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

// H0, level and seeds: see mir::validation::check_sampler_light().
TEST_CASE("VPLs that roulette keeps bring a known furnace its light", "[statistical]") {
    const mir::validation::KnownLight room = mir::validation::known_furnace();
    const Stage stage(room.scene());
    const Probe probe = stage.probe(1);
    mirtest::passes(mir::validation::check_sampler(
        [&](std::uint64_t seed) {
            mir::InstantRadiosityOptions options;
            options.seed = seed;
            return Sampler(stage.world(), options, probe, {.pilot_vpls = 500});
        },
        room));
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
