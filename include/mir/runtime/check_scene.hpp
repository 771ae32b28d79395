// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/number_text.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/scene/light_kinds.hpp"
#include "mir/scene/scene.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

/// True when every material is purely Lambertian.
inline bool is_lambertian(const Scene& scene) {
    return std::all_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.is_lambertian(); });
}

namespace detail {

/// True when `holds` is true of a mesh with triangles that the scene shows.
template <class Predicate>
bool shows_mesh(const Scene& scene, const Predicate& holds) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) {
        // Indices that do not exist are refused by WorldGeometry, with their names.
        if (i.mesh >= scene.meshes.size()) return false;
        const Mesh& mesh = scene.meshes[i.mesh];
        return !mesh.triangles.empty() && holds(mesh);
    });
}

}  // namespace detail

/// True when something in the scene could shine: a light or a placed triangle.
inline bool has_light(const Scene& scene) {
    bool listed = false;
    for_each_listed_light(scene, [&listed](const auto&) { listed = true; });
    return listed || scene.environment || detail::shows_mesh(scene, [&](const Mesh& mesh) {
               return mesh.material < scene.materials.size() &&
                      scene.materials[mesh.material].emits();
           });
}

/// Checks that the scene can be rendered with these settings; returns worded warnings.
/// @throws Error(invalid_input) without camera, triangles or (unless allowed) light, and when the
///         camera asked for does not exist.
inline std::vector<std::string> check_scene(const Scene& scene, const RenderSettings& settings) {
    std::vector<std::string> warnings;
    if (scene.cameras.empty())
        throw Error(ErrorCode::invalid_input,
                    "the scene has no camera (there is no view to render); add one");
    if (settings.camera >= scene.cameras.size())
        throw Error(ErrorCode::invalid_input, "camera " + std::to_string(settings.camera) +
                                                  " was asked for, but the scene "
                                                  "has " +
                                                  std::to_string(scene.cameras.size()) +
                                                  "; cameras count from 0");
    if (!detail::shows_mesh(scene, [](const Mesh&) { return true; }))
        throw Error(ErrorCode::invalid_input,
                    "the scene has no triangles (there is nothing to see); check the file with "
                    "'mir info'");
    if (has_light(scene)) return warnings;
    if (!settings.allow_no_light)
        throw Error(
            ErrorCode::invalid_input,
            "the scene has no light (the picture would be black); add an emissive material or a "
            "light, a sun (--sun) or a sky (--environment), or pass --allow-no-light");
    warnings.emplace_back("the scene has no light: the picture is black");
    return warnings;
}

