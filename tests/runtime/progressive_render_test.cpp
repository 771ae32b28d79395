// SPDX-License-Identifier: MIT
#include "mir/runtime/progressive_render.hpp"

#include "runtime/noise_renderer.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <cmath>
#include <limits>
#include <set>

using mirtest::NoiseRenderer;

namespace {

const mir::Scene scene;
constexpr double infinity = std::numeric_limits<double>::infinity();

mir::RenderSettings settings(std::uint64_t seed = 7) {
    mir::RenderSettings s;
    s.image = {24, 18};
    s.seed = seed;
    return s;
}

/// Renders until the goal is reached.
mir::RenderResult finished(const NoiseRenderer& renderer, const mir::PassGoal& goal,
                           std::uint64_t seed = 7) {
    mir::ProgressiveRender render(renderer, scene, settings(seed), goal);
    while (!render.is_complete()) render.next_pass();
    return render.result();
}

/// Mean square difference of a picture's luminance from 1, which is what NoiseRenderer expects.
double mean_square_error(const mir::RenderResult& result) {
    double sum = 0.0;
    for (const mir::Rgb& p : result.beauty.pixels())
        sum += std::pow(static_cast<double>(luminance(p)) - 1.0, 2);
    return sum / static_cast<double>(result.beauty.pixels().size());
}

}  // namespace

TEST_CASE("passes have seeds of their own, the first that of the render") {
    std::set<std::uint64_t> seeds;
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
        CHECK(mir::pass_seed(seed, 0) == seed);
        for (std::uint64_t pass = 0; pass < 1000; ++pass) seeds.insert(mir::pass_seed(seed, pass));
    }
    CHECK(seeds.size() == 3000);
    CHECK(mir::pass_seed(1, std::uint64_t{1} << 32) != mir::pass_seed(1, 1));
    static_assert(mir::pass_seed(0, 1) != mir::pass_seed(1, 1));
}

TEST_CASE("each pass begins with nothing done and nothing planned") {
    // What a render from discs leaves behind.
    const NoiseRenderer renderer;
    mir::Monitor monitor;
    mir::ProgressiveRender render(renderer, scene, settings(), {.passes = 2}, &monitor);
    monitor.gathers = monitor.planned_gathers = 5;
    monitor.contributions = monitor.planned_contributions = 7;
    render.next_pass();
    CHECK(monitor.passes == 0);
    CHECK((monitor.gathers == 0 && monitor.planned_gathers == 0));
    CHECK((monitor.contributions == 0 && monitor.planned_contributions == 0));
    render.next_pass();
    CHECK(monitor.passes == 1);
}

TEST_CASE("each pass is rendered with its seed, and all else as asked") {
    const NoiseRenderer renderer;
    finished(renderer, {.passes = 3}, 11);
    CHECK(renderer.seeds ==
          std::vector<std::uint64_t>{11, mir::pass_seed(11, 1), mir::pass_seed(11, 2)});
}

TEST_CASE("the numbers of passes add up or become means") {
    const mir::RenderResult result = finished(NoiseRenderer(), {.passes = 4});
    const mir::RenderStatistics& s = result.statistics;
    CHECK(s.passes == 4);
    CHECK(s.complete);
    CHECK(s.vpls == 4 * 10);
    CHECK(s.light_paths == 4 * 20);
    CHECK(s.contributions == 4 * 30);
    CHECK(s.states == 4 * 8.0);
    CHECK(s.luxels == 432);
    CHECK(s.seconds.film == 4 * 0.5);
    CHECK(s.seconds.total == 4 * 0.75);
    // The renderer counts its calls: 0, 1, 2, 3.
    CHECK(s.path_luminance == Approx(1.5));
    CHECK(s.health->chains == 4 * 2);
    CHECK(s.health->effective_samples == 4 * 5.0);
    CHECK(s.health->split_r_hat == 1.3);
    CHECK(s.health->luminance.standard_error == Approx(0.2 / std::sqrt(4.0)));
    CHECK(s.health->luminance.paths == 4 * 100);
}

