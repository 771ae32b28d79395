// SPDX-License-Identifier: MIT
// The light that VPLs bring after roulette, and what one of them is worth.
#include "conformance/sampler_suite.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/contribution.hpp"
#include "sampling/roulette_stage.hpp"
#include "support/statistics.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using mir::VplRecord;
using mir::VplRecords;
using mirtest::Approx;
using mirtest::Moments;
using Stage = mirtest::RouletteStage;
using Probe = Stage::Probe;
using Roulette = Stage::Roulette;
using Sampler = Stage::Sampler;

constexpr std::uint32_t side = 8;  ///< luxels of the test image along either axis
constexpr std::size_t tiles = 4;
constexpr std::size_t bounces = 4;  ///< 2, 3, 4, and all beyond
using TileMeans = std::array<double, tiles * bounces>;

/// Calls add(luxel, record, luminance) for each luxel and VPL.
template <class Add>
void each_contribution(const Stage& stage, const VplRecords& from, const Add& add) {
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const mir::Vec2 film((static_cast<float>(i % side) + 0.5f) / side,
                             (static_cast<float>(i / side) + 0.5f) / side);
        const mir::Ray ray = stage.scene.cameras[0].ray(film, 1.0f, {0.5f, 0.5f});
        const auto point = stage.embree.ray_caster().closest_hit(ray);
        if (!point) continue;
        const mir::Vec3 n = point->geometric_normal;
        const mir::Hit hit{mir::lift(*point), n};
        const auto surface = stage.surfaces.surface(*point, -ray.direction);
        for (const VplRecord& r : from.records)
            add(i, r,
                static_cast<double>(luminance(mir::contribution(
                    hit, surface, r.vpl, stage.embree.visibility(), stage.shading))));
    }
}

/// Luminance of each luxel.
std::vector<double> luminances(const Stage& stage, const VplRecords& from) {
    std::vector<double> image(side * side);
    each_contribution(stage, from,
                      [&](std::uint32_t i, const VplRecord&, double l) { image[i] += l; });
    return image;
}

/// The share that each group of bounces has in each tile's mean.
TileMeans tile_means(const Stage& stage, const VplRecords& from) {
    TileMeans means{};
    each_contribution(stage, from, [&](std::uint32_t i, const VplRecord& r, double l) {
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
        const TileMeans means = tile_means(stage, sample(seed));
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
            const std::vector<double> image = luminances(stage, records);
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
