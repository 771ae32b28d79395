// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf_fixture.hpp"
#include "mir/io/obj_reader.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace mirtest {

/// What a reader counted as lost.
using Ignored = std::map<std::string, std::uint64_t>;

/// The scene of an OBJ file beside the library "my scene.mtl".
inline mir::LoadedScene read_obj_text(const std::string& obj, const std::string& mtl = "",
                                      const mir::Limits& limits = {}) {
    const TemporaryFolder folder("obj_reader");
    write_file(folder / "my scene.mtl", mtl);
    write_file(folder / "scene.obj", obj);
    return mir::read_obj(folder / "scene.obj", limits);
}

/// Four corners of a square.
inline const std::string obj_corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace mirtest
