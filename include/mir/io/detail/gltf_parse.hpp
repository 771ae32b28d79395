// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/detail/gltf_buffers.hpp"
#include "mir/io/detail/gltf_document.hpp"
#include "mir/io/detail/gltf_parse_materials.hpp"
#include "mir/io/detail/gltf_parse_meshes.hpp"
#include "mir/io/detail/gltf_parse_nodes.hpp"
#include "mir/io/detail/gltf_references.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mir::detail {

/// Fills tinygltf's structures from the JSON of a file: what can be reached from the scene that is
/// shown, of the types that glTF asks for; the rest as far as it is in order. So a file is refused
/// for nothing that its picture does not need.
class GltfParser {
 public:
    GltfParser(const GltfDocument& document, GltfBuffers& buffers, tinygltf::Model& model)
        : document_(document), buffers_(buffers), model_(model) {}

    /// @throws Error(invalid_input) with the path of the property; Error(limit_exceeded)
    void parse() {
        make_lists();
        parse_scenes();
        walk();
        parse_the_rest();
        check_references(document_);
    }

 private:
    template <class Element>
    void make_list(const char* kind, std::vector<Element>& list) {
        list.resize(document_.count(kind));
        for (std::size_t i = 0; i < list.size(); ++i)
            list[i].name = document_.element(kind, i).name();
    }

    void make_lists();
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
    void use_material(std::size_t i);
    void use_texture(int index);
    void use_image(int index);
    void use_accessor(int index);
    void use_view(int index);

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
    GltfBuffers& buffers_;
    tinygltf::Model& model_;
    // What is done, for each element of a list.
    std::vector<char> nodes_;
    std::vector<char> meshes_;
    std::vector<char> materials_;
    std::vector<char> textures_;
    std::vector<char> images_;
    std::vector<char> accessors_;
    std::vector<char> views_;
    std::vector<char> data_;               ///< of buffers
    std::vector<char> skinned_, morphed_;  ///< meshes that a node has so
};

