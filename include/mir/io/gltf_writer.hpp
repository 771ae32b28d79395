// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/atomic_file.hpp"
#include "mir/io/detail/gltf_build.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_gltf.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>

namespace mir {

/// Writes a scene as binary glTF 2.0 (.glb). Lights become KHR_lights_punctual, radiance becomes
/// emissiveFactor x KHR_materials_emissive_strength, `specular` and `ior` their extensions,
/// `emits_from_both_sides` doubleSided; images become PNG; light groups and lenses go to extras.
/// read_gltf gives the same values back, except that a mesh without name gets one, that coordinates
/// come back where the material has textures, and that turned textures do so up to rounding. The
/// file appears complete or not at all; equal scenes give equal bytes. Thread-safe for different
/// files.
/// @throws Error(io) when the file cannot be written; Error(invalid_input) when the scene breaks
///         its own rules (WorldGeometry); Error(unsupported) when it has an environment;
///         Error(invalid_argument) for a mesh without triangles, a texture that is sheared or a
///         name that is not UTF-8; Error(limit_exceeded) when it exceeds the 4 GiB of the format.
inline void write_glb(const Scene& scene, const std::filesystem::path& path) {
    if (scene.environment)
        throw Error(ErrorCode::unsupported,
                    path.string() +
                        ": the scene cannot be written (glTF has no environment, and "
                        "the scene would lose its light); take it out of the scene");
    const tinygltf::Model model = detail::GltfBuilder().build(scene);
    AtomicFile file(path);
    std::ofstream stream(file.temporary(), std::ios::binary);
    errno = 0;
    try {
        tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorCode::invalid_argument, path.string() +
                                                     ": the scene cannot be put into glTF (" +
                                                     error.what() + "); use UTF-8 names");
    }
    stream.close();
    if (!stream)
        throw Error(ErrorCode::io, path.string() + ": it cannot be written to the end (" +
                                       (errno != 0 ? std::strerror(errno) : "unknown reason") +
                                       "); make room on the disk");
    file.commit();
}

}  // namespace mir
