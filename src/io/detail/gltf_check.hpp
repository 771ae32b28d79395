// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/check_input.hpp"

#include <tiny_gltf.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace mir::detail {

/// fail_at() under the name that says where the place is one of.
[[noreturn]] inline void gltf_fail(const std::string& place, const std::string& problem,
                                   ErrorCode code = ErrorCode::invalid_input) {
    fail_at(place, problem, code);
}

/// "node 3 'lamp'", for messages.
inline std::string gltf_place(const char* kind, std::size_t index, const std::string& name = {}) {
    std::string place = std::string(kind) + " " + std::to_string(index);
    if (!name.empty()) place += " " + in_quotes(name);
    return place;
}

/// @throws Error(invalid_input) when `index` is not one of `size` things called `kind`.
inline std::size_t checked_index(int index, std::size_t size, const char* kind,
                                 const std::string& place) {
    if (index >= 0 && static_cast<std::size_t>(index) < size)
        return static_cast<std::size_t>(index);
    gltf_fail(place, "it names " + std::string(kind) + " " + std::to_string(index) +
                         ", which does not exist (the file has " + std::to_string(size) +
                         "); repair the index");
}

// What tinygltf's Node::skin is beside an index.
inline constexpr int no_skin = -1;
inline constexpr int broken_skin = -2;

/// Number under `key` of an extension or of extras, `otherwise` when it is not there.
inline double number_or(const tinygltf::Value& object, const char* key, double otherwise,
                        const std::string& place) {
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsNumber())
        gltf_fail(place, "'" + std::string(key) + "' is not a number; repair the value");
    return value.GetNumberAsDouble();
}

/// Whole number under `key`, -1 when it is missing or of another kind. No index is negative.
inline int index_under(const tinygltf::Value& object, const char* key) {
    return object.Has(key) && object.Get(key).IsInt() ? object.Get(key).GetNumberAsInt() : -1;
}

/// Light group kept in extras, 0 when not given.
inline std::uint16_t light_group_of(const tinygltf::Value& extras, const std::string& place) {
    const double group = number_or(extras, "light_group", 0.0, place);
    if (!(group >= 0.0 && group <= 65535.0) || group != std::floor(group))
        gltf_fail(place, "extras.light_group is no whole number of 0..65535; repair the value");
    return static_cast<std::uint16_t>(group);
}

/// Extensions that no picture shows. Facts about the file, what a viewer does with a pointer, and
/// where animations lead, which stand still here.
inline bool is_never_seen(std::string_view name) {
    return name == "KHR_xmp_json_ld" || name == "KHR_xmp" || name == "EXT_mesh_manifold" ||
           name == "KHR_animation_pointer" || name == "KHR_node_hoverability" ||
           name == "KHR_node_selectability";
}

/// Counts an extension that is not read, where a picture would show it.
inline void count_extension(const std::string& name, SceneReport& report) {
    if (!is_never_seen(name)) ++report.ignored[name];
}

/// Extensions that change nothing but the look of materials may be required. What of them is not
/// supported is counted where it is used.
inline bool can_read_extension(std::string_view name) {
    if (name == "KHR_texture_basisu") return false;
    return is_never_seen(name) || name == "KHR_lights_punctual" ||
           name == "KHR_mesh_quantization" || name == "EXT_mesh_gpu_instancing" ||
           name == "KHR_node_visibility" || name.rfind("KHR_materials_", 0) == 0 ||
           name.find("_texture_") != std::string_view::npos;
}

/// Why a required extension is refused and what to do about it.
inline std::string extension_remedy(std::string_view name) {
    if (name == "KHR_draco_mesh_compression" ||
        name.find("meshopt_compression") != std::string_view::npos)
        return "(its meshes are compressed, and nothing here undoes that); export it without "
               "compression of meshes, or undo it with gltf-transform";
    if (name == "KHR_texture_basisu")
        return "(its images are KTX files, and only PNG and JPEG are read); export it with PNG or "
               "JPEG images";
    return "(this reader does not know that extension); export it without";
}

/// @throws Error(unsupported) by name.
inline void check_version_and_extensions(const tinygltf::Model& model) {
    const std::string& version = model.asset.version;
    const std::string& needed = model.asset.minVersion;
    if (version.rfind("2.", 0) != 0 || !(needed.empty() || needed == "2.0"))
        gltf_fail("asset",
                  "it is glTF " + (needed.empty() ? version : needed) +
                      " (this reader knows 2.0); export it as glTF 2.0",
                  ErrorCode::unsupported);
    for (const std::string& name : model.extensionsRequired)
        if (!can_read_extension(name))
            gltf_fail(
                "extensionsRequired",
                "the file cannot be read without " + in_quotes(name) + " " + extension_remedy(name),
                ErrorCode::unsupported);
}

}  // namespace mir::detail
