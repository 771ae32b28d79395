// SPDX-License-Identifier: MIT
#include "mir/sampling/vpl_generator.hpp"

#include "mir/paths/each_path.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"
#include "support/see_through_wedge.hpp"
#include "support/wedge.hpp"

#include <array>

// The mean weight of VPL space's paths is the integral of their target, whichever techniques draw
// them. Light paths alone reach every place, so they are the judge of the mixture.

namespace {

using mir::CookTorrance;
using mir::Lambert;
using mir::PathMeasure;
using mir::Technique;
using mir::TechniqueTable;
using mir::VplDensity;
using mir::WeightedPath;
using mirtest::Moments;
using mirtest::PathLab;
using mirtest::Wedge;
using mirtest::WedgeLights;

double light_path(const PathMeasure& m, Technique t, const TechniqueTable& table) {
    return VplDensity::mixture(m, t, table, 0.0);
}

/// The judge: only light paths count.
struct LightPathsAlone {
    static double mixture(const PathMeasure& m, Technique t, const TechniqueTable& table, double) {
        return t.from_light + 1 == t.edges ? light_path(m, t, table) : 0.0;
    }
};
struct GeneratingTechniqueAlone {
    static double mixture(const PathMeasure& m, Technique t, const TechniqueTable& table,
                          double from_probe) {
        if (t.from_light + 1 == t.edges) return light_path(m, t, table);
        return from_probe * table.probability(t.edges) * table.probability_of(t) *
               technique_density(m, t.edges, t.from_light, 3);
    }
};
struct WithoutProbe {
    static double mixture(const PathMeasure& m, Technique t, const TechniqueTable& table, double) {
        return light_path(m, t, table);
    }
};
struct WithoutLightPaths {
    static double mixture(const PathMeasure& m, Technique t, const TechniqueTable& table,
                          double from_probe) {
        return from_probe * suffix_density(m, t.edges, table);
    }
};
/// Takes the density of rays for twice what it is.
struct TwiceTheProbe {
    static double mixture(const PathMeasure& m, Technique t, const TechniqueTable& table,
                          double from_probe) {
        return VplDensity::mixture(m, t, table, 2.0 * from_probe);
    }
};

/// Weights by length, those of other lengths counted as 0.
template <class Density, mir::Bsdf B>
std::array<Moments, 6> weights(const PathLab<B>& lab, std::uint32_t shortest, std::uint64_t seed,
                               std::uint32_t luxels) {
    constexpr std::uint64_t paths = 60'000;
    const auto w = lab.world();
    using Generator = mir::VplGenerator<std::remove_const_t<decltype(w)>, Density>;
    const typename Generator::Probe probe({lab.scene.cameras[0], 1.0f, luxels, 3}, w.luxels.caster,
                                          lab.surfaces, w.visibility);
    const Generator generator(w, probe, shortest, 5, 0.01);
    std::array<Moments, 6> moments;
    mir::InlineExecutor one;
    each_path(generator, {seed, mir::Stream::test, 0, paths}, one,
              [&](std::uint64_t, const WeightedPath& p) {
                  for (std::uint32_t k = shortest; k <= 5; ++k)
                      moments[k].add(p.path.edges() == k ? p.weight : 0.0);
              });
    return moments;
}

/// p-value, after Sidak, of "drawn with Density, the target has the integral that light paths
/// alone find".
template <class Density, mir::Bsdf B>
double agreement(const PathLab<B>& lab, std::uint64_t seed, std::uint32_t luxels = 64) {
    const std::uint32_t shortest = lab.lights.has_emitters() ? 2 : 3;
    const auto judge = weights<LightPathsAlone>(lab, shortest, seed, luxels);
    const auto tested = weights<Density>(lab, shortest, seed + 1, luxels);
    double smallest = 1.0;
    for (std::uint32_t k = shortest; k <= 5; ++k) {
        REQUIRE(judge[k].mean() > 0.0);
        smallest = std::min(smallest, mirtest::welch_p_value(judge[k], tested[k]));
        UNSCOPED_INFO("k " << k << " judge " << judge[k].mean() << " +- "
                           << judge[k].standard_error() << ", tested " << tested[k].mean() << " +- "
                           << tested[k].standard_error());
    }
    return -std::expm1((6.0 - shortest) * std::log1p(-smallest));
}

}  // namespace

