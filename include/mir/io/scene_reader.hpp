// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/detail/scene_kind.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/io/obj_reader.hpp"
#include "mir/io/ply_reader.hpp"

#include <filesystem>

namespace mir {

/// Reads a scene with the reader that the file's name asks for, in any case of letters: read_obj()
/// for .obj, read_ply() for .ply, read_gltf() for .gltf, .glb and .vrm. Under any other name a file
/// is PLY where it begins so and glTF else. Thread-safe.
/// @throws Error as these do; Error(unsupported) for files of other programs, with what to do.
inline LoadedScene read_scene(const std::filesystem::path& path, const Limits& limits = {}) {
    switch (detail::scene_kind(path)) {
        case detail::SceneKind::obj:
            return read_obj(path, limits);
        case detail::SceneKind::ply:
            return read_ply(path, limits);
        default:
            return read_gltf(path, limits);
    }
}

}  // namespace mir
