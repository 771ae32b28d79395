// SPDX-License-Identifier: MIT
#include "prepare_scene.hpp"

#include "added_scene.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/frame_scene.hpp"
#include "text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace mirtool {
namespace {

constexpr std::uint32_t default_height = 480;

/// Position in the file's list of cameras of the one that was asked for.
std::size_t find_camera(const RenderOptions& o, const mir::SceneReport& report) {
    std::string names;
    const std::string wanted = mir::printable(o.camera);
    for (std::size_t i = 0; i < report.cameras.size(); ++i) {
        if (report.cameras[i].name == wanted) return i;
        names += (i == 0 ? "'" : ", '") + report.cameras[i].name + "'";
    }
    std::size_t index = 0;
    const char* end = o.camera.data() + o.camera.size();
    const auto read = std::from_chars(o.camera.data(), end, index);
    if (read.ec == std::errc() && read.ptr == end && index < report.cameras.size()) return index;
    throw mir::Error(mir::ErrorCode::invalid_argument, shown(o.scene) + ": there is no camera '" +
                                                           wanted + "'; the scene has " +
                                                           (names.empty() ? "none" : names));
}

/// Sets the scene's camera to the one to use and returns what the file says about it.
std::optional<mir::CameraReport> choose_camera(RenderOptions& o, SceneAndReport& loaded) {
    const auto& cameras = loaded.report.cameras;
    if (!o.camera.empty()) {
        const mir::CameraReport& chosen = cameras[find_camera(o, loaded.report)];
        if (!chosen.index)
            throw mir::Error(mir::ErrorCode::invalid_input,
                             o.scene + ": camera '" + chosen.name + "' is " + chosen.kind +
                                 ", which is not supported; choose a perspective one");
        o.settings.camera = *chosen.index;
        return chosen;
    }
    const auto usable =
        std::find_if(cameras.begin(), cameras.end(),
                     [](const mir::CameraReport& c) { return c.index.has_value(); });
    if (usable == cameras.end()) return std::nullopt;
    o.settings.camera = *usable->index;
    return *usable;
}

/// Width and height: as asked, else those of the file, else its aspect ratio.
mir::Extent choose_size(const RenderOptions& o, const std::optional<mir::CameraReport>& camera,
                        const mir::Scene& scene) {
    if (o.width && o.height) return {*o.width, *o.height};
    float aspect = 4.0f / 3.0f;
    if (camera) {
        const float given = scene.cameras[*camera->index].aspect_ratio;
        if (given > 0.0f) aspect = given;
        if (camera->width > 0 && camera->height > 0) {
            if (!o.width && !o.height) return {camera->width, camera->height};
            aspect = static_cast<float>(camera->width) / static_cast<float>(camera->height);
        }
    }
    const auto side = [](float length) {
        return static_cast<std::uint32_t>(std::clamp(std::round(length), 1.0f, 65536.0f));
    };
    if (o.width) return {*o.width, side(static_cast<float>(*o.width) / aspect)};
    const std::uint32_t height = o.height.value_or(default_height);
    return {side(static_cast<float>(height) * aspect), height};
}

}  // namespace

bool adds_to_scene(const RenderOptions& o, const mir::SceneReport& report) {
    const AddedScene& a = o.added;
    const bool has_view =
        std::any_of(report.cameras.begin(), report.cameras.end(),
                    [](const mir::CameraReport& camera) { return camera.index.has_value(); });
    return a.sun || a.ground || a.eye || !has_view;
}

void choose_layers(RenderOptions& o) {
    const auto wants = [&o](const char* layer) {
        return std::find(o.layers.begin(), o.layers.end(), layer) != o.layers.end();
    };
    o.settings.bounce_layers = wants("bounces");
    o.settings.removed_layer = wants("removed");
    o.settings.pick_error_layer = wants("pick_error");
}

ChosenView prepare_scene(RenderOptions& o, SceneAndReport& loaded) {
    add_sun_and_camera(o.added, loaded);
    const auto camera = choose_camera(o, loaded);
    o.settings.image = choose_size(o, camera, loaded.scene);
    ChosenView view;
    if (!camera) {
        const mir::FramedScene framed =
            mir::frame_scene(loaded.scene, o.settings.aspect(), o.settings.limits);
        view = {true, framed.inside};
        loaded.scene.cameras.push_back(framed.camera);
        o.settings.camera = static_cast<std::uint32_t>(loaded.scene.cameras.size() - 1);
    }
    // The view is of what the file holds: the ground is many times larger.
    add_ground(o.added, loaded);
    choose_layers(o);
    mir::check_scene(loaded.scene, o.settings);
    return view;
}

}  // namespace mirtool
