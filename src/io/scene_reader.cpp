// SPDX-License-Identifier: MIT
#include "mir/io/scene_reader.hpp"

#include "io/detail/scene_kind.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/io/obj_reader.hpp"
#include "mir/io/ply_reader.hpp"

namespace mir {

LoadedScene read_scene(const std::filesystem::path& path, const Limits& limits) {
    switch (detail::scene_kind(path)) {
        case detail::SceneKind::obj:
            return read_obj(path, limits);
        case detail::SceneKind::ply:
            return read_ply(path, limits);
        default:
            return read_gltf(path, limits);
    }
}

}  // namespace mir
