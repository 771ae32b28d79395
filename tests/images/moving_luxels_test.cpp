// SPDX-License-Identifier: MIT
//
// Passes whose pixels have one luxel each: it moves, so that their mean sees edges smoothly.
#include "images/black_box.hpp"
#include "images/support.hpp"
#include "mir/film/moved_luxel.hpp"
#include "mir/runtime/progressive_render.hpp"
#include "support/catch.hpp"

#include <cmath>

using namespace mirtest;
using mir::Image;
using mir::RenderSettings;
using mir::Rgb;

namespace {

RenderSettings one_luxel(mir::Integrator integrator = mir::Integrator::vpl) {
    RenderSettings s = small_settings(24, 4);
    s.backend = mir::BackendKind::cpu;
    s.integrator = integrator;
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.path.samples = 1;
    s.micro.surfels = 64;
    s.seed = 5;
    return s;
}

mir::RenderResult passes(const mir::Scene& scene, const RenderSettings& s, std::uint32_t count,
                         mir::PassSums done = {}) {
    mir::Registry registry;
    mir::add_cpu_to(registry);
    const auto renderer = registry.make(s.backend, s.scheduler);
    mir::ProgressiveRender render(*renderer, scene, s, {.passes = count}, nullptr, std::move(done));
    while (!render.is_complete()) render.next_pass();
    return render.result();
}

/// What of each pixel is surface, by 16 renders of 64 luxels.
Image<float> true_coverage(const mir::Scene& scene) {
    RenderSettings s = one_luxel();
    s.luxels_per_pixel = 64;
    return passes(scene, s, 16).coverage;
}

/// Root of the mean square difference over the pixels with an edge in them.
double edge_error(const Image<float>& found, const Image<float>& truth) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
        const float wanted = truth.pixels()[i];
        if (wanted < 0.02f || wanted > 0.98f) continue;
        sum += std::pow(static_cast<double>(found.pixels()[i] - wanted), 2);
        ++count;
    }
    REQUIRE(count > 20);
    return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE("the edge of a black box under a white sky converges to its coverage over passes") {
    const mir::Scene scene = black_box();
    const Image<float> truth = true_coverage(scene);
    for (const mir::Integrator integrator :
         {mir::Integrator::vpl, mir::Integrator::path, mir::Integrator::micro}) {
        const RenderSettings s = one_luxel(integrator);
        const mir::RenderResult many = passes(scene, s, 64);
        CAPTURE(static_cast<int>(integrator));
        CHECK(edge_error(passes(scene, s, 4).coverage, truth) < 0.2);
        CHECK(edge_error(many.coverage, truth) < 0.03);
        for (std::size_t i = 0; i < many.beauty.pixels().size(); ++i)
            CHECK(many.beauty.pixels()[i].g ==
                  Approx(1.0f - many.coverage.pixels()[i]).margin(1e-5));
    }
}

TEST_CASE("luxels that stay where they are never see an edge") {
    const mir::Scene scene = black_box();
    RenderSettings s = one_luxel();
    mir::PassSums sums;
    for (std::uint64_t pass = 0; pass < 16; ++pass) {
        s.seed = mir::pass_seed(5, pass);
        sums.add(render(scene, s));
    }
    CHECK(edge_error(sums.result().coverage, true_coverage(scene)) > 0.25);
}

TEST_CASE("passes of one luxel are renders of the luxel moved, whatever filter") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    RenderSettings s = one_luxel();
    s.filter = mir::default_filter(GENERATE(mir::FilterKind::box, mir::FilterKind::lanczos));
    const mir::RenderResult two = passes(scene, s, 2);
    const mir::RenderResult first = render(scene, s);
    s.seed = mir::pass_seed(s.seed, 1);
    const mir::Vec2 moved = mir::moved_luxel({0.5f, 0.5f}, 1);
    s.only_luxel = {moved.x, moved.y};
    const mir::RenderResult second = render(scene, s);
    CHECK_FALSE(same_bits(first.emission, second.emission));
    for (std::size_t i = 0; i < two.emission.pixels().size(); ++i)
        CHECK(two.emission.pixels()[i].g ==
              static_cast<float>(
                  (double{first.emission.pixels()[i].g} + double{second.emission.pixels()[i].g}) /
                  2.0));
}

TEST_CASE("luxels move alike for any threads and tiles, and where passes go on from earlier ones") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    const RenderSettings s = one_luxel();
    const mir::RenderResult wanted = passes(scene, s, 3);
    RenderSettings other = s;
    other.threads = 3;
    other.tile = {16, 32};
    other.scheduler = "cpu";
    CHECK(same_bits(passes(scene, other, 3).beauty, wanted.beauty));
    mir::PassSums two;
    for (std::uint64_t pass = 0; pass < 2; ++pass) {
        other.seed = mir::pass_seed(s.seed, pass);
        const mir::Vec2 place = mir::moved_luxel({0.5f, 0.5f}, pass);
        other.only_luxel = {place.x, place.y};
        two.add(render(scene, other));
    }
    const mir::RenderResult resumed = passes(scene, s, 3, std::move(two));
    CHECK(same_bits(resumed.beauty, wanted.beauty));
}

TEST_CASE("a luxel outside of its pixel is refused") {
    RenderSettings s = one_luxel();
    for (const float bad : {0.0f, 1.0f, -0.5f, std::nanf("")}) {
        s.only_luxel = {0.5f, bad};
        CHECK_THROWS_AS(s.validate(), mir::Error);
    }
}
