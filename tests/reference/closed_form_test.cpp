// SPDX-License-Identifier: MIT
//
// The path tracer against numbers known in closed form (docs/method.md, 9).
#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "studio.hpp"
#include "support/catch.hpp"
#include "wrong_models.hpp"

#include <cmath>

using namespace mirtest;
using mir::Lambert;
using mir::LightSearch;
using mir::Rgb;
using mir::Vec3;

namespace {

constexpr double facing_squares = 0.199824896;
constexpr double squares_with_an_edge = 0.200043776;

/// Looks straight down on a unit square of albedo 1 so that the film covers exactly that: the mean
/// radiance is the form factor towards a lamp of radiance 1.
mir::Scene seen_from_above(mir::Scene scene, Vec3 centre) {
    constexpr float height = 0.9f;  // below the lamp of the facing squares
    scene.cameras = {mir::Camera::look_at(centre + Vec3(0, height, 0), centre, {0, 0, -1},
                                          2.0f * std::atan(0.5f / height))};
    return scene;
}

/// p-value of a form factor from 32 replicates of 32 x 32 pixels, 16 random film positions each.
template <class Rules = mir::BalanceRules, mir::Bsdf B = Lambert>
double p_of_form_factor(const mir::Scene& scene, LightSearch search, double expected) {
    const Studio<B> studio(scene);
    const auto tracer = studio.template tracer<Rules>({.light = search, .max_bounce = 1});
    mir::ReferenceOptions options;
    options.samples = 16;
    options.film = mir::FilmPosition::pixel;
    const auto images = replicates(tracer, studio.rays(32, 311), options, 32);
    return p_of_mean(images, 1, expected, 1e-6);
}

/// D_1 below the centre of a disc of radiance 1, over 32 replicates of 4096 estimates.
template <class Rules = mir::BalanceRules>
double p_of_disc(LightSearch search) {
    const Studio<Lambert> studio(mir::builtin::disc_above_plane());
    const auto tracer = studio.tracer<Rules>({.light = search, .max_bounce = 1});
    const Vec3 up(0, 1, 0);
    const Rgb white{1, 1, 1};
    Moments moments;
    for (std::uint64_t r = 0; r < 32; ++r) {
        std::array<mir::RgbSum, 2> sum{};
        mir::Random random(312, mir::Stream::reference, r);
        for (int i = 0; i < 4096; ++i)
            tracer.trace({{studio.geometry.ray_offset() * up, up}, {up, up, {}, {white}}}, random,
                         sum);
        moments.add(sum[1].channel[0] / 4096);
    }
    // The lamp is a polygon of 256 corners with the area of the disc: 1e-5 covers what is left.
    return mean_p_value(moments, 0.5, 1e-5);
}

/// Smallest p-value of D_b = L_e rho^b, b = 1 to 8, in a closed room of rho = L_e = 0.5, over 32
/// replicates of 16 x 16 luxels with 8 samples.
template <class Rules = mir::BalanceRules, mir::Bsdf B = Lambert>
double p_of_furnace(const mir::PathTracerOptions& options) {
    const Studio<B> studio(mir::builtin::furnace_box(0.5f, 0.5f));
    mir::ReferenceOptions reference;
    reference.samples = 8;
    const auto images =
        replicates(studio.template tracer<Rules>(options), studio.rays(16, 313), reference, 32);
    CHECK(luminance(images.front().bounce(0)(3, 5)) == Approx(0.5).epsilon(1e-6));
    double p = 1.0;
    for (std::uint8_t b = 1; b <= 8; ++b)
        p = std::min(p, p_of_mean(images, b, std::pow(0.5, b + 1), 1e-7));
    return p;
}

const LightSearch searches[] = {LightSearch::mis, LightSearch::lamps, LightSearch::directions};

}  // namespace

// H0: the mean of D_1 is the form factor, whichever way light is found. Student's t over 32
// replicates, seeds 311 and 312, level 1 % over the 9 tests of this case.
TEST_CASE("the path tracer finds the form factors of squares and discs", "[statistical]") {
    const double level = sidak(0.01, 9);
    const auto facing = seen_from_above(mir::builtin::parallel_squares(), {0, 0, 0});
    const auto edge = seen_from_above(mir::builtin::perpendicular_squares(), {0, 0, 0.5f});
    for (LightSearch search : searches) {
        CAPTURE(int(search));
        CHECK(p_of_form_factor(facing, search, facing_squares) > level);
        CHECK(p_of_form_factor(edge, search, squares_with_an_edge) > level);
        CHECK(p_of_disc(search) > level);
    }
}