inline void GltfParser::make_lists() {
    for (const char* kind : {"node", "scene"}) document_.check_list(kind);
    make_list("node", model_.nodes);
    make_list("mesh", model_.meshes);
    make_list("material", model_.materials);
    make_list("texture", model_.textures);
    make_list("sampler", model_.samplers);
    make_list("image", model_.images);
    make_list("skin", model_.skins);
    make_list("camera", model_.cameras);
    make_list("light", model_.lights);
    make_list("accessor", model_.accessors);
    make_list("bufferView", model_.bufferViews);
    make_list("buffer", model_.buffers);
    model_.animations.resize(document_.count("animation"));
    model_.scenes.resize(document_.count("scene"));
    nodes_.resize(model_.nodes.size());
    meshes_.resize(model_.meshes.size());
    skinned_ = morphed_ = meshes_;
    materials_.resize(model_.materials.size());
    textures_.resize(model_.textures.size());
    images_.resize(model_.images.size());
    accessors_.resize(model_.accessors.size());
    views_.resize(model_.bufferViews.size());
    data_.resize(model_.buffers.size());
    for (tinygltf::Material& material : model_.materials) material.emissiveFactor = {0, 0, 0};
}

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
            use_accessor(copies->second.Get("attributes").Get(name).GetNumberAsInt());
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
    for (const auto& [name, accessor] : to.attributes) use_accessor(accessor);
    if (to.indices >= 0) use_accessor(to.indices);
    if (to.attributes.empty()) return;
    if (morphed_[mesh] != 0) {
        parse_targets(document_, from, to);
        for (const auto& target : to.targets)
            for (const auto& [name, accessor] : target) use_accessor(accessor);
    }
    if (skinned_[mesh] != 0) use_joints(*from.find("attributes"), to);
    if (to.material < 0) return;
    use_material(static_cast<std::size_t>(to.material));
    const auto& material = model_.materials[static_cast<std::size_t>(to.material)];
    const auto sets = coordinate_sets(material);
    for (const auto& [name, accessor] :
         parse_attributes(document_, *from.find("attributes"), sets)) {
        use_accessor(accessor);
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
            use_accessor(accessor);
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

/// A skin that cannot be used is no reason to refuse a picture: its mesh stands as it is stored.
inline void GltfParser::use_skin(const GltfValue& from, tinygltf::Node& node) {
    const auto given = from.find("skin");
    if (!given) return;
    node.skin = broken_skin;
    tolerates([&] {
        const int index = document_.index(*given, "skin");
        const auto i = static_cast<std::size_t>(index);
        model_.skins[i] = parse_skin(document_, document_.element("skin", i));
        if (model_.skins[i].inverseBindMatrices >= 0)
            use_accessor(model_.skins[i].inverseBindMatrices);
        node.skin = index;
        skinned_[static_cast<std::size_t>(node.mesh)] = 1;
    });
}

inline void GltfParser::use_material(std::size_t i) {
    if (materials_[i] != 0) return;
    tinygltf::Material material = model_.materials[i];
    parse_material(document_, document_.element("material", i), material);
    use_texture(material.pbrMetallicRoughness.baseColorTexture.index);
    use_texture(material.pbrMetallicRoughness.metallicRoughnessTexture.index);
    use_texture(material.normalTexture.index);
    use_texture(material.emissiveTexture.index);
    model_.materials[i] = std::move(material);
    materials_[i] = 1;
}

inline void GltfParser::use_texture(int index) {
    if (index < 0 || textures_[static_cast<std::size_t>(index)] != 0) return;
    const auto i = static_cast<std::size_t>(index);
    model_.textures[i] = parse_texture(document_, document_.element("texture", i));
    if (const int sampler = model_.textures[i].sampler; sampler >= 0) {
        const auto at = static_cast<std::size_t>(sampler);
        model_.samplers[at] = parse_sampler(document_.element("sampler", at));
    }
    use_image(model_.textures[i].source);
    textures_[i] = 1;
}

inline void GltfParser::use_image(int index) {
    if (index < 0 || images_[static_cast<std::size_t>(index)] != 0) return;
    const auto i = static_cast<std::size_t>(index);
    model_.images[i] = parse_image(document_, document_.element("image", i), i);
    use_view(model_.images[i].bufferView);
    images_[i] = 1;
}

inline void GltfParser::use_accessor(int index) {
    const auto i = static_cast<std::size_t>(index);
    if (accessors_[i] != 0) return;
    model_.accessors[i] = parse_accessor(document_, document_.element("accessor", i));
    const tinygltf::Accessor& accessor = model_.accessors[i];
    use_view(accessor.bufferView);
    if (accessor.sparse.isSparse) {
        use_view(accessor.sparse.indices.bufferView);
        use_view(accessor.sparse.values.bufferView);
    }
    accessors_[i] = 1;
}

inline void GltfParser::use_view(int index) {
    if (index < 0 || views_[static_cast<std::size_t>(index)] != 0) return;
    const auto i = static_cast<std::size_t>(index);
    model_.bufferViews[i] = parse_buffer_view(document_, document_.element("bufferView", i));
    const auto buffer = static_cast<std::size_t>(model_.bufferViews[i].buffer);
    if (data_[buffer] == 0)
        model_.buffers[buffer].data = buffers_.load(document_.element("buffer", buffer), buffer);
    data_[buffer] = views_[i] = 1;
}

/// Meshes and materials that no node of the scene has: kept where they are in order.
inline void GltfParser::parse_the_rest() {
    for (std::size_t i = 0; i < meshes_.size(); ++i)
        if (meshes_[i] == 0 && !tolerates([&] { use_mesh(i); })) model_.meshes[i].primitives = {};
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        if (materials_[i] != 0) continue;
        tinygltf::Material material = model_.materials[i];
        if (!tolerates(
                [&] { parse_material(document_, document_.element("material", i), material); }))
            continue;
        // Nobody sees its textures.
        material.pbrMetallicRoughness.baseColorTexture = {};
        material.pbrMetallicRoughness.metallicRoughnessTexture = {};
        material.normalTexture = {};
        material.emissiveTexture = {};
        model_.materials[i] = std::move(material);
    }
}

}  // namespace mir::detail
