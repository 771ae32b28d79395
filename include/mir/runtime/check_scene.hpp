// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/scene/scene.hpp"

#include <algorithm>
#include <cstdio>

namespace mir {

/// True when every material is purely Lambertian.
inline bool is_lambertian(const Scene& scene) {
    return std::all_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.is_lambertian(); });
}

/// True when something in the scene could shine.
inline bool has_light(const Scene& scene) {
    const bool delta = !scene.point_lights.empty() || !scene.spot_lights.empty() ||
                       !scene.directional_lights.empty();
    return delta || std::any_of(scene.materials.begin(), scene.materials.end(),
                                [](const Material& m) { return m.emits(); });
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
    if (scene.instances.empty())
        throw Error(ErrorCode::invalid_input,
                    "the scene has no triangles (there is nothing to see); check the file with "
                    "'mir info'");
    if (has_light(scene)) return warnings;
    if (!settings.allow_no_light)
        throw Error(ErrorCode::invalid_input,
                    "the scene has no light (the picture would be black); add an emissive material "
                    "or a light, or pass --allow-no-light");
    warnings.emplace_back("the scene has no light: the picture is black");
    return warnings;
}

/// Adds what the numbers of a finished render give reason to say.
inline void add_result_warnings(const RenderResult& result, std::vector<std::string>& warnings) {
    const RenderStatistics& s = result.statistics;
    char text[160];
    if (s.dropped_triangles > 0)
        warnings.push_back(std::to_string(s.dropped_triangles) +
                           " triangles without area were left out");
    if (s.removed_share() > 0.05) {
        std::snprintf(text, sizeof text,
                      "the bound removed %.1f %% of the indirect light; more VPLs or --bound none "
                      "lose less",
                      100.0 * s.removed_share());
        warnings.emplace_back(text);
    }
    if (s.non_lambertian_share > 0.01f) {
        std::snprintf(text, sizeof text,
                      "%.1f %% of the VPLs' light comes from glossy surfaces and is spread as if "
                      "they were diffuse",
                      100.0 * static_cast<double>(s.non_lambertian_share));
        warnings.emplace_back(text);
    }
    if (s.vpls == 0 && s.emitted_power > 0.0f)
        warnings.emplace_back("no VPL was placed: no light path met a reflecting surface");
}

}  // namespace mir
