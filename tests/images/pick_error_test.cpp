// SPDX-License-Identifier: MIT
//
// The layer of the error of picks: what gathering few VPLs of many leaves in a pixel.
#include "images/support.hpp"
#include "mir/runtime/pass_sums.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <algorithm>
#include <cmath>

using namespace mirtest;
using mir::RenderResult;
using mir::RenderSettings;

namespace {

RenderSettings cuts(mir::FilterKind filter, std::uint32_t luxels) {
    RenderSettings s = small_settings(32, 4000);
    s.luxels_per_pixel = luxels;
    s.filter = mir::default_filter(filter);
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.bound.kind = mir::BoundPolicy::Kind::automatic;
    s.direct_samples = 1;
    s.sum = mir::LightSum::cuts;
    s.picks = 32;
    s.pick_error_layer = true;
    s.backend = mir::BackendKind::cpu;
    return s;
}

/// Share of lit pixels whose light lies within two standard errors of that of all their VPLs.
double covered(const RenderResult& r, const mir::Image<mir::Rgb>& all, double scale = 1.0) {
    double lit = 0.0;
    double inside = 0.0;
    for (std::size_t i = 0; i < all.pixels().size(); ++i) {
        const auto truth = static_cast<double>(luminance(all.pixels()[i]));
        if (truth <= 0.0) continue;
        const double d = static_cast<double>(luminance(r.indirect.pixels()[i])) - truth;
        const double bar = 2.0 * scale * static_cast<double>(r.pick_error.pixels()[i]);
        ++lit;
        inside += std::fabs(d) <= bar + 1e-5 * truth ? 1.0 : 0.0;
    }
    return inside / lit;
}

/// Light of the settings' VPLs at the settings' luxels, of all of them.
mir::Image<mir::Rgb> of_all(const mir::Scene& scene, RenderSettings s) {
    s.sum = mir::LightSum::all;
    s.pick_error_layer = false;
    return render(scene, s).indirect;
}

}  // namespace

// H0: at least 95 % of the pixels lie within two standard errors of the sum over all VPLs, in the
// mean over 12 seeds; rejected where the mean lies below by 2.7 of its own standard errors (t,
// level 1 %, one-sided). A bar half as wide is rejected.
TEST_CASE("two standard errors of picks cover 95 % of the pixels at least", "[statistical]") {
    const mir::Scene scene = mir::builtin::make(GENERATE("cornell-box", "door-ajar"));
    const auto filter = GENERATE(mir::FilterKind::box, mir::FilterKind::gaussian);
    RenderSettings s = cuts(filter, GENERATE(1u, 4u));
    Moments whole;
    Moments half;
    for (s.seed = 0; s.seed < 12; ++s.seed) {
        const mir::Image<mir::Rgb> all = of_all(scene, s);
        const RenderResult r = render(scene, s);
        whole.add(covered(r, all));
        half.add(covered(r, all, 0.5));
    }
    CAPTURE(s.luxels_per_pixel, static_cast<int>(filter), whole.mean(), half.mean());
    CHECK(whole.mean() + 2.7 * whole.standard_error() > 0.95);
    CHECK(half.mean() + 2.7 * half.standard_error() < 0.95);
}

TEST_CASE("the layer of the error of picks changes no other, whatever threads and tiles") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    RenderSettings s = cuts(mir::FilterKind::box, 4);
    const RenderResult wanted = render(scene, s);
    CHECK(*std::max_element(wanted.pick_error.pixels().begin(), wanted.pick_error.pixels().end()) >
          0.0f);
    RenderSettings other = s;
    other.threads = 3;
    other.tile = {64, 16};
    other.scheduler = "cpu";
    CHECK(same_bits(render(scene, other).pick_error, wanted.pick_error));
    s.pick_error_layer = false;
    const RenderResult without = render(scene, s);
    CHECK(without.pick_error.pixels().empty());
    CHECK(same_bits(without.indirect, wanted.indirect));
    CHECK(same_bits(without.beauty, wanted.beauty));
}

TEST_CASE("layers of bounces have an error of picks together") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    RenderSettings s = cuts(mir::FilterKind::box, 4);
    s.bounce_layers = true;
    const RenderResult r = render(scene, s);
    CHECK(r.pick_error.extent() == s.image);
    CHECK(covered(r, of_all(scene, s)) > 0.95);
}

TEST_CASE("over passes the error of picks is that of their mean") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    RenderSettings s = cuts(mir::FilterKind::box, 1);
    mir::PassSums sums;
    sums.add(render(scene, s));
    const float one = render(scene, s).pick_error(16, 16);
    CHECK(same_bits(sums.result().pick_error, render(scene, s).pick_error));
    ++s.seed;
    const float two = render(scene, s).pick_error(16, 16);
    sums.add(render(scene, s));
    CHECK(sums.result().pick_error(16, 16) == Approx(std::hypot(one, two) / 2.0f));
}

TEST_CASE("where luxels gather all VPLs there is no error of picks") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    RenderSettings s = cuts(mir::FilterKind::box, 1);
    s.vpls = 50;
    s.picks = 5000;  // more than there are
    const RenderResult r = render(scene, s);
    const mir::Image<mir::Rgb> all = of_all(scene, s);
    for (std::size_t i = 0; i < all.pixels().size(); ++i) {
        CHECK(r.pick_error.pixels()[i] == 0.0f);
        CHECK(luminance(r.indirect.pixels()[i]) ==
              Approx(luminance(all.pixels()[i])).epsilon(1e-5));
    }
    s.sum = mir::LightSum::all;
    CHECK_THROWS_AS(render(scene, s), mir::Error);
    s.sum = mir::LightSum::cuts;
    s.integrator = mir::Integrator::path;
    CHECK_THROWS_AS(render(scene, s), mir::Error);
}
