// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/loaded_scene.hpp"

#include <filesystem>

namespace mir {
/// Reads a mesh in the PLY format, ascii or binary of either byte order. It has vertices (x y z, nx
/// ny nz, red green blue as sRGB) and faces (vertex_indices), whose polygons are cut into
/// triangles. It gets one Lambertian material, of the vertices' colours or else of reflectance 0.8.
/// Coordinates are metres as they stand, +y up, brought home by recentre(). Other elements and
/// properties are skipped and counted in the report. Thread-safe for different or equal files.
/// @throws Error(invalid_input) when the file is missing or broken, with element and number;
///         Error(limit_exceeded) before memory beyond `limits` is taken.
///         Each message reads "FILE: PLACE: problem (why); remedy".
/// Source: Turk, "The PLY polygon file format", 1994.
LoadedScene read_ply(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace mir
