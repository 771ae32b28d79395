// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "support/named_scene.hpp"

#include <array>

namespace mirtest {

/// A scene through which random segments are laid: built in, or a file of the shared scenes.
struct SegmentScene {
    std::string_view name;
    std::string_view file;         ///< below the folder of shared scenes; empty for a built-in one
    bool is_for_every_run = true;  ///< small enough for runs that must be over soon
};

inline constexpr std::array<SegmentScene, 6> segment_scenes{{
    {"sphere", "", true},
    {"car", "", true},
    {"car-grille", "", false},
    {"garage", "", false},
    {"veach-ajar-diffuse", "veach-ajar/veach-ajar-diffuse.gltf", true},
    {"bmw-m6", "bmw-m6/bmw-m6.glb", false},
}};

/// Nothing when the scene's file is not on this machine.
[[nodiscard]] inline std::optional<World> load(const SegmentScene& scene) {
    auto loaded = load_opaque_scene(scene.name, scene.file);
    if (!loaded) return std::nullopt;
    return World(std::move(*loaded));
}

}  // namespace mirtest