TEST_CASE("form factors reject wrong weights, Jacobians, cosines and densities", "[statistical]") {
    const double level = sidak(0.01, 9);
    const auto facing = seen_from_above(mir::builtin::parallel_squares(), {0, 0, 0});
    const auto p = [&]<class Rules, class B>(Rules, B, LightSearch search) {
        return p_of_form_factor<Rules, B>(facing, search, facing_squares);
    };
    const mir::BalanceRules rules;
    const Lambert lambert;
    CHECK(p(DoubleCounting{}, lambert, LightSearch::mis) < level);
    CHECK(p(UnevenWeights{}, lambert, LightSearch::mis) < level);
    CHECK(p(NoJacobian{}, lambert, LightSearch::lamps) < level);
    CHECK(p(NoEmitterCosine{}, lambert, LightSearch::lamps) < level);
    CHECK(p(rules, CosineTwice{}, LightSearch::lamps) < level);
    CHECK(p(rules, WrongSampleDensity{}, LightSearch::mis) < level);
    CHECK(p(rules, LosesPaths{}, LightSearch::directions) < level);
    CHECK(p_of_disc<DoubleCounting>(LightSearch::mis) < level);
    CHECK(p_of_disc<NoEmitterCosine>(LightSearch::lamps) < level);
}

// H0: D_b = L_e rho^b. Student's t over 32 replicates, seed 313, level 1 % over 4 x 8 tests. Light
// samples alone have no variance to test with here: in corners of bright walls it is infinite.
TEST_CASE("every bounce of the furnace has its radiance", "[statistical]") {
    const double level = sidak(0.01, 32);
    CHECK(p_of_furnace({.max_bounce = 8}) > level);
    CHECK(p_of_furnace({.max_bounce = 8, .roulette_from = 1}) > level);
    CHECK(p_of_furnace({.light_samples = 2, .directions = 3, .max_bounce = 8}) > level);
    CHECK(p_of_furnace<mir::PowerRules>({.max_bounce = 8, .roulette_from = 5}) > level);
}

// H0: mean radiance L_e / (1 - rho) = 20, a fifth of which is scattered more than 32 times.
// Student's t over 32 replicates of 16 x 16 luxels with 8 samples, seed 316, level 1 %.
TEST_CASE("without a largest bounce a bright furnace has all of its radiance", "[statistical]") {
    const Studio<Lambert> studio(mir::builtin::furnace_box(0.95f, 1.0f));
    mir::ReferenceOptions options;
    options.samples = 8;
    options.last_bounce = 3;
    const auto p = [&](const mir::PathTracerOptions& paths) {
        TileMeans means(16);
        for (const auto& image :
             replicates(studio.tracer(paths), studio.rays(16, 316), options, 32))
            means.add(image.beauty());
        return mean_p_value(means.moments().front(), 20.0, 1e-6);
    };
    CHECK(p({}) > 0.01);
    CHECK(p({.max_bounce = 32}) < 1e-9);
}

TEST_CASE("the furnace rejects roulette without compensation, lost paths and light counted twice",
          "[statistical]") {
    const double level = sidak(0.01, 32);
    CHECK(p_of_furnace<NoCompensation>({.max_bounce = 8}) < level);
    CHECK(p_of_furnace<DoubleCounting>({.max_bounce = 8}) < level);
    CHECK(p_of_furnace<mir::BalanceRules, LosesPaths>({.max_bounce = 8}) < level);
}

// Where light is found by directions alone and nothing ends by chance, every path of the furnace
// brings exactly L_e rho^b: no sampling tolerance is left.
TEST_CASE("implicit light in the furnace is exact") {
    const Studio<Lambert> studio(mir::builtin::furnace_box(0.5f, 0.5f));
    const auto tracer =
        studio.tracer({.light = LightSearch::directions, .max_bounce = 20, .roulette_from = 255});
    mir::ReferenceOptions options;
    options.samples = 2;
    options.replicates = 1;
    options.last_bounce = 20;
    mir::InlineExecutor executor;
    const auto image = trace_reference(tracer, studio.rays(16, 314), options, executor);
    for (std::uint8_t b = 0; b <= 20; ++b) {
        const mir::Image<Rgb> bounce = image.bounce(b);
        for (const Rgb& c : bounce.pixels())
            REQUIRE(static_cast<double>(c.g) == Approx(std::pow(0.5, b + 1)).epsilon(1e-6));
    }
    const mir::Image<Rgb> beauty = image.beauty();
    for (const Rgb& c : beauty.pixels()) REQUIRE(c.g == Approx(1.0).epsilon(1e-5));
}
