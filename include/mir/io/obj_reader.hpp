// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/detail/obj_materials.hpp"
#include "mir/io/detail/obj_meshes.hpp"
#include "mir/io/loaded_scene.hpp"
#include "mir/scene/recentre.hpp"

#include <cstddef>
#include <filesystem>
#include <istream>
#include <string>
#include <utility>

namespace mir {
namespace detail {

/// What the callbacks of tinyobjloader write to.
struct ObjTarget {
    ObjMeshes meshes;
    ObjMaterials materials;

    void add_face(const tinyobj::index_t* corners, std::size_t count) {
        const auto material = meshes.given_material();
        if (material && ObjMeshes::is_face(count)) materials.use(*material);
        meshes.add_face(corners, count);
    }

    [[nodiscard]] static tinyobj::callback_t callbacks() {
        tinyobj::callback_t calls;
        calls.index_cb = [](void* data, tinyobj::index_t* corners, int count) {
            static_cast<ObjTarget*>(data)->add_face(corners, static_cast<std::size_t>(count));
        };
        calls.usemtl_cb = [](void* data, const char* name, int) {
            auto& target = *static_cast<ObjTarget*>(data);
            target.meshes.use_material(target.materials.find(name));
        };
        calls.group_cb = [](void* data, const char** names, int count) {
            std::string name;
            for (int i = 0; i < count; ++i) name += (i == 0 ? "" : " ") + std::string(names[i]);
            static_cast<ObjTarget*>(data)->meshes.begin_group(std::move(name));
        };
        calls.object_cb = [](void* data, const char* name) {
            static_cast<ObjTarget*>(data)->meshes.begin_group(trimmed(name));
        };
        return calls;
    }
};

inline LoadedScene load_obj(const std::filesystem::path& path, const Limits& limits) {
    LoadedScene loaded;
    FileBudget budget(limits);
    ObjText text(text_of(read_whole_file(path, budget)), limits, loaded.report);
    ObjTarget target{{text, limits, loaded.scene, loaded.report},
                     {text, path.parent_path(), budget, limits, loaded.scene, loaded.report}};
    std::istream stream(&text);
    // Errors of ours fly through: a stream would swallow them otherwise.
    stream.exceptions(std::ios::badbit);
    tinyobj::LoadObjWithCallback(stream, ObjTarget::callbacks(), &target, &target.materials);
    target.meshes.finish();
    loaded.scene.name = path.stem().string();
    loaded.report.remarks = recentre(loaded.scene);
    count_scene(loaded.scene, loaded.report);
    return loaded;
}

}  // namespace detail

/// Reads a Wavefront OBJ scene with the material libraries (MTL) that it names, in UTF-8 or UTF-16.
/// Each group becomes one mesh per material; polygons are cut into triangles; faces without normals
/// are flat; colours behind the coordinates of vertices are sRGB. Coordinates are metres as they
/// stand, +y up, brought home by recentre(). Ke is radiance, Kd the base colour, the mean of Ks the
/// weight of the interface, Ns or Pr its roughness, Pm metalness, Ni the index of refraction;
/// map_Kd, map_Ke, map_d and norm are textures (docs/scene_files.md). Libraries and images that are
/// missing and what is not read are counted in the report, of materials that faces use. Thread-safe
/// for different or equal files.
/// @throws Error(invalid_input) when the file is missing or broken, with its line, and when a
/// library
///         lies outside of its folder (Limits::allow_outside); Error(limit_exceeded) before memory
///         beyond `limits` is taken. Each message reads "FILE: PLACE: problem (why); remedy".
/// Source: Wavefront Technologies, "The Advanced Visualizer", appendix B1; for Pr and Pm:
/// Exocortex, "Extending Wavefront MTL for physically-based rendering".
inline LoadedScene read_obj(const std::filesystem::path& path, const Limits& limits = {}) {
    return detail::naming_file(path, "OBJ", [&] { return detail::load_obj(path, limits); });
}

}  // namespace mir
