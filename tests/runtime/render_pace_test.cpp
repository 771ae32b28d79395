// SPDX-License-Identifier: MIT
#include "mir/runtime/render_pace.hpp"

#include "support/catch.hpp"

using mir::RenderPace;
using mir::RenderWork;
using mirtest::Approx;

namespace {

/// A picture of `bands` bands: two seconds of direct light and three of VPLs each, looked at every
/// tenth of a second.
template <class See>
void play(std::uint32_t bands, const See& see) {
    RenderPace pace;
    RenderWork work;
    work.bands = bands;
    work.all_units = 30u * bands;
    for (std::uint32_t tick = 1; tick <= 50 * bands; ++tick) {
        work.begun_bands = (tick - 1) / 50 + 1;
        const std::uint32_t in_band = (tick - 1) % 50 + 1;
        work.units = 30 * (work.begun_bands - 1) + (in_band > 20 ? in_band - 20 : 0);
        pace.look(work, 0.1 * tick);
        see(pace, 0.1 * tick, 5.0 * bands - 0.1 * tick);
    }
}

}  // namespace

TEST_CASE("no time left is told while only direct light was measured") {
    play(1, [](const RenderPace& pace, double seconds, double) {
        CHECK(pace.seconds_left().has_value() == (seconds > 2.05));
    });
}

TEST_CASE("the time left is that of a render whose stages go on as they began") {
    const auto bands = GENERATE(1u, 4u);
    play(bands, [](const RenderPace& pace, double, double left) {
        if (!pace.seconds_left()) return;
        CHECK(*pace.seconds_left() + 1.0 == Approx(left + 1.0).epsilon(0.02));
        CHECK(pace.rate() == Approx(10.0).epsilon(0.01));
    });
}

TEST_CASE("the work of a monitor is its contributions, or its gathers where discs light") {
    mir::Monitor monitor;
    CHECK_FALSE(mir::work_of(monitor).unit_share());
    CHECK_FALSE(mir::work_of(monitor).stage_share());
    monitor.planned_contributions = 8;
    monitor.contributions = 2;
    CHECK(mir::work_of(monitor).unit_share() == 0.25);
    monitor.looping_contributions = 4;
    CHECK(mir::work_of(monitor).unit_share() == 0.25);
    monitor.begin_loop(4);
    monitor.blocks = 3;
    CHECK(mir::work_of(monitor).unit_share() == 0.625);
    monitor.planned_gathers = 4;
    monitor.gathers = 3;
    CHECK(mir::work_of(monitor).unit_share() == 0.75);
    CHECK(mir::work_of(monitor).unit == std::string("gathers"));
    monitor.begin_loop(10);
    monitor.blocks = 5;
    CHECK(mir::work_of(monitor).stage_share() == 0.5);
    monitor.begin_pass(1);
    CHECK_FALSE(mir::work_of(monitor).unit_share());
}
