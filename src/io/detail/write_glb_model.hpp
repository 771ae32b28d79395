// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/io/atomic_file.hpp"
#include "mir/io/detail/shown_path.hpp"

#include <tiny_gltf.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>

namespace mir::detail {

/// Writes a model as .glb, complete or not at all.
/// @throws Error(io) when the file cannot be written, Error(invalid_argument) for names that are
///         not UTF-8.
inline void write_glb_model(const tinygltf::Model& model, const std::filesystem::path& path) {
    AtomicFile file(path);
    std::ofstream stream(file.temporary(), std::ios::binary);
    errno = 0;
    try {
        tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorCode::invalid_argument, shown_path(path) +
                                                     ": the scene cannot be put into glTF (" +
                                                     error.what() + "); use UTF-8 names");
    }
    stream.close();
    if (!stream)
        throw Error(ErrorCode::io, shown_path(path) + ": it cannot be written to the end (" +
                                       (errno != 0 ? std::strerror(errno) : "unknown reason") +
                                       "); make room on the disk");
    file.commit();
}

}  // namespace mir::detail
