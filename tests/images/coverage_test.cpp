// SPDX-License-Identifier: MIT
//
// The alpha of pictures: what of a pixel is surface, through the filter of the beauty.
#include "images/black_box.hpp"
#include "images/support.hpp"
#include "mir/runtime/pass_sums.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

using namespace mirtest;
using mir::Integrator;
using mir::RenderResult;
using mir::RenderSettings;
using mir::Rgb;

namespace {

RenderSettings settings_for(Integrator integrator, mir::FilterKind filter) {
    RenderSettings s = small_settings(24, 16);
    s.backend = mir::BackendKind::cpu;
    s.integrator = integrator;
    s.filter = mir::default_filter(filter);
    s.luxels_per_pixel = 16;
    s.path.samples = 1;
    s.micro.surfels = 256;
    return s;
}

double largest_gap(const RenderResult& r) {
    double gap = 0.0;
    for (std::size_t i = 0; i < r.beauty.pixels().size(); ++i) {
        const double shown = r.beauty.pixels()[i].g;
        const double uncovered = 1.0 - static_cast<double>(r.coverage.pixels()[i]);
        gap = std::max(gap, std::fabs(shown - std::clamp(uncovered, 0.0, 1.0)));
    }
    return gap;
}

std::size_t pixels_at_edges(const mir::Image<float>& coverage) {
    return static_cast<std::size_t>(std::count_if(coverage.pixels().begin(),
                                                  coverage.pixels().end(),
                                                  [](float a) { return a > 0.05f && a < 0.95f; }));
}

}  // namespace

TEST_CASE("alpha is what the background does not show through, by every integrator and filter") {
    const mir::Scene scene = black_box();
    const auto filter = GENERATE(mir::FilterKind::box, mir::FilterKind::gaussian);
    for (const Integrator integrator : {Integrator::vpl, Integrator::path, Integrator::micro}) {
        const RenderResult r = render(scene, settings_for(integrator, filter));
        CAPTURE(static_cast<int>(integrator), static_cast<int>(filter));
        CHECK(largest_gap(r) < 1e-6);
        CHECK(pixels_at_edges(r.coverage) > 20);
        CHECK(r.coverage(12, 12) == 1.0f);
        CHECK(r.coverage(0, 0) == 0.0f);
    }
}

TEST_CASE("alpha stays within 0 and 1 where a filter has negative lobes") {
    const RenderResult r =
        render(black_box(), settings_for(Integrator::vpl, mir::FilterKind::lanczos));
    const auto [least, most] =
        std::minmax_element(r.coverage.pixels().begin(), r.coverage.pixels().end());
    CHECK(*least == 0.0f);
    CHECK(*most == 1.0f);
    CHECK(pixels_at_edges(r.coverage) > 20);
}

TEST_CASE("alpha of several passes is their mean") {
    const mir::Scene scene = black_box();
    RenderSettings s = settings_for(Integrator::vpl, mir::FilterKind::box);
    s.luxels_per_pixel = 2;
    mir::PassSums sums;
    for (const std::uint64_t seed : {1, 2, 3}) {
        s.seed = seed;
        sums.add(render(scene, s));
    }
    const RenderResult mean = sums.result();
    CHECK(largest_gap(mean) < 1e-6);
    // One pass has halves alone.
    const auto is_of_several = [](float a) {
        return std::fabs(2.0f * a - std::round(2.0f * a)) > 0.1f;
    };
    CHECK(std::any_of(mean.coverage.pixels().begin(), mean.coverage.pixels().end(), is_of_several));
}
