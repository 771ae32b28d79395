// SPDX-License-Identifier: MIT
// Standard errors that the light budget tells, against the spread of pictures of other seeds.
#include "mir/runtime/pass_statistics.hpp"
#include "support.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <cmath>

using namespace mirtest;
using mir::RenderResult;
using mir::RenderSettings;
using mir::RowLuminances;

namespace {

constexpr int pictures = 24;

/// Of 24 pictures: spread of the mean luminance, and root mean square of its error as told.
struct Errors {
    double seen = 0.0;
    double told = 0.0;
    double mean = 0.0;
};

Errors errors_of(const mir::Scene& scene, RenderSettings s, double RowLuminances::*of,
                 std::optional<double> mir::RenderStatistics::*error) {
    Moments means;
    double squares = 0.0;
    for (int i = 0; i < pictures; ++i) {
        s.seed = 700 + static_cast<std::uint64_t>(i);
        const RenderResult r = render(scene, s);
        double sum = 0.0;
        for (const RowLuminances& row : r.luminances) sum += row.*of;
        means.add(sum / static_cast<double>(r.statistics.luxels));
        squares += std::pow((r.statistics.*error).value(), 2.0);
    }
    return {std::sqrt(means.variance()), std::sqrt(squares / pictures), means.mean()};
}

// H0: what is told is the spread or more. (n - 1) seen^2 / told^2 of 24 pictures is above 41.6 with
// probability 1 % where they are equal, seeds 700 to 723. What is told may count the picture's own
// edges as noise, but is of use: at most six times the spread.
void check(const Errors& e) {
    CAPTURE(e.seen, e.told, e.mean);
    CHECK(e.mean > 0.0);
    CHECK((pictures - 1) * e.seen * e.seen < 41.6 * e.told * e.told);
    CHECK(e.told < 6.0 * e.seen);
}

RenderSettings usual() {
    RenderSettings s = small_settings(48, 64);
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.luxels_per_pixel = 4;
    s.caustics = 0;
    return s;
}

}  // namespace

TEST_CASE("direct light has the error that is told, or less", "[statistical]") {
    RenderSettings s = usual();
    s.direct_samples = 1;
    check(errors_of(mir::builtin::make("cornell-box"), s, &RowLuminances::direct,
                    &mir::RenderStatistics::direct_error));
}

TEST_CASE("caustics have the error that is told, or less", "[statistical]") {
    RenderSettings s = usual();
    s.caustics = 1;
    const char* const name = GENERATE("caustics", "glass-room");
    CAPTURE(name);
    check(errors_of(mir::builtin::make(name), s, &RowLuminances::caustic,
                    &mir::RenderStatistics::caustic_error));
}

TEST_CASE("light that is traced back has the error that is told, or less", "[statistical]") {
    RenderSettings s = usual();
    s.compensate = 1;
    s.bound = {mir::BoundPolicy::Kind::fixed, 1.0f};
    check(errors_of(mir::builtin::make("cornell-box"), s, &RowLuminances::residual,
                    &mir::RenderStatistics::residual_error));
}

TEST_CASE("the mean of several pictures has a smaller error") {
    RenderSettings s = usual();
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderStatistics all = render(scene, s).statistics;
    const double of_one = all.direct_error.value();
    for (std::uint32_t pass = 1; pass < 4; ++pass) add_pass(all, render(scene, s).statistics, pass);
    CHECK(all.direct_error.value() == Approx(0.5 * of_one));
}
