// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_buffers.hpp"
#include "io/detail/gltf_document.hpp"
#include "io/detail/gltf_parse_data.hpp"
#include "io/detail/gltf_parse_nodes.hpp"
#include "io/detail/gltf_references.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mir::detail {

template <class Element>
void make_named_list(const GltfDocument& document, const char* kind, std::vector<Element>& list) {
    list.resize(document.count(kind));
    for (std::size_t i = 0; i < list.size(); ++i) list[i].name = document.element(kind, i).name();
}

/// Gives the lists of `model` their lengths, and names to some elements. These are the ones that a
/// picture knows even when it does not need them; returns it.
inline tinygltf::Model& make_lists(const GltfDocument& document, tinygltf::Model& model) {
    make_named_list(document, "node", model.nodes);
    make_named_list(document, "mesh", model.meshes);
    make_named_list(document, "material", model.materials);
    model.textures.resize(document.count("texture"));
    model.samplers.resize(document.count("sampler"));
    model.images.resize(document.count("image"));
    model.skins.resize(document.count("skin"));
    model.cameras.resize(document.count("camera"));
    model.lights.resize(document.count("light"));
    model.accessors.resize(document.count("accessor"));
    model.bufferViews.resize(document.count("bufferView"));
    model.buffers.resize(document.count("buffer"));
    model.animations.resize(document.count("animation"));
    model.scenes.resize(document.count("scene"));
    for (tinygltf::Material& material : model.materials) material.emissiveFactor = {0, 0, 0};
    return model;
}

/// Fills tinygltf's structures from the JSON of a file. What can be reached from the scene that is
/// shown, of the types that glTF asks for; the rest as far as it is in order. So a file is refused
/// for nothing that its picture does not need.
class GltfParser {
 public:
    GltfParser(const GltfDocument& document, GltfBuffers& buffers, tinygltf::Model& model)
        : document_(document),
          model_(make_lists(document, model)),
          data_(document, buffers, model) {
        document_.check_list("node");
        document_.check_list("scene");
        nodes_.resize(model_.nodes.size());
        meshes_.resize(model_.meshes.size());
        skinned_ = morphed_ = meshes_;
    }

    /// @throws Error(invalid_input) with the path of the property; Error(limit_exceeded)
    void parse() {
        parse_scenes();
        walk();
        parse_the_rest();
        check_references(document_);
    }

 private:
    void parse_scenes();
    [[nodiscard]] std::vector<int> roots() const;
    void walk();
    void parse_the_rest();

    void use_node(std::size_t i);
    void use_mesh(std::size_t i);
    void use_primitive(const GltfValue& from, std::size_t mesh, tinygltf::Primitive& to);
    void use_joints(const GltfValue& attributes, tinygltf::Primitive& to);
    void use_weights(const tinygltf::Node& node, std::size_t i);
    void use_skin(const GltfValue& from, tinygltf::Node& node);

    /// Reads what no picture needs: false, and nothing is refused, when it is broken.
    template <class Read>
    static bool tolerates(const Read& read) {
        try {
            read();
            return true;
        } catch (const Error& error) {
            if (error.code() == ErrorCode::limit_exceeded) throw;
            return false;
        }
    }

    const GltfDocument& document_;
    tinygltf::Model& model_;
    GltfData data_;
    std::vector<char> nodes_;    ///< those that are done
    std::vector<char> meshes_;   ///< those that are done
    std::vector<char> skinned_;  ///< meshes that a node has so
    std::vector<char> morphed_;  ///< meshes that a node has so
};

inline void GltfParser::parse_scenes() {
    const auto chosen = document_.root().find("scene");
    if (chosen && model_.scenes.empty()) (void)chosen->number();
    if (chosen && !model_.scenes.empty()) model_.defaultScene = document_.index(*chosen, "scene");
    const auto shown = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
    for (std::size_t i = 0; i < model_.scenes.size(); ++i) {
        const GltfValue from = document_.element("scene", i);
        if (i == shown)
            model_.scenes[i] = parse_scene(document_, from, true);
        else
            tolerates([&] { model_.scenes[i] = parse_scene(document_, from, false); });
    }
    take_extension_names(document_.root(), model_.extensions);
    // The tree is checked as a whole.
    for (std::size_t i = 0; i < model_.nodes.size(); ++i)
        tolerates([&] {
            model_.nodes[i].children =
                parse_indices(document_, document_.element("node", i), "children", "node");
        });
}

inline std::vector<int> GltfParser::roots() const {
    if (!model_.scenes.empty())
        return model_.scenes[static_cast<std::size_t>(std::max(model_.defaultScene, 0))].nodes;
    std::vector<char> is_child(model_.nodes.size(), 0);
    for (const tinygltf::Node& node : model_.nodes)
        for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = 1;
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i)
        if (is_child[i] == 0) roots.push_back(static_cast<int>(i));
    return roots;
}

inline void GltfParser::walk() {
    std::vector<int> open = roots();
    std::vector<std::size_t> with_mesh;
    while (!open.empty()) {
        const auto i = static_cast<std::size_t>(open.back());
        open.pop_back();
        if (std::exchange(nodes_[i], char{1}) != 0) continue;
        use_node(i);
        const tinygltf::Node& node = model_.nodes[i];
        open.insert(open.end(), node.children.begin(), node.children.end());
        if (node.mesh >= 0) with_mesh.push_back(static_cast<std::size_t>(node.mesh));
    }
    // All nodes first: they tell what of a mesh is needed.
    for (const std::size_t mesh : with_mesh) use_mesh(mesh);
}