TEST_CASE("what the scene has to say is said once, and what numbers say of all passes together") {
    const auto warnings = finished(NoiseRenderer(), {.passes = 4}).warnings;
    CHECK(std::count(warnings.begin(), warnings.end(), "a remark on the scene") == 1);
    const auto about_brightness = [](const std::string& w) {
        return w.find("the brightness of the VPLs' light is known to") == 0;
    };
    // 20 % of one pass, 0.2 / sqrt(4) / 1.5 of four: 7 %.
    REQUIRE(std::count_if(warnings.begin(), warnings.end(), about_brightness) == 1);
    CHECK(std::find_if(warnings.begin(), warnings.end(), about_brightness)->find("to 7 %") !=
          std::string::npos);
}

TEST_CASE("a bounce that some passes lack is black there") {
    NoiseRenderer renderer;
    renderer.bounces = {1, 0, 2, 1};
    const mir::RenderResult result = finished(renderer, {.passes = 4});
    REQUIRE(result.bounces.size() == 2);
    // Bounce b of any pass is b + 1.
    CHECK(result.bounces[0](3, 5) == mir::Rgb{0.75f, 0.75f, 0.75f});
    CHECK(result.bounces[1](3, 5) == mir::Rgb{0.5f, 0.5f, 0.5f});
}

TEST_CASE("a pass of another size is refused, and those before stay as they were") {
    mir::RenderSettings other = settings();
    other.image = {25, 18};
    const NoiseRenderer renderer;
    mir::PassSums sums;
    sums.add(renderer.render(scene, settings(), nullptr));
    const mir::RenderResult first = sums.result();
    CHECK_THROWS_AS(sums.add(renderer.render(scene, other, nullptr)), mir::Error);
    mir::RenderResult mixed = renderer.render(scene, settings(), nullptr);
    mixed.direct = mir::Image<mir::Rgb>(other.image);
    CHECK_THROWS_AS(sums.add(mixed), mir::Error);
    CHECK(sums.passes() == 1);
    CHECK(mirtest::same_bits(sums.result().beauty, first.beauty));
}

TEST_CASE("position and depth are those of the first pass, the VPLs those of the last") {
    const mir::RenderResult result = finished(NoiseRenderer(), {.passes = 3});
    CHECK(result.guides.depth(1, 1) == 0.0f);
    CHECK(result.guides.albedo(1, 1) == mir::Rgb{1.0f, 1.0f, 1.0f});
    REQUIRE(result.vpls.size() == 1);
    CHECK(result.vpls.vpls()[0].position.x == 2.0f);
}

TEST_CASE("the error is the standard error of the mean, relative to its brightness") {
    // By hand: pixel luminances 1, 3 in one pass and 3, 5 in the other.
    mir::LuminanceSpread spread;
    mir::Image<mir::Rgb> picture({2, 1});
    const auto add = [&](float left, float right, std::uint32_t earlier) {
        picture(0, 0) = {left, left, left};
        picture(1, 0) = {right, right, right};
        spread.add(picture, earlier);
    };
    add(1, 3, 0);
    CHECK_FALSE(spread.relative_error(1));
    add(3, 5, 1);
    // Variances 2 and 2, of the mean 1 and 1; mean luminance 3.
    CHECK(*spread.relative_error(2) == Approx(1.0 / 3.0).epsilon(1e-6));
}

TEST_CASE("equal passes have no error, and black ones that differ an infinite one") {
    mir::LuminanceSpread spread;
    mir::Image<mir::Rgb> picture({5, 3}, {0.1f, 0.2f, 0.7f});
    for (std::uint32_t i = 0; i < 3; ++i) spread.add(picture, i);
    CHECK(*spread.relative_error(3) == 0.0);
    mir::LuminanceSpread around_black;
    for (const float sign : {1.0f, -1.0f}) {
        for (mir::Rgb& p : picture.pixels()) p = {sign, sign, sign};
        around_black.add(picture, sign > 0.0f ? 0 : 1);
    }
    CHECK(*around_black.relative_error(2) == infinity);
}

