// SPDX-License-Identifier: MIT
#include "mir/io/obj_reader.hpp"

#include "io/detail/obj_materials.hpp"
#include "io/detail/obj_meshes.hpp"
#include "mir/scene/recentre.hpp"

#include <cstddef>
#include <istream>
#include <string>
#include <utility>

namespace mir {

namespace detail {
namespace {

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

LoadedScene load_obj(const std::filesystem::path& path, const Limits& limits) {
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

}  // namespace
}  // namespace detail

LoadedScene read_obj(const std::filesystem::path& path, const Limits& limits) {
    return detail::naming_file(path, "OBJ", [&] { return detail::load_obj(path, limits); });
}

}  // namespace mir
