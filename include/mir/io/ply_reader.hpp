// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/detail/ply_mesh.hpp"
#include "mir/io/detail/read_file.hpp"
#include "mir/io/detail/unknown_surface.hpp"
#include "mir/io/loaded_scene.hpp"
#include "mir/scene/recentre.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

namespace mir {
namespace detail {

inline LoadedScene load_ply(const std::filesystem::path& path, const Limits& limits) {
    FileBudget budget(limits);
    const Bytes bytes = read_whole_file(path, budget);
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const PlyHeader header = PlyHeaderReader(file).read();
    check_ply_counts(header, bytes.size());
    LoadedScene loaded;
    loaded.scene.name = path.stem().string();
    Mesh mesh = PlyMesh(file, header, limits, loaded.report).convert();
    mesh.name = loaded.scene.name;
    mesh.material = loaded.scene.add(unknown_surface("PLY default", !mesh.colors.empty()));
    if (!mesh.triangles.empty()) loaded.scene.place(std::move(mesh));
    loaded.report.remarks = recentre(loaded.scene);
    count_scene(loaded.scene, loaded.report);
    return loaded;
}

}  // namespace detail

/// Reads a mesh in the PLY format, ascii or binary of either byte order: vertices (x y z, nx ny nz,
/// red green blue as sRGB) and faces (vertex_indices), whose polygons are cut into triangles. It
/// gets one Lambertian material, of the vertices' colours or else of reflectance 0.8. Coordinates
/// are metres as they stand, +y up, brought home by recentre(). Other elements and properties are
/// skipped and counted in the report. Thread-safe for different or equal files.
/// @throws Error(invalid_input) when the file is missing or broken, with element and number;
///         Error(limit_exceeded) before memory beyond `limits` is taken.
///         Each message reads "FILE: PLACE: problem (why); remedy".
/// Source: Turk, "The PLY polygon file format", 1994.
inline LoadedScene read_ply(const std::filesystem::path& path, const Limits& limits = {}) {
    return detail::naming_file(path, "PLY", [&] { return detail::load_ply(path, limits); });
}

}  // namespace mir
