// SPDX-License-Identifier: MIT
#include "mir/render.hpp"

#include "images/support.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

#include <array>
#include <optional>
#include <thread>

namespace {

mir::RenderSettings quick_settings() {
    mir::RenderSettings s = mirtest::small_settings(24, 16);
    s.backend = mir::BackendKind::cpu;
    s.seed = 5;
    return s;
}

/// The code of the error that mir::render throws; none where it renders.
std::optional<mir::ErrorCode> error_of(const mir::Scene& scene, const mir::RenderSettings& settings,
                                       mir::Monitor* monitor = nullptr) {
    try {
        static_cast<void>(mir::render(scene, settings, monitor));
    } catch (const mir::Error& e) {
        return e.code();
    }
    return std::nullopt;
}

}  // namespace

TEST_CASE("mir::render gives the bytes of the renderer that a Registry gives by name") {
    const mir::Scene scene = mir::builtin::make("sphere");
    mir::Registry registry;
    mir::add_all_to(registry);
    for (const char* scheduler : {"", "cpu", "cpu-blocks"}) {
        INFO("scheduler '" << scheduler << "'");
        mir::RenderSettings s = quick_settings();
        s.scheduler = scheduler;
        const mir::RenderResult wanted =
            registry.make(s.backend, scheduler)->render(scene, s, nullptr);
        const mir::RenderResult got = mir::render(scene, s);
        CHECK(mirtest::mean_luminance(got.beauty) > 0.0);
        CHECK(mirtest::same_bits(got.beauty, wanted.beauty));
        CHECK(mirtest::same_bits(got.direct, wanted.direct));
        CHECK(mirtest::same_bits(got.indirect, wanted.indirect));
        CHECK(got.statistics.backend == wanted.statistics.backend);
        CHECK(got.statistics.scheduler == wanted.statistics.scheduler);
        CHECK(got.warnings == wanted.warnings);
    }
}

TEST_CASE("mir::render chooses as a Registry does where the settings leave it open") {
    const mir::Scene scene = mir::builtin::make("sphere");
    mir::Registry registry;
    mir::add_all_to(registry);
    mir::RenderSettings s = quick_settings();
    s.backend = mir::BackendKind::automatic;
    const mir::Registry::Choice choice = registry.make_for(s);
    const mir::RenderResult wanted = choice.renderer->render(scene, s, nullptr);
    const mir::RenderResult got = mir::render(scene, s);
    CHECK(mirtest::same_bits(got.beauty, wanted.beauty));
    CHECK(got.statistics.backend == wanted.statistics.backend);
    CHECK(got.warnings.size() == choice.remarks.size() + wanted.warnings.size());
}

TEST_CASE("mir::render hands every error to its caller") {
    const mir::Scene scene = mir::builtin::make("sphere");
    mir::RenderSettings s = quick_settings();
    CHECK_FALSE(error_of(scene, s));

    s.vpls = 0;
    CHECK(error_of(scene, s) == mir::ErrorCode::invalid_argument);
    s = quick_settings();
    s.image = {1u << 20, 1u << 20};
    CHECK(error_of(scene, s) == mir::ErrorCode::limit_exceeded);
    s = quick_settings();
    s.scheduler = "warp";
    CHECK(error_of(scene, s) == mir::ErrorCode::unsupported);
    CHECK(error_of(mir::Scene{}, quick_settings()));

    mir::Monitor monitor;
    monitor.cancelled = true;
    CHECK(error_of(scene, quick_settings(), &monitor) == mir::ErrorCode::cancelled);
    // In its first loop, which places triangles.
    CHECK(monitor.planned_blocks > 0);
    CHECK(monitor.blocks == 0);
}

TEST_CASE("a monitor sees what mir::render did") {
    mir::Monitor monitor;
    const mir::RenderResult result =
        mir::render(mir::builtin::make("sphere"), quick_settings(), &monitor);
    CHECK(monitor.contributions >= result.statistics.contributions);
    CHECK(monitor.contributions == monitor.planned_contributions);
}

TEST_CASE("one Renderer renders on several threads at once, and each gets the bytes of one alone") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::Registry registry;
    mir::add_all_to(registry);
    const auto renderer = registry.make(mir::BackendKind::cpu, "");
    std::array<mir::RenderSettings, 4> settings;
    std::array<std::optional<mir::RenderResult>, 4> together;
    std::array<std::thread, 4> threads;
    for (std::uint32_t i = 0; i < 4; ++i) {
        settings[i] = quick_settings();
        settings[i].seed = i;
        settings[i].integrator = i == 3 ? mir::Integrator::path : mir::Integrator::vpl;
        threads[i] =
            std::thread([&, i] { together[i] = renderer->render(scene, settings[i], nullptr); });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::uint32_t i = 0; i < 4; ++i)
        CHECK(mirtest::same_bits(together[i]->beauty,
                                 renderer->render(scene, settings[i], nullptr).beauty));
}