// H0 of each case: the weights of the mixture have the mean of those of light paths alone, for
// paths of 2 (or 3) to 5 edges. Welch's test, 1 % per case after Sidak; seeds in the cases.

TEST_CASE("VPL space has the light of light paths, whatever the lamps", "[statistical]") {
    const auto lights = GENERATE(WedgeLights::ceiling, WedgeLights::two_sided, WedgeLights::point,
                                 WedgeLights::spot, WedgeLights::directional);
    CAPTURE(static_cast<int>(lights));
    const PathLab<Lambert> lab(Wedge(lights).scene());
    CHECK(agreement<VplDensity>(lab, 3000 + 10 * static_cast<std::uint64_t>(lights)) > 0.01);
}

TEST_CASE("VPL space has the light of light paths between glossy surfaces", "[statistical]") {
    const auto lights = GENERATE(WedgeLights::two_sided, WedgeLights::spot);
    CAPTURE(static_cast<int>(lights));
    const PathLab<CookTorrance> lab(Wedge(lights, 1.0f).scene());
    CHECK(agreement<VplDensity>(lab, 3100 + 10 * static_cast<std::uint64_t>(lights)) > 0.01);
}

TEST_CASE("VPL space has the light of light paths in the Cornell boxes", "[statistical]") {
    const auto* name = GENERATE("cornell-box", "cornell-inverted");
    const PathLab<Lambert> lab(mir::builtin::make(name));
    CAPTURE(name);
    CHECK(agreement<VplDensity>(lab, 3200) > 0.01);
}

// Few luxels: each bit of a pane matters.
TEST_CASE("VPL space has the light of light paths behind panes", "[statistical]") {
    mir::Scene scene = Wedge(WedgeLights::two_sided).scene();
    mirtest::add_panes(scene);
    const PathLab<CookTorrance> lab(std::move(scene));
    CHECK(agreement<VplDensity>(lab, 3300, 4) > 0.01);
}

TEST_CASE("VPL space has the light of light paths where lamps are seen through", "[statistical]") {
    const bool is_glass = GENERATE(false, true);
    CAPTURE(is_glass);
    mir::Scene scene = Wedge(WedgeLights::two_sided).scene();
    mirtest::see_through_lamps(scene, is_glass);
    const PathLab<CookTorrance> lab(std::move(scene));
    CHECK(agreement<VplDensity>(lab, 3310 + (is_glass ? 2 : 0)) > 0.01);
}

TEMPLATE_TEST_CASE("VPL space with a wrong density is rejected", "[statistical]",
                   GeneratingTechniqueAlone, WithoutProbe, WithoutLightPaths, TwiceTheProbe) {
    const PathLab<Lambert> lab(Wedge(WedgeLights::two_sided).scene());
    CHECK(agreement<TestType>(lab, 3010) < 1e-6);
}

TEST_CASE("a probe that sees nothing leaves light paths") {
    mir::Scene scene = mir::builtin::make("cornell-box");
    scene.cameras = {mir::Camera::look_at({0, 1, 3.4f}, {0, 1, 9}, {0, 1, 0}, 0.6f)};
    const PathLab<Lambert> lab(scene);
    const auto w = lab.world();
    using Generator = mir::VplGenerator<std::remove_const_t<decltype(w)>>;
    const Generator::Probe probe({lab.scene.cameras[0], 1.0f, 64, 3}, w.luxels.caster, lab.surfaces,
                                 w.visibility);
    REQUIRE(probe.receivers() == 0);
    const Generator generator(w, probe, 2, 5, 1.0);
    WeightedPath p;
    int lit = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        generator.generate(mir::Random(1, mir::Stream::test, i), p);
        if (p.weight == 0.0) continue;
        ++lit;
        CHECK(mir::is_black(p.measure.contribution));
        CHECK(p.weight * p.density == mirtest::Approx(luminance(p.measure.leaving)).epsilon(1e-6));
    }
    CHECK(lit > 100);
}
