// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/moved_luxel.hpp"
#include "mir/runtime/pass_goal.hpp"
#include "mir/runtime/pass_seed.hpp"
#include "mir/runtime/pass_sums.hpp"
#include "mir/runtime/renderer.hpp"
#include "mir/sampling/vsl_radii.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

namespace mir {

/// A picture that gets better pass by pass. Each pass is a whole render with random numbers of
/// its own (pass_seed()): other luxels, other VPLs, other light samples; the picture is the mean.
/// Where a pixel has one luxel, that moves evenly through it (moved_luxel()). The variance falls as
/// one over the number of passes; the spheres of virtual spherical lights shrink from pass to pass
/// (vsl_radius_share()). Passes share what the bound removes: 16 passes of 256 VPLs lose more light
/// than one of 4096. Each pass builds everything again, the acceleration structure and the G-buffer
/// too. One thread at a time.
class ProgressiveRender {
 public:
    /// Starts the clock of the goal. `renderer`, `scene` and `monitor`, which may be null, must
    /// outlive it. `done` are passes of the same scene and settings that were rendered earlier.
    /// @throws Error(invalid_argument) for a goal that cannot be reached.
    ProgressiveRender(const Renderer& renderer, const Scene& scene, RenderSettings settings,
                      const PassGoal& goal, Monitor* monitor = nullptr, PassSums done = {})
        : renderer_(renderer),
          scene_(scene),
          settings_(std::move(settings)),
          seed_(settings_.seed),
          vsl_scale_(settings_.vsl.scale),
          only_luxel_(settings_.only_luxel),
          goal_(goal),
          monitor_(monitor),
          sums_(std::move(done)) {
        goal_.validate();
        look_at_goal();
    }

    /// True when the goal was reached at the end of the last pass.
    [[nodiscard]] bool is_complete() const { return complete_; }

    /// Renders one more pass, whatever the goal.
    /// @throws Error as Renderer::render(), Error(cancelled) too: then it is as it was before.
    void next_pass() {
        if (monitor_ != nullptr) {
            monitor_->check();
            monitor_->begin_pass(sums_.passes());
        }
        settings_.seed = pass_seed(seed_, sums_.passes());
        const Vec2 place = moved_luxel({only_luxel_.x, only_luxel_.y}, sums_.passes());
        settings_.only_luxel = {place.x, place.y};
        settings_.vsl.scale = vsl_scale_ * static_cast<float>(vsl_radius_share(sums_.passes()));
        sums_.add(renderer_.render(scene_, settings_, monitor_));
        look_at_goal();
    }

    /// The passes done.
    [[nodiscard]] const PassSums& sums() const { return sums_; }

    /// The picture so far, of at least one pass; says whether it is complete.
    [[nodiscard]] RenderResult result() const { return sums_.result(complete_); }

 private:
    using Clock = std::chrono::steady_clock;

    void look_at_goal() {
        const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
        complete_ =
            goal_.is_reached(sums_.passes(), elapsed,
                             goal_.relative_error > 0.0 ? sums_.relative_error() : std::nullopt);
    }

    const Renderer& renderer_;
    const Scene& scene_;
    RenderSettings settings_;
    std::uint64_t seed_;
    float vsl_scale_;
    PixelPlace only_luxel_;
    PassGoal goal_;
    Monitor* monitor_;
    PassSums sums_;
    Clock::time_point start_ = Clock::now();
    bool complete_ = false;
};

}  // namespace mir