// H0: the square of the estimate is the variance of one pass over n, known in closed form. z-test,
// level 1 % for both n together; seed 7.
TEST_CASE("the estimated error falls as one over the root of the passes") {
    const double variance = NoiseRenderer::variance;
    const double level = mirtest::sidak(0.01, 2);
    for (const std::uint32_t n : {4u, 64u}) {
        const double e = *finished(NoiseRenderer(), {.passes = n}).statistics.relative_error;
        // The mean brightness, in the divisor, varies too: less than a hundredth as much.
        const double pixels = 24 * 18;
        const double of_estimate = std::sqrt(
            variance * variance * (2.0 / (n - 1) + NoiseRenderer::excess_kurtosis / n) / pixels);
        const double z = (e * e * n - variance) / of_estimate;
        INFO(n << " passes: error " << e << ", z " << z);
        CHECK(std::erfc(std::fabs(z) / std::sqrt(2.0)) > level);
    }
}

// H0: the square of the estimate, times the squared brightness 1, is the mean square error of the
// picture against the expected one, on average over 200 renders. t-test, level 1 %, seeds 0..199.
TEST_CASE("the estimated error is the error") {
    mirtest::Moments difference;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const mir::RenderResult result = finished(NoiseRenderer(), {.passes = 3}, seed);
        difference.add(std::pow(*result.statistics.relative_error, 2) - mean_square_error(result));
    }
    CHECK(mirtest::mean_p_value(difference, 0.0) > 0.01);
}

TEST_CASE("a target error ends the render at the first pass that has it") {
    // 0.577 / sqrt(n) = 0.1 at n = 33.
    const mir::RenderResult result =
        finished(NoiseRenderer(), {.passes = 1000, .relative_error = 0.1});
    const std::uint32_t n = result.statistics.passes;
    CHECK(*result.statistics.relative_error <= 0.1);
    CHECK(result.statistics.complete);
    CHECK(n > 25);
    CHECK(n < 42);
    CHECK(*finished(NoiseRenderer(), {.passes = n - 1}).statistics.relative_error > 0.1);
    CHECK(finished(NoiseRenderer(), {.passes = 5, .relative_error = 0.1}).statistics.passes == 5);
}

TEST_CASE("a time limit lets one pass be, and cuts none") {
    CHECK(finished(NoiseRenderer(), {.passes = 1000, .seconds = 1e-9}).statistics.passes == 1);
    CHECK(finished(NoiseRenderer(), {.passes = 3, .seconds = 1e9}).statistics.passes == 3);
    NoiseRenderer slow;
    slow.seconds = 0.01;
    const auto passes = finished(slow, {.passes = 1000, .seconds = 0.05}).statistics.passes;
    CHECK(passes >= 1);
    CHECK(passes <= 5);
}

TEST_CASE("a cancelled pass leaves those before as they were") {
    NoiseRenderer renderer;
    mir::Monitor monitor;
    renderer.cancelled_call = 2;
    mir::ProgressiveRender render(renderer, scene, settings(), {.passes = 4}, &monitor);
    render.next_pass();
    render.next_pass();
    CHECK(monitor.passes == 1);  // done when the last one began
    CHECK_THROWS_AS(render.next_pass(), mir::Error);
    const mir::RenderResult result = render.result();
    CHECK(result.statistics.passes == 2);
    CHECK_FALSE(result.statistics.complete);
    CHECK(mirtest::same_bits(result.beauty, finished(NoiseRenderer(), {.passes = 2}).beauty));
    // And once cancelled, none begins.
    CHECK_THROWS_AS(render.next_pass(), mir::Error);
    CHECK(renderer.seeds.size() == 3);
}

TEST_CASE("goals that cannot be reached are refused") {
    for (const mir::PassGoal& bad :
         {mir::PassGoal{.passes = 0}, mir::PassGoal{.passes = mir::max_passes + 1},
          mir::PassGoal{.seconds = 0.0}, mir::PassGoal{.seconds = std::nan("")},
          mir::PassGoal{.passes = 9, .relative_error = -0.1},
          mir::PassGoal{.passes = 9, .relative_error = infinity},
          mir::PassGoal{.passes = 1, .relative_error = 0.1}})
        CHECK_THROWS_AS(mir::ProgressiveRender(NoiseRenderer(), scene, settings(), bad),
                        mir::Error);
    CHECK_THROWS_AS(mir::PassSums().result(), mir::Error);
}