namespace detail {

inline void add_luminance_warnings(const ChainHealth& h, std::vector<std::string>& warnings) {
    const PathLuminance& p = h.luminance;
    if (p.contributing == 0) {
        warnings.push_back(
            "none of " + std::to_string(p.paths) +
            " paths brought light from a lamp to the camera: the light of the VPLs is black; check "
            "that the lamps shine into the scene and that the camera is not inside something "
            "solid");
        return;
    }
    if (p.relative_error() > 0.05)
        warnings.push_back("the brightness of the VPLs' light is known to " +
                           fixed_text(100.0 * p.relative_error()) + " % only (" +
                           std::to_string(p.contributing) + " of " + std::to_string(p.paths) +
                           " paths carried light); a smaller --bootstrap-error knows it better");
    if (std::fabs(h.luminance_z()) > 4.0)
        warnings.push_back("two estimates of the mean luminance disagree by " +
                           fixed_text(std::fabs(h.luminance_z()), 1) +
                           " standard errors: some light is found too rarely to be measured");
}

/// Where light paths find the light that the camera sees too rarely. Then few of them bring most of
/// it, and more often than not too few. VPLs that are merely few are no reason.
inline void add_light_path_warning(const PathLuminance& p, double indirect_luminance,
                                   std::vector<std::string>& warnings) {
    if (p.contributing == 0 && indirect_luminance > 0.0) {
        warnings.emplace_back(
            "the brightness of the VPLs' light is not known: hardly any light path reaches what "
            "the camera sees, and more often than not the picture is too dark; --sampler mir finds "
            "such light, more --vpls help");
        return;
    }
    const double error = p.relative_error();
    // Where one path in a hundred brings light, the brightest may be missing, and the error with
    // them.
    const bool is_rare = static_cast<double>(p.contributing) < 0.01 * static_cast<double>(p.paths);
    if (error <= (is_rare ? 0.03 : 0.1)) return;
    const double equal_paths = 1.0 / (error * error);
    if (equal_paths >= 0.2 * static_cast<double>(p.paths)) return;
    warnings.push_back("the brightness of the VPLs' light is known to " +
                       fixed_text(100.0 * error) + " % only, and is more often too dark (" +
                       std::to_string(p.paths) + " light paths are worth " +
                       fixed_text(equal_paths) +
                       " that bring the same); --sampler mir finds it, more --vpls help");
}

inline void add_mixing_warnings(const ChainHealth& h, std::vector<std::string>& warnings) {
    if (h.capped)
        warnings.emplace_back(
            "the paper's stopping rule was cut short: too few mutations led to new VPLs");
    if (h.mutations == 0) return;
    if (h.large.accepted + h.small.accepted + h.bidirectional.accepted == 0)
        warnings.emplace_back(
            "no mutation was accepted: each chain stayed on its first path; a longer --stride may "
            "help");
    const auto n = static_cast<double>(h.recorded_states);
    if (h.effective_samples < 0.25 * n)
        warnings.push_back("the " + fixed_text(n) + " recorded states are worth " +
                           fixed_text(h.effective_samples) +
                           " independent ones; a longer --stride or more --tries mix better");
    if (h.split_r_hat > 1.5 && h.effective_samples < 0.5 * n)
        warnings.push_back("the Markov chains disagree (split R-hat " +
                           fixed_text(h.split_r_hat, 2) +
                           ", 1 is ideal); a longer --stride or fewer --chains help");
}

/// "17.3 +- 0.8 %".
inline std::string percent(const ShareEstimate& e) {
    return fixed_text(100.0 * e.share, 1) + " +- " + fixed_text(100.0 * e.standard_error, 1) + " %";
}

inline void add_missing_warnings(const RenderStatistics& s, std::vector<std::string>& warnings) {
    if (s.removed_share() > 0.05 && s.residual_paths == 0)
        warnings.push_back(
            "the bound removed " +
            (s.removed ? percent(*s.removed) : fixed_text(100.0 * s.removed_share(), 1) + " %") +
            " of the indirect light; more VPLs lose less, --compensate 4 traces it back");
    if (s.cut && s.cut->share > 0.005)
        warnings.push_back("the largest number of reflections cuts " + percent(*s.cut) +
                           " of the indirect light; a larger --bounces cuts less, --integrator "
                           "path nothing");
}

/// More than 5 %, beyond what the noise of the paths explains.
inline void add_gather_warning(const LightDifference& d, std::vector<std::string>& warnings) {
    if (std::fabs(d.mean) - 2.0 * d.standard_error <= 0.05) return;
    warnings.push_back(
        "the light gathered from discs is " + fixed_text(100.0 * std::fabs(d.mean), 1) + " +- " +
        fixed_text(100.0 * d.standard_error, 1) + " % too " + (d.mean > 0.0 ? "bright" : "dark") +
        " in the mean; more --surfels or --gather exact may lie nearer, "
        "--gather-check correct brings it nearer, --integrator path is right");
}

/// Of the picture's luminance, 0..1; 0 of a black picture.
inline double share_of_picture(const Image<Rgb>& layer, const Image<Rgb>& beauty) {
    const auto sum = [](const Image<Rgb>& image) {
        double all = 0.0;
        for (const Rgb& pixel : image.pixels()) all += static_cast<double>(luminance(pixel));
        return all;
    };
    const double all = sum(beauty);
    return all > 0.0 ? sum(layer) / all : 0.0;
}

/// A picture bears 10 % in a pixel. Less is seen by those who look for it.
inline void add_direct_noise_warning(const RenderResult& result,
                                     std::vector<std::string>& warnings) {
    constexpr double bearable = 0.1;
    const double of_direct = result.statistics.direct_noise.value_or(0.0);
    if (of_direct <= bearable) return;
    const double noise = of_direct * share_of_picture(result.direct, result.beauty);
    if (noise <= bearable) return;
    const double times = std::ceil(noise * noise / (bearable * bearable));
    warnings.push_back("direct light is noisy, by " + fixed_text(100.0 * of_direct) +
                       " % in a typical pixel; " + fixed_text(times) +
                       " times as many --direct-samples make it smooth");
}

/// Where lobes carry 5 % of what the picture shows.
inline void add_lobe_warning(const RenderResult& result, std::vector<std::string>& warnings) {
    const double share = static_cast<double>(result.statistics.non_lambertian_share) *
                         share_of_picture(result.indirect, result.beauty);
    if (share <= 0.05) return;
    warnings.push_back(
        "reflections in glossy surfaces bring " + fixed_text(100.0 * share) +
        " % of the picture's light, and VPLs spread it evenly; --sampler ir --glossy "
        "keeps its direction, --integrator path too");
}

}  // namespace detail

/// Adds what Markov chains have to say about themselves.
inline void add_chain_warnings(const RenderStatistics& s, std::vector<std::string>& warnings) {
    if (!s.health) return;
    detail::add_luminance_warnings(*s.health, warnings);
    if (s.health->recorded_states > 0) detail::add_mixing_warnings(*s.health, warnings);
    if (s.dropped_share > 0.001)
        warnings.push_back(fixed_text(100.0 * s.dropped_share, 1) +
                           " % of the VPLs light no luxel and their light is missing; more luxels "
                           "or --normalise proposal lose less");
}

/// Adds what the numbers of a finished render give reason to say.
inline void add_result_warnings(const RenderResult& result, std::vector<std::string>& warnings) {
    const RenderStatistics& s = result.statistics;
    add_chain_warnings(s, warnings);
    if (s.light_path_luminance)
        detail::add_light_path_warning(*s.light_path_luminance, s.indirect_luminance, warnings);
    if (s.dropped_triangles > 0)
        warnings.push_back(std::to_string(s.dropped_triangles) +
                           " triangles without area were left out");
    if (s.coinciding_triangles > 0)
        warnings.push_back(std::to_string(s.coinciding_triangles) +
                           " triangles lie in one place with a lamp: the lamp is seen before a "
                           "wall, and the first of several lamps before the others; move them "
                           "apart if that is not meant");
    detail::add_missing_warnings(s, warnings);
    if (s.gather_difference && !s.gather_corrected)
        detail::add_gather_warning(*s.gather_difference, warnings);
    detail::add_direct_noise_warning(result, warnings);
    detail::add_lobe_warning(result, warnings);
    if (s.widened_share > 0.01f)
        warnings.push_back(fixed_text(100.0 * static_cast<double>(s.widened_share), 1) +
                           " % of the VPLs' light comes from surfaces smoother than "
                           "--glossy-roughness and through lobes of that roughness");
    if (s.vpls == 0 && s.emitted_power > 0.0f && !s.health && s.camera_paths == 0 && s.surfels == 0)
        warnings.emplace_back("no VPL was placed: no light path met a reflecting surface");
}

}  // namespace mir
