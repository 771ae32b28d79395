// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/scene/world_geometry.hpp"
#include "support/temporary_folder.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

// What targets for fuzzers share. A target hands bytes to a reader as users do, as a file. The
// reader may accept them or throw mir::Error; any other exception ends the program, which is a
// finding, and so does whatever a sanitizer or a limit of memory reports.

namespace mirfuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Writes `bytes` to the file `name` of a folder that this process has for itself; returns its
/// path. Set TMPDIR to a folder in memory.
inline std::filesystem::path input_file(const char* name, std::string_view bytes) {
    static const mirtest::TemporaryFolder folder("fuzz");
    std::filesystem::path path = folder / name;
    std::ofstream stream(path, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
}

/// Ends the program when a promise is broken.
inline void require(bool kept) {
    if (!kept) std::abort();
}

/// What a reader returns has to make a world, or to be refused as one: for its coordinates or for
/// its number of triangles.
template <class Read>
void read_and_place(const Read& read) {
    try {
        const mir::Scene scene = read();
        const mir::WorldGeometry geometry(scene);
        require(geometry.materials().size() == geometry.triangles().size());
        for (const mir::TriangleIndices& t : geometry.triangles())
            for (std::size_t k = 0; k < 3; ++k) require(t[k] < geometry.positions().size());
        for (const std::uint32_t material : geometry.materials())
            require(material < scene.materials.size());
    } catch (const mir::Error& refused) {
        require(refused.code() != mir::ErrorCode::internal);
    }
}

}  // namespace mirfuzz
