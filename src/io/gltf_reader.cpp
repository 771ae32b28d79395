// SPDX-License-Identifier: MIT
#include "mir/io/gltf_reader.hpp"

#include "io/detail/gltf_cameras.hpp"
#include "io/detail/gltf_instances.hpp"
#include "io/detail/gltf_lights.hpp"
#include "io/detail/gltf_load.hpp"
#include "io/detail/gltf_materials.hpp"
#include "io/detail/gltf_node_meshes.hpp"
#include "mir/scene/recentre.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace mir {

namespace detail {
namespace {

/// Counts what a node asks for beyond meshes, lights and cameras.
void note_unused_of_node(const tinygltf::Node& node, SceneReport& report) {
    for (const auto& [name, value] : node.extensions)
        if (name != "KHR_lights_punctual" && name != "EXT_mesh_gpu_instancing" &&
            name != "KHR_node_visibility")
            count_extension(name, report);
}

/// Counts what the file as a whole asks for beyond its scene.
void note_unused_of_file(const tinygltf::Model& model, SceneReport& report) {
    if (!model.animations.empty()) report.ignored["animation"] += model.animations.size();
    for (const auto& [name, value] : model.extensions)
        if (name != "KHR_lights_punctual") count_extension(name, report);
    for (const tinygltf::Scene& scene : model.scenes) {
        if (scene.extras.Has("environment")) ++report.ignored["environment"];
        for (const auto& [name, value] : scene.extensions) count_extension(name, report);
    }
}

void place_everything(const tinygltf::Model& model, const std::vector<int>& coordinates,
                      const Limits& limits, LoadedScene& loaded) {
    const std::vector<PlacedNode> nodes = placed_nodes(model, loaded.report);
    Placements places;
    GltfInstances instances(model, limits, loaded.scene, places);
    GltfNodeMeshes meshes(model, nodes, coordinates, limits, loaded);
    for (const PlacedNode& placed : nodes) {
        const tinygltf::Node& node = model.nodes[placed.node];
        if (node.mesh >= 0 && placed.is_visible) {
            const auto [parts, to_world] = meshes.at(placed);
            instances.add(placed, parts, to_world);
        }
        if (node.camera >= 0)
            add_camera(model, node.camera, placed, loaded.scene, places, loaded.report);
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end() && placed.is_visible)
            add_light(model, index_under(light->second, "light"), placed, loaded.scene, places,
                      loaded.report);
        note_unused_of_node(node, loaded.report);
    }
    loaded.report.remarks = recentre(loaded.scene, std::move(places));
}

/// For every material, whether a primitive has it.
std::vector<char> used_materials(const tinygltf::Model& model) {
    std::vector<char> used(model.materials.size(), 0);
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            if (primitive.material >= 0) used[static_cast<std::size_t>(primitive.material)] = 1;
    return used;
}

/// Material `index`, which no primitive has. Of values that mean nothing it keeps its name alone.
Material convert_unused(GltfMaterials& materials, const tinygltf::Model& model, std::size_t index) {
    try {
        return materials.convert(index);
    } catch (const Error& failure) {
        if (failure.code() != ErrorCode::invalid_input) throw;
        Material name_alone;
        name_alone.name = model.materials[index].name;
        return name_alone;
    }
}

/// Adds the materials of the file; returns the set of texture coordinates of each. What materials
/// ask for and do not get is a loss where something is made of them.
std::vector<int> convert_materials(const tinygltf::Model& model, GltfImages& images,
                                   LoadedScene& loaded) {
    SceneReport of_no_matter;
    GltfMaterials used(model, images, loaded.report);
    GltfMaterials unused(model, images, of_no_matter);
    const std::vector<char> is_used = used_materials(model);
    std::vector<int> coordinates;
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        loaded.scene.add(is_used[i] != 0 ? used.convert(i) : convert_unused(unused, model, i));
        coordinates.push_back(is_used[i] != 0 ? used.coordinates() : unused.coordinates());
    }
    return coordinates;
}

LoadedScene load_gltf(const std::filesystem::path& path, const Limits& limits) {
    FileBudget budget(limits);
    LoadedScene loaded;
    const tinygltf::Model model = load_gltf_model(path, limits, budget, loaded.report);
    const std::size_t chosen =
        model.defaultScene >= 0 ? static_cast<std::size_t>(model.defaultScene) : 0;
    if (chosen < model.scenes.size()) loaded.scene.name = model.scenes[chosen].name;
    GltfImages images(model, path.parent_path(), budget, limits, loaded.scene, loaded.report);
    const std::vector<int> coordinates = convert_materials(model, images, loaded);
    place_everything(model, coordinates, limits, loaded);
    note_unused_of_file(model, loaded.report);
    count_scene(loaded.scene, loaded.report);
    return loaded;
}

}  // namespace
}  // namespace detail

LoadedScene read_gltf(const std::filesystem::path& path, const Limits& limits) {
    return detail::naming_file(path, "glTF 2.0", [&] { return detail::load_gltf(path, limits); });
}

}  // namespace mir
