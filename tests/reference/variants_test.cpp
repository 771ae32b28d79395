// SPDX-License-Identifier: MIT
//
// Every way to find light and to spend samples has one expectation, bounce by bounce.
#include "conformance/stage.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "studio.hpp"
#include "support/catch.hpp"
#include "wrong_models.hpp"

using namespace mirtest;
using mir::CookTorrance;
using mir::Lambert;
using mir::LightSearch;

namespace {

constexpr std::uint8_t last = 4;  // bounces 1 to 4 are compared
constexpr std::uint32_t runs = 24;

mir::PathTracerOptions with(LightSearch light) { return {.light = light, .max_bounce = last}; }

/// `runs` images of 32 x 32 luxels with 8 samples; `batch` keeps their numbers apart.
template <class Rules = mir::BalanceRules, mir::Bsdf B>
std::vector<mir::ReferenceImage> images(const Studio<B>& studio, std::uint32_t batch,
                                        const mir::PathTracerOptions& options) {
    mir::ReferenceOptions reference;
    reference.samples = 8;
    reference.first_replicate = batch * runs;
    return replicates(studio.template tracer<Rules>(options), studio.rays(32, 411), reference,
                      runs);
}

/// Smallest p-value over bounces and 4 tiles of 16 x 16 luxels.
double smallest_p_of(const std::vector<mir::ReferenceImage>& a,
                     const std::vector<mir::ReferenceImage>& b) {
    double p = 1.0;
    for (std::uint8_t bounce = 1; bounce <= last; ++bounce)
        p = std::min(p, smallest_p(tiles_of(a, bounce, 16), tiles_of(b, bounce, 16)));
    return p;
}

/// The turned Cornell box with lamps that also reflect, and shine from both sides.
mir::Scene bright_lamp_box() {
    mir::Scene s = mir::builtin::cornell_box(mir::builtin::Lamp::up);
    mir::Material& lamp = s.materials[s.meshes.back().material];
    lamp.base_color = {0.6f, 0.6f, 0.6f};
    lamp.emits_from_both_sides = true;
    return s;
}

/// Smallest p-value of every variant against the default, on one scene.
template <mir::Bsdf B>
double smallest_p_of_variants(const mir::Scene& scene) {
    const Studio<B> studio(scene);
    const auto reference = images(studio, 0, with(LightSearch::mis));
    mir::PathTracerOptions implicit = with(LightSearch::directions);
    implicit.directions = 8;  // lamps are seldom met: fewer would not average to a normal law
    mir::PathTracerOptions explicit_light = with(LightSearch::lamps);
    explicit_light.roulette_from = 255;
    mir::PathTracerOptions spread = with(LightSearch::mis);
    spread.directions = 3;
    spread.light_samples = 2;
    spread.roulette_from = 1;
    std::uint32_t batch = 0;
    double p = 1.0;
    for (const auto& options : {implicit, explicit_light, spread})
        p = std::min(p, smallest_p_of(reference, images(studio, ++batch, options)));
    const auto power = images<mir::PowerRules>(studio, ++batch, with(LightSearch::mis));
    return std::min(p, smallest_p_of(reference, power));
}

constexpr std::size_t tests_per_scene = 4 * last * 4;

/// Smallest p-value of a wrong tracer against the right one.
template <mir::Bsdf B, class Rules = mir::BalanceRules>
double p_of_wrong(LightSearch light) {
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::up);
    const Studio<Lambert> right(scene);
    const Studio<B> wrong(scene);
    return smallest_p_of(images(right, 20, with(LightSearch::mis)),
                         images<Rules>(wrong, 21, with(light)));
}

}  // namespace

// H0: equal means of every tile and bounce. Welch's test over 24 replicates each, seed 411, level
// 1 % over all scenes, variants, bounces and tiles.
TEST_CASE("all ways to find light agree, bounce by bounce", "[statistical]") {
    const double level = sidak(0.01, 3 * tests_per_scene);
    const mir::Scene box = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    CHECK(smallest_p_of_variants<Lambert>(box) > level);
    CHECK(smallest_p_of_variants<Lambert>(bright_lamp_box()) > level);
    CHECK(smallest_p_of_variants<CookTorrance>(glossy_box()) > level);
}

TEST_CASE("wrong weights, Jacobians, cosines and roulette are rejected", "[statistical]") {
    const double level = sidak(0.01, 3 * tests_per_scene);
    CHECK(p_of_wrong<Lambert>(LightSearch::mis) > level);  // nothing wrong: accepted
    CHECK(p_of_wrong<Lambert, DoubleCounting>(LightSearch::mis) < level);
    CHECK(p_of_wrong<Lambert, NoJacobian>(LightSearch::lamps) < level);
    CHECK(p_of_wrong<Lambert, NoEmitterCosine>(LightSearch::lamps) < level);
    CHECK(p_of_wrong<Lambert, NoCompensation>(LightSearch::mis) < level);
    CHECK(p_of_wrong<CosineTwice>(LightSearch::mis) < level);
}

// The course's L_1, L_2, L_3: the first bounces of one long run are those of short ones.
// H0: equal means of every tile. Welch's test over 24 replicates each, seed 411, level 1 %.
TEST_CASE("prefix sums are the images of fewer bounces", "[statistical]") {
    const Studio<Lambert> studio(mir::builtin::cornell_box(mir::builtin::Lamp::up));
    const auto all = images(studio, 30, with(LightSearch::mis));
    for (std::uint8_t n = 1; n <= 3; ++n) {
        mir::PathTracerOptions options = with(LightSearch::mis);
        options.max_bounce = n;
        TileMeans prefix(16);
        TileMeans limited(16);
        for (const auto& image : all) prefix.add(image.up_to(n));
        for (const auto& image : images(studio, 30u + n, options)) limited.add(image.beauty());
        CAPTURE(int{n});
        CHECK(smallest_p(prefix, limited) > sidak(0.01, 3 * 4));
    }
}
