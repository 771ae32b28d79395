// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/scene/builtin.hpp"
#include "support/shared_scenes.hpp"

#include <array>
#include <optional>
#include <string_view>

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
    if (scene.file.empty()) return World(mir::builtin::make(scene.name));
    const auto folder = shared_scenes();
    if (!folder) return std::nullopt;
    return World(mir::read_gltf(*folder / scene.file).scene);
}

}  // namespace mirtest
