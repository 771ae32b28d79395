// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/gltf_reader.hpp"
#include "mir/io/obj_reader.hpp"
#include "mir/io/ply_reader.hpp"

#include <filesystem>
#include <string>

namespace mir {

/// Reads a scene with the reader that the file's name asks for: read_obj() for .obj, read_ply() for
/// .ply in any case of letters, read_gltf() for everything else. Thread-safe.
/// @throws Error as these do.
inline LoadedScene read_scene(const std::filesystem::path& path, const Limits& limits = {}) {
    const std::string ending = detail::lower_case_extension(path);
    if (ending == ".obj") return read_obj(path, limits);
    if (ending == ".ply") return read_ply(path, limits);
    return read_gltf(path, limits);
}

}  // namespace mir