inline void GltfParser::use_node(std::size_t i) {
    const GltfValue from = document_.element("node", i);
    tinygltf::Node& node = model_.nodes[i];
    node.children = parse_indices(document_, from, "children", "node");
    parse_node(document_, from, node);
    if (node.mesh >= 0) {
        use_weights(node, i);
        use_skin(from, node);
    }
    if (node.camera >= 0) {
        const auto camera = static_cast<std::size_t>(node.camera);
        model_.cameras[camera] = parse_camera(document_.element("camera", camera));
    }
    const auto light = node.extensions.find("KHR_lights_punctual");
    if (light != node.extensions.end()) {
        const auto at = static_cast<std::size_t>(index_under(light->second, "light"));
        model_.lights[at] = parse_light(document_.element("light", at));
    }
    const auto copies = node.extensions.find("EXT_mesh_gpu_instancing");
    if (copies != node.extensions.end() && copies->second.Has("attributes"))
        for (const auto& name : copies->second.Get("attributes").Keys())
            data_.accessor(copies->second.Get("attributes").Get(name).GetNumberAsInt());
}

inline void GltfParser::use_mesh(std::size_t i) {
    if (meshes_[i] != 0) return;
    const GltfValue from = document_.element("mesh", i);
    tinygltf::Mesh& mesh = model_.meshes[i];
    const auto list = from.find("primitives");
    const std::size_t count = list ? list->size() : 0;
    if (count == 0)
        gltf_fail(gltf_place("mesh", i, mesh.name),
                  "it has no list of primitives (glTF asks for one at least); repair it");
    std::vector<tinygltf::Primitive> primitives(count);
    for (std::size_t k = 0; k < count; ++k)
        use_primitive(list->at(k).as("primitive", k), i, primitives[k]);
    mesh.primitives = std::move(primitives);
    meshes_[i] = 1;
}

inline void GltfParser::use_primitive(const GltfValue& from, std::size_t mesh,
                                      tinygltf::Primitive& to) {
    parse_primitive(document_, from, to);
    for (const auto& [name, accessor] : to.attributes) data_.accessor(accessor);
    if (to.indices >= 0) data_.accessor(to.indices);
    if (to.attributes.empty()) return;
    if (morphed_[mesh] != 0) {
        parse_targets(document_, from, to);
        for (const auto& target : to.targets)
            for (const auto& [name, accessor] : target) data_.accessor(accessor);
    }
    if (skinned_[mesh] != 0) use_joints(*from.find("attributes"), to);
    if (to.material < 0) return;
    data_.material(static_cast<std::size_t>(to.material));
    const auto& material = model_.materials[static_cast<std::size_t>(to.material)];
    const auto sets = coordinate_sets(material);
    for (const auto& [name, accessor] :
         parse_attributes(document_, *from.find("attributes"), sets)) {
        data_.accessor(accessor);
        to.attributes[name] = accessor;
    }
}

inline void GltfParser::use_joints(const GltfValue& attributes, tinygltf::Primitive& to) {
    for (std::size_t set = 0;; ++set) {
        const std::string number = std::to_string(set);
        const auto found =
            parse_attributes(document_, attributes, {"JOINTS_" + number, "WEIGHTS_" + number});
        if (found.size() != 2) return;
        for (const auto& [name, accessor] : found) {
            data_.accessor(accessor);
            to.attributes[name] = accessor;
        }
    }
}

/// Weights of morph targets that are zero move nothing, and then no target is needed.
inline void GltfParser::use_weights(const tinygltf::Node& node, std::size_t i) {
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const auto is_set = [](double weight) { return weight != 0.0; };
    if (!has_targets(document_.element("mesh", mesh))) return;
    take(document_.element("node", i), "weights", 0, model_.nodes[i].weights);
    take(document_.element("mesh", mesh), "weights", 0, model_.meshes[mesh].weights);
    const auto& weights = node.weights.empty() ? model_.meshes[mesh].weights : node.weights;
    if (std::any_of(weights.begin(), weights.end(), is_set)) morphed_[mesh] = 1;
}

/// A skin that cannot be used is no reason to refuse a picture. Its mesh stands as stored.
inline void GltfParser::use_skin(const GltfValue& from, tinygltf::Node& node) {
    const auto given = from.find("skin");
    if (!given) return;
    node.skin = broken_skin;
    tolerates([&] {
        const int index = document_.index(*given, "skin");
        const auto i = static_cast<std::size_t>(index);
        model_.skins[i] = parse_skin(document_, document_.element("skin", i));
        if (model_.skins[i].inverseBindMatrices >= 0)
            data_.accessor(model_.skins[i].inverseBindMatrices);
        node.skin = index;
        skinned_[static_cast<std::size_t>(node.mesh)] = 1;
    });
}

/// Meshes and materials that no node of the scene has. Kept where they are in order.
inline void GltfParser::parse_the_rest() {
    for (std::size_t i = 0; i < meshes_.size(); ++i)
        if (meshes_[i] == 0 && !tolerates([&] { use_mesh(i); })) model_.meshes[i].primitives = {};
    for (std::size_t i = 0; i < model_.materials.size(); ++i) {
        if (data_.has_material(i)) continue;
        tinygltf::Material material = model_.materials[i];
        if (!tolerates(
                [&] { parse_material(document_, document_.element("material", i), material); }))
            continue;
        // Nobody sees its textures.
        material.pbrMetallicRoughness.baseColorTexture = {};
        material.pbrMetallicRoughness.metallicRoughnessTexture = {};
        material.normalTexture = {};
        material.emissiveTexture = {};
        drop_extension_textures(material.extensions);
        model_.materials[i] = std::move(material);
    }
}

}  // namespace mir::detail
