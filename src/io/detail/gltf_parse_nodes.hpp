// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_document.hpp"

#include <tiny_gltf.h>

#include <string>
#include <utility>
#include <vector>

namespace mir::detail {

inline std::vector<int> parse_indices(const GltfDocument& document, const GltfValue& from,
                                      const char* key, const char* kind) {
    std::vector<int> indices;
    const auto list = from.find(key);
    if (!list) return indices;
    const std::size_t size = list->size();
    const std::size_t count = document.count(kind);
    document.check_list(kind);
    indices.reserve(size);
    for (std::size_t i = 0; i < size; ++i) indices.push_back(list->index_at(i, kind, count));
    return indices;
}

inline void take_index(const GltfDocument& document, const GltfValue& from, const char* key,
                       const char* kind, int& to) {
    if (const auto value = from.find(key)) to = document.index(*value, kind);
}

inline tinygltf::Scene parse_scene(const GltfDocument& document, const GltfValue& from,
                                   bool is_shown) {
    tinygltf::Scene to;
    to.name = from.name();
    if (is_shown) to.nodes = parse_indices(document, from, "nodes", "node");
    take_extension_names(from, to.extensions);
    tinygltf::Value::Object extras;
    if (const auto given = extras_of(from)) take_presence(*given, "environment", extras);
    to.extras = tinygltf::Value(std::move(extras));
    return to;
}

inline tinygltf::Value parse_copies(const GltfDocument& document, const GltfValue& from) {
    tinygltf::Value::Object to;
    if (const auto given = from.find("attributes")) {
        tinygltf::Value::Object attributes;
        for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"})
            if (const auto accessor = given->find(name))
                attributes[name] = tinygltf::Value(document.index(*accessor, "accessor"));
        to["attributes"] = tinygltf::Value(std::move(attributes));
    }
    return tinygltf::Value(std::move(to));
}

inline tinygltf::Value parse_node_extension(const GltfDocument& document, const std::string& name,
                                            const GltfValue& from) {
    if (name == "EXT_mesh_gpu_instancing") return parse_copies(document, from);
    tinygltf::Value::Object to;
    if (name == "KHR_node_visibility") {
        bool visible = true;
        take(from, "visible", visible);
        to["visible"] = tinygltf::Value(visible);
    }
    if (name == "KHR_lights_punctual")
        to["light"] =
            tinygltf::Value(document.index(from.need("light", "a whole number"), "light"));
    return tinygltf::Value(std::move(to));
}

/// Everything of a node except its children, skin and morph weights.
inline void parse_node(const GltfDocument& document, const GltfValue& from, tinygltf::Node& to) {
    take(from, "matrix", 16, to.matrix);
    if (to.matrix.empty()) {
        take(from, "translation", 3, to.translation);
        take(from, "rotation", 4, to.rotation);
        take(from, "scale", 3, to.scale);
    }
    take_index(document, from, "mesh", "mesh", to.mesh);
    take_index(document, from, "camera", "camera", to.camera);
    take_extensions(from, to.extensions, [&](const std::string& name, const GltfValue& value) {
        return parse_node_extension(document, name, value);
    });
}

inline tinygltf::Skin parse_skin(const GltfDocument& document, const GltfValue& from) {
    tinygltf::Skin to;
    to.name = from.name();
    to.joints = parse_indices(document, from, "joints", "node");
    take_index(document, from, "inverseBindMatrices", "accessor", to.inverseBindMatrices);
    return to;
}

inline tinygltf::Camera parse_camera(const GltfValue& from) {
    tinygltf::Camera to;
    to.name = from.name();
    to.type = from.need("type", "text").text();
    if (to.type == "perspective") {
        const GltfValue lens = from.need("perspective", "an object");
        to.perspective.yfov = lens.need("yfov", "a number").number();
        take(lens, "aspectRatio", to.perspective.aspectRatio);
    }
    tinygltf::Value::Object extras;
    if (const auto given = extras_of(from)) {
        take_number(*given, "lens_radius", extras);
        take_number(*given, "focus_distance", extras);
        // A wish, which anything else may take the place of.
        const auto resolution = given->find("resolution");
        if (resolution && resolution->json().is_array() && resolution->json().size() == 2 &&
            resolution->json()[0].is_number() && resolution->json()[1].is_number())
            take_numbers(*given, "resolution", 2, extras);
    }
    to.extras = tinygltf::Value(std::move(extras));
    return to;
}

inline tinygltf::Light parse_light(const GltfValue& from) {
    tinygltf::Light to;
    to.name = from.name();
    to.type = from.need("type", "text").text();
    take(from, "color", 3, to.color);
    take(from, "intensity", to.intensity);
    // Only counted.
    if (const auto range = from.find("range"); range && range->json().is_number())
        to.range = range->number();
    if (to.type == "spot")
        if (const auto spot = from.find("spot")) {
            take(*spot, "innerConeAngle", to.spot.innerConeAngle);
            take(*spot, "outerConeAngle", to.spot.outerConeAngle);
        }
    tinygltf::Value::Object extras;
    if (const auto given = extras_of(from)) take_number(*given, "light_group", extras);
    to.extras = tinygltf::Value(std::move(extras));
    return to;
}

}  // namespace mir::detail
