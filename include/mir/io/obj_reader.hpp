// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/loaded_scene.hpp"

#include <filesystem>

namespace mir {

/// Reads a Wavefront OBJ scene with the material libraries (MTL) it names. Text is UTF-8 or UTF-16.
/// Each group becomes one mesh per material; polygons are cut into triangles; faces without normals
/// are flat; colours behind the coordinates of vertices are sRGB. Coordinates are metres as they
/// stand, +y up, brought home by recentre(). Ke is radiance, Kd the base colour, the mean of Ks the
/// weight of the interface, Ns or Pr its roughness, Pm metalness, Ni the index of refraction;
/// map_Kd, map_Ke, map_d and norm are textures (docs/scene_files.md). Libraries and images that are
/// missing and what is not read are counted in the report, of materials that faces use. Thread-safe
/// for different or equal files.
/// @throws Error(invalid_input) when the file is missing or broken, with its line, and when a
///         library lies outside of its folder (Limits::allow_outside); Error(limit_exceeded)
///         before memory beyond `limits` is taken. Each message reads
///         "FILE: PLACE: problem (why); remedy".
/// Source: Wavefront Technologies, "The Advanced Visualizer", appendix B1; for Pr and Pm:
/// Exocortex, "Extending Wavefront MTL for physically-based rendering".
LoadedScene read_obj(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace mir
