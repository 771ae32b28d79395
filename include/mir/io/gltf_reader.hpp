// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/io/loaded_scene.hpp"

#include <filesystem>

namespace mir {

/// Reads a glTF 2.0 scene, .gltf with its buffers or .glb. Each primitive becomes a mesh, named
/// after its mesh (and its number where a mesh has several). emissiveFactor x emissiveStrength is
/// radiance; punctual lights give candela as W/sr and lux as W/m^2; what is unlit shines with its
/// base colour. Images are PNG or JPEG; their textures and vertex colours are read. A scene without
/// light or camera is no error: the report says so. Transforms of nodes are multiplied in double
/// precision and counted from the origin that recentre() chooses. Alpha mode MASK is read; BLEND
/// and environments are not, the report counts them. Morph targets and skins are as the scene
/// stands; nodes may be hidden. What the picture does not need refuses no file. Buffers outside of
/// the file's folder are refused unless `limits.allow_outside`. Thread-safe for different or equal
/// files.
/// @throws Error(invalid_input) when the file is missing, broken or breaks glTF's rules, by the
///         path of a property that is of a wrong type;
///         Error(unsupported) when it requires an extension that is not known;
///         Error(limit_exceeded) before memory beyond `limits` is taken.
///         Each message reads "FILE: PLACE: problem (why); remedy".
/// Source: Khronos glTF 2.0 specification, version 2.0.1.
LoadedScene read_gltf(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace mir
