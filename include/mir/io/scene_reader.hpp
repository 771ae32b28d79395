// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/io/loaded_scene.hpp"

#include <filesystem>

namespace mir {

/// Reads a scene with the reader that the file's name asks for. In any case of letters: read_obj()
/// for .obj, read_ply() for .ply, read_gltf() for .gltf, .glb and .vrm. Under any other name a file
/// is PLY where it begins so and glTF else. Thread-safe.
/// @throws Error as these do; Error(unsupported) for files of other programs, with what to do.
LoadedScene read_scene(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace mir
