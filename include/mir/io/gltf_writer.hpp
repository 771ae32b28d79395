// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"

#include <filesystem>

namespace mir {

/// Writes a scene as binary glTF 2.0 (.glb). Lights become KHR_lights_punctual, radiance becomes
/// emissiveFactor x KHR_materials_emissive_strength, `specular`, `ior` and what light goes through
/// their extensions, `alpha_cutoff` alpha mode MASK and `is_blended` BLEND, `emits_from_both_sides`
/// doubleSided; images become PNG; light groups and lenses go to extras; nodes stand where
/// Scene::origin puts them. read_gltf gives the same values back, except that a mesh without name
/// gets one, that coordinates come back where the material has textures, and that turned textures
/// do so up to rounding. The file appears complete or not at all; equal scenes give equal bytes.
/// Thread-safe for different files.
/// @throws Error(io) when the file cannot be written; Error(invalid_input) when the scene breaks
///         its own rules (WorldGeometry); Error(unsupported) when it has an environment;
///         Error(invalid_argument) for a mesh without triangles, a texture that is sheared or a
///         name that is not UTF-8; Error(limit_exceeded) when it exceeds the 4 GiB of the format.
void write_glb(const Scene& scene, const std::filesystem::path& path);

}  // namespace mir
