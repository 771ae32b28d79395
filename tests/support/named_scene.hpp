// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/gltf_reader.hpp"
#include "mir/scenes.hpp"
#include "support/shared_scenes.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mirtest {

/// A scene of a test: built in, or a file of the shared scenes.
struct NamedScene {
    std::string name;
    std::string file;  ///< below the folder of shared scenes; empty for a built-in one
};

/// Scenes by which pictures of several engines are compared: all built-in ones and three files.
inline std::vector<NamedScene> picture_scenes() {
    std::vector<NamedScene> scenes;
    for (const mir::builtin::Entry& e : mir::builtin::scenes)
        scenes.push_back({std::string(e.name), ""});
    scenes.push_back({"cornell-box.glb", "cornell-box/cornell-box.glb"});
    scenes.push_back({"veach-ajar-diffuse", "veach-ajar/veach-ajar-diffuse.gltf"});
    scenes.push_back({"bmw-m6", "bmw-m6/bmw-m6.glb"});
    return scenes;
}

/// Nothing when the scene's file is not on this machine.
inline std::optional<mir::Scene> load_scene(std::string_view name, std::string_view file) {
    if (file.empty()) return mir::builtin::make(name);
    const auto folder = shared_scenes();
    if (!folder) return std::nullopt;
    return mir::read_gltf(*folder / file).scene;
}

/// The same with nothing to see through and no holes, for judges that know triangles alone.
inline std::optional<mir::Scene> load_opaque_scene(std::string_view name, std::string_view file) {
    auto scene = load_scene(name, file);
    if (!scene) return scene;
    for (mir::Material& m : scene->materials) {
        m.is_blended = false;
        m.transmission = m.alpha_cutoff = 0.0f;
    }
    return scene;
}

}  // namespace mirtest
