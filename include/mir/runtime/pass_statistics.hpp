// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/runtime/result.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mir {

namespace detail {

/// Mean of `count` numbers and one more.
inline double mean_with(double mean, double next, std::uint32_t count) {
    return mean + (next - mean) / (count + 1.0);
}

/// Estimates of one P_c from independent paths: their mean and its standard error.
inline void add_pass(PathLuminance& all, const PathLuminance& pass, std::uint32_t earlier) {
    all.mean = mean_with(all.mean, pass.mean, earlier);
    all.standard_error =
        std::hypot(all.standard_error * earlier, pass.standard_error) / (earlier + 1.0);
    all.paths += pass.paths;
    all.contributing += pass.contributing;
}

/// Independent estimates of one share.
inline void add_pass(std::optional<ShareEstimate>& all, const std::optional<ShareEstimate>& pass,
                     std::uint32_t earlier) {
    if (!all || !pass) return all.reset();
    all->share = mean_with(all->share, pass->share, earlier);
    all->standard_error =
        std::hypot(all->standard_error * earlier, pass->standard_error) / (earlier + 1.0);
}

/// Independent estimates of one difference; the spread stays that of one pass.
inline void add_pass(std::optional<LightDifference>& all,
                     const std::optional<LightDifference>& pass, std::uint32_t earlier) {
    if (!all || !pass) return all.reset();
    all->mean = mean_with(all->mean, pass->mean, earlier);
    all->spread = mean_with(all->spread, pass->spread, earlier);
    all->standard_error =
        std::hypot(all->standard_error * earlier, pass->standard_error) / (earlier + 1.0);
}

inline void add_pass(ChainHealth& all, const ChainHealth& pass, std::uint32_t earlier) {
    all.add(pass);
    all.chains += pass.chains - 1;  // that pass counts as one there
    all.distinct_vpls += pass.distinct_vpls;
    all.effective_samples += pass.effective_samples;
    all.split_r_hat = std::max(all.split_r_hat, pass.split_r_hat);
    add_pass(all.luminance, pass.luminance, earlier);
    add_pass(all.large_step_luminance, pass.large_step_luminance, earlier);
}

}  // namespace detail

/// Adds the numbers of one more pass to those of `earlier` >= 1 passes. What counts or lasts adds
/// up, shares and luminances become means, what is the same in every pass stays.
inline void add_pass(RenderStatistics& all, const RenderStatistics& pass, std::uint32_t earlier) {
    constexpr std::uint32_t most_vpls = 0x7fffffff;  // what an attribute of a picture holds
    all.vpls =
        all.vpls < most_vpls - std::min(pass.vpls, most_vpls) ? all.vpls + pass.vpls : most_vpls;
    all.light_paths += pass.light_paths;
    all.camera_paths += pass.camera_paths;
    all.contributions += pass.contributions;
    all.residual_paths += pass.residual_paths;
    all.caustic_paths += pass.caustic_paths;
    all.states += pass.states;
    for (double RenderStatistics::*mean :
         {&RenderStatistics::path_luminance, &RenderStatistics::dropped_share,
          &RenderStatistics::indirect_luminance, &RenderStatistics::removed_luminance,
          &RenderStatistics::residual_luminance, &RenderStatistics::caustic_luminance,
          &RenderStatistics::caustic_direct_luminance, &RenderStatistics::vsl_radius})
        all.*mean = detail::mean_with(all.*mean, pass.*mean, earlier);
    for (float RenderStatistics::*share :
         {&RenderStatistics::non_lambertian_share, &RenderStatistics::widened_share})
        all.*share = static_cast<float>(detail::mean_with(
            static_cast<double>(all.*share), static_cast<double>(pass.*share), earlier));
    detail::add_pass(all.removed, pass.removed, earlier);
    detail::add_pass(all.cut, pass.cut, earlier);
    // That of one pass would be less than all of them leave, the mean of all would be more.
    for (std::optional<double> RenderStatistics::*error :
         {&RenderStatistics::direct_noise, &RenderStatistics::direct_error,
          &RenderStatistics::residual_error, &RenderStatistics::caustic_error})
        if (all.*error && pass.*error)
            all.*error = std::hypot(earlier * *(all.*error), *(pass.*error)) / (earlier + 1.0);
    if (pass.faint_caustics)
        all.faint_caustics = std::max(all.faint_caustics.value_or(0.0), *pass.faint_caustics);
    detail::add_pass(all.gather_difference, pass.gather_difference, earlier);
    if (all.light_path_luminance && pass.light_path_luminance)
        detail::add_pass(*all.light_path_luminance, *pass.light_path_luminance, earlier);
    if (all.health && pass.health) detail::add_pass(*all.health, *pass.health, earlier);
    add_seconds(all.seconds, pass.seconds);
    all.passes = earlier + 1;
}

}  // namespace mir
