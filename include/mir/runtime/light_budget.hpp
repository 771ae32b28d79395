// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// Light that a picture lacks.
struct MissingLight {
    std::string why;      ///< "by" what
    ShareEstimate share;  ///< of the light of its class, what is missing included
};

/// A class of a picture's light.
struct LightClass {
    std::string light;                       ///< which
    std::string brought_by;                  ///< what finds it
    double share = 0.0;                      ///< of the mean luminance of the picture, 0..1
    std::optional<double> standard_error{};  ///< of `share`, where it is known
    std::vector<MissingLight> missing{};     ///< what of it the picture lacks, as far as is known
};

namespace detail {

inline double mean_luminance_of(const Image<Rgb>& image) {
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels()) sum += static_cast<double>(luminance(pixel));
    return image.pixels().empty() ? 0.0 : sum / static_cast<double>(image.pixels().size());
}

/// Whether VPLs bring what lamps send to luxels, too.
inline bool by_vpls(const RenderSettings& s) {
    return s.integrator == Integrator::vpl && s.direct == DirectLight::vpl;
}

inline std::string indirect_bringer(const RenderSettings& s) {
    if (s.integrator == Integrator::path) return "camera paths";
    if (s.integrator == Integrator::micro) return "discs";
    if (!s.wants_cuts()) return "VPLs";
    return "VPLs, " + std::to_string(s.gathered_vpls()) + " picked by each luxel";
}

inline std::string direct_bringer(const RenderSettings& s) {
    if (s.integrator == Integrator::path) return "camera paths, samples of lights";
    return by_vpls(s) ? "lights without extent" : "samples of lights and lobes";
}

inline std::string caustic_bringer(const RenderStatistics& s) {
    if (!s.faint_caustics) return "light paths, paths traced back";
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.2g", 100.0 * *s.faint_caustics);
    return std::string("paths traced back; light paths are left out, at most ") + percent +
           " % of indirect light";
}

inline std::vector<MissingLight> missing_of_vpls(const RenderStatistics& s,
                                                 const RenderSettings& settings) {
    std::vector<MissingLight> missing;
    if (s.removed && settings.compensate == 0) missing.push_back({"the bound", *s.removed});
    if (s.cut) missing.push_back({"the largest number of reflections", *s.cut});
    return missing;
}

/// Relative standard error of the mean light of VPLs, where their sampler tells.
inline std::optional<double> relative_error_of_vpls(const RenderStatistics& s) {
    const PathLuminance* p = s.health                 ? &s.health->luminance
                             : s.light_path_luminance ? &*s.light_path_luminance
                                                      : nullptr;
    if (p == nullptr || !(p->mean > 0.0)) return std::nullopt;
    return p->relative_error();
}

}  // namespace detail

/// What a picture's light is made of: classes of paths whose shares add up to 1, or to 0 where it
/// is black. Light as the camera sees it, after one scattering event and after several; then, where
/// a render traced them, what `caustics` and `compensate` brought. Mirrors and glass that bend the
/// camera's rays, or let them through, do not count as events. Shares of the last two are those of
/// luxels, so that a filter moves a little between them and the others.
[[nodiscard]] inline std::vector<LightClass> light_budget(const RenderResult& r,
                                                          const RenderSettings& settings) {
    const RenderStatistics& s = r.statistics;
    const double emitted = std::max(detail::mean_luminance_of(r.emission), 0.0);
    const double direct = std::max(detail::mean_luminance_of(r.direct), 0.0);
    const double indirect = std::max(detail::mean_luminance_of(r.indirect), 0.0);
    const double once = std::min(s.caustic_direct_luminance, direct);
    const double more = std::min(s.caustic_luminance - s.caustic_direct_luminance, indirect);
    const double traced = std::min(s.residual_luminance, indirect - more);
    const double all = emitted + direct + indirect;
    const auto share = [&](double light) { return all > 0.0 ? light / all : 0.0; };

    const auto error = [&](const std::optional<double>& of) -> std::optional<double> {
        return of && all > 0.0 ? std::optional(*of / all) : std::nullopt;
    };

    std::vector<LightClass> classes{
        {"lamps and sky, seen by the camera", "camera rays", share(emitted)},
        {"scattered once", detail::direct_bringer(settings), share(direct - once),
         error(s.direct_error)}};
    LightClass often{
        detail::by_vpls(settings) ? "scattered once or more often" : "scattered more often",
        detail::indirect_bringer(settings), share(indirect - more - traced)};
    if (settings.integrator == Integrator::vpl) {
        if (const auto relative = detail::relative_error_of_vpls(s))
            often.standard_error = *relative * often.share;
        often.missing = detail::missing_of_vpls(s, settings);
    }
    classes.push_back(std::move(often));
    if (s.residual_paths > 0)
        classes.push_back(
            {"too near for VPLs", "paths traced back", share(traced), error(s.residual_error)});
    if (s.caustic_paths > 0)
        classes.push_back({"caustics of mirrors and glass", detail::caustic_bringer(s),
                           share(once + more), error(s.caustic_error)});
    return classes;
}

}  // namespace mir
