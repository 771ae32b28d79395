// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/renderer.hpp"
#include "support/same_images.hpp"

#include <chrono>
#include <span>
#include <thread>
#include <vector>

namespace mirtest {

/// A renderer whose pictures are known: grey, each pixel's luminance uniform in [0, 2) and
/// independent of all others, emission, direct and indirect a quarter, a quarter and a half of it.
/// Counts its calls in depth, albedo, the place of its VPL and P_c.
class NoiseRenderer : public mir::Renderer {
 public:
    static constexpr double variance = 1.0 / 3.0;    ///< of a pixel's luminance
    static constexpr double excess_kurtosis = -1.2;  ///< of the same

    std::vector<std::size_t> bounces;              ///< layers of bounces, call by call; then none
    std::size_t cancelled_call = ~std::size_t{0};  ///< the call during which Ctrl-C is pressed
    std::size_t earlier = 0;                       ///< calls that another object had
    double seconds = 0.0;                          ///< that a call takes
    mutable std::vector<std::uint64_t> seeds;      ///< that it was called with

    mir::RenderResult render(const mir::Scene&, const mir::RenderSettings& settings,
                             mir::Monitor* monitor) const override {
        const std::size_t call = earlier + seeds.size();
        seeds.push_back(settings.seed);
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        if (call == cancelled_call) monitor->cancelled = true;
        if (monitor != nullptr) monitor->check();
        return picture(settings, call);
    }

 private:
    [[nodiscard]] mir::RenderResult picture(const mir::RenderSettings& settings,
                                            std::size_t call) const {
        const mir::Image<mir::Rgb> black(settings.image);
        mir::RenderResult r{black, black, black,
                            black, {},    mir::Guides(settings.image),
                            {},    {},    {"a remark on the scene"}};
        for (std::size_t i = 0; i < black.pixels().size(); ++i) {
            const float y = 2.0f * mir::Random(settings.seed, mir::Stream::test, i).at(0);
            r.emission.pixels()[i] = r.direct.pixels()[i] = {0.25f * y, 0.25f * y, 0.25f * y};
            r.indirect.pixels()[i] = {0.5f * y, 0.5f * y, 0.5f * y};
            r.beauty.pixels()[i] = {y, y, y};
        }
        const auto count = static_cast<float>(call);
        for (float& depth : r.guides.depth.pixels()) depth = count;
        for (mir::Rgb& albedo : r.guides.albedo.pixels()) albedo = {count, count, count};
        mir::Vpl vpl{};
        vpl.position = {count, 0.0f, 0.0f};
        r.vpls.push_back(vpl, {});
        const std::size_t layers = call < bounces.size() ? bounces[call] : 0;
        for (std::size_t b = 0; b < layers; ++b) {
            const auto light = static_cast<float>(b + 1);
            r.bounces.emplace_back(settings.image, mir::Rgb{light, light, light});
        }
        r.statistics = statistics(settings, static_cast<double>(call));
        mir::add_result_warnings(r, r.warnings);
        return r;
    }

    static mir::RenderStatistics statistics(const mir::RenderSettings& settings, double call) {
        mir::RenderStatistics s;
        s.luxels = settings.image.area();
        s.vpls = 10;
        s.light_paths = 20;
        s.contributions = 30;
        s.states = 8.0;
        s.path_luminance = call;
        s.seconds.film = 0.5;
        s.seconds.other = 0.25;
        s.seconds.total = 0.75;
        s.health.emplace();
        s.health->chains = 2;
        s.health->mutations = 16;
        s.health->large = {8, 4};
        s.health->recorded_states = 8;
        s.health->effective_samples = 5.0;
        s.health->split_r_hat = call == 2.0 ? 1.3 : 1.1;
        s.health->luminance = {call, 0.2, 100, 90};
        s.health->large_step_luminance = {call, 0.3, 50, 40};
        return s;
    }
};

}  // namespace mirtest
