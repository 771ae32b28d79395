// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/limits.hpp"
#include "mir/data/vpl_record.hpp"
#include "mir/sampling/light_path_options.hpp"
#include "mir/sampling/survivor_counts.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/surface_table.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

/// Refuses options of instant radiosity that are out of range.
/// @throws Error(invalid_argument); Error(limit_exceeded) for more VPLs than `limits` allows.
inline void check_light_paths(const InstantRadiosityOptions& options, const Limits& limits) {
    expects(options.vpls > 0,
            "0 VPLs were asked for (there would be no light); ask for at least 1, 256 is usual");
    expects(options.max_bounce >= 1 && options.max_bounce < 255,
            "the largest bounce must be 1 to 254");
    check_limit(options.vpls, limits.vpls, "vpls");
}

namespace detail {

/// Particles of each level, from the mean reflectance of the scene.
template <Bsdf B>
SurvivorCounts level_counts(const InstantRadiosityOptions& options, const WorldGeometry& geometry,
                            const SurfaceTable<B>& surfaces) {
    double area = 0.0;
    double reflected = 0.0;
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
        const double a = geometry.area(t);
        area += a;
        reflected += a * surfaces.mean_albedo(geometry.material_of(t));
    }
    const double rho = area > 0.0 ? reflected / area : 0.0;
    // The lamp is level 0 and bounce 1.
    const auto max_level = static_cast<std::uint8_t>(options.max_bounce - 1);
    return SurvivorCounts::for_total(options.vpls, rho, max_level, options.emitter_vpls);
}

/// Paths that bring about so many records, by a pilot run.
template <class Machine>
std::uint64_t paths_for_target(std::uint32_t vpls, Machine& machine) {
    constexpr std::uint64_t pilot_paths = 4096;
    const std::uint64_t records = machine.count(pilot_paths);
    // Nothing hit at all: the target cannot be met, so the count of paths is the target itself.
    const double per_path =
        records == 0 ? 1.0 : static_cast<double>(records) / static_cast<double>(pilot_paths);
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(vpls / per_path)));
}

}  // namespace detail

/// The records of light paths that a machine traces: all of instant radiosity but the tracing. The
/// number of paths is fixed beforehand, so that nothing depends on where the count of VPLs happens
/// to stop: by a pilot run with numbers of its own for roulette, from the mean reflectance for
/// levels. The number of records therefore only comes close to options.vpls.
///
/// `machine.count(n)` is the number of records of the first n paths of Stream::pilot.
/// `machine.trace(levels, out)` fills records and arrivals of the first out.paths paths of
/// Stream::light_path, their power shared out over that number; levels are empty for roulette.
template <Bsdf B, class Machine>
[[nodiscard]] VplRecords run_light_paths(const InstantRadiosityOptions& options,
                                         const LightTable& lights, const SurfaceTable<B>& surfaces,
                                         Machine& machine) {
    VplRecords out;
    out.emitted_power = static_cast<float>(lights.power());
    if (lights.empty()) return out;
    SurvivorCounts levels;
    if (options.termination == Termination::levels) {
        levels = detail::level_counts(options, lights.geometry(), surfaces);
        out.paths = levels.at(0);
    } else {
        out.paths = detail::paths_for_target(options.vpls, machine);
    }
    machine.trace(levels, out);
    out.non_lambertian_share = share_of_non_lambertian(out.records);
    return out;
}

}  // namespace mir
