// SPDX-License-Identifier: MIT
#include "mir/runtime/stage_clock.hpp"

#include "support/catch.hpp"

#include <thread>

using mir::StageSeconds;

namespace {

/// Lets at least so much time pass.
void pass(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

}  // namespace

TEST_CASE("a stage inside another interrupts it, and what none claims is other") {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    mir::StageClock clock;
    pass(2);
    {
        const auto outer = clock.measure(&StageSeconds::sampling);
        pass(3);
        {
            const auto inner = clock.measure(&StageSeconds::build);
            pass(20);
        }
        pass(4);
    }
    const StageSeconds s = clock.seconds();
    const double all = std::chrono::duration<double>(Clock::now() - begin).count();
    CHECK(s.other >= 0.002);
    CHECK(s.build >= 0.020);
    CHECK(s.sampling >= 0.007);
    CHECK(s.sampling <= all - s.build - s.other + 1e-9);
    CHECK(s.film == 0.0);
    CHECK(s.total <= all);
}

TEST_CASE("stages add up to the total, and a second look counts on") {
    mir::StageClock clock;
    {
        const auto stage = clock.measure(&StageSeconds::film);
        pass(1);
    }
    const StageSeconds first = clock.seconds();
    pass(1);
    const StageSeconds second = clock.seconds();
    CHECK(first.total == Approx(first.film + first.other));
    CHECK(second.film == first.film);
    CHECK(second.other >= first.other + 0.001);
    double sum = 0.0;
    for (const mir::RenderStage& stage : mir::render_stages) sum += second.*stage.seconds;
    CHECK(second.total == sum);
}

TEST_CASE("seconds that were measured by themselves change their stage, not the total") {
    mir::StageClock clock;
    {
        const auto stage = clock.measure(&StageSeconds::sampling);
        pass(3);
    }
    clock.reassign(0.002, &StageSeconds::sampling, &StageSeconds::bootstrap);
    const StageSeconds s = clock.seconds();
    CHECK(s.bootstrap == 0.002);
    CHECK(s.sampling >= 0.001 - 1e-12);
    CHECK(s.total == Approx(s.bootstrap + s.sampling + s.other));
}

TEST_CASE("stages of other threads are part of what the clock's own thread does") {
    mir::StageClock clock;
    {
        const auto own = clock.measure(&StageSeconds::film);
        std::thread([&] {
            const auto beside = clock.measure(&StageSeconds::build);
            pass(5);
        }).join();
    }
    const StageSeconds s = clock.seconds();
    CHECK(s.build == 0.0);
    CHECK(s.film >= 0.005);
    std::thread([&] {
        clock.follow_this_thread();
        const auto own = clock.measure(&StageSeconds::build);
        pass(2);
    }).join();
    CHECK(clock.seconds().build >= 0.002);
}
