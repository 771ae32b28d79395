// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_value.hpp"

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

/// The lists of a glTF file, whose elements name each other by their number.
class GltfDocument {
 public:
    /// `json` must outlive this.
    explicit GltfDocument(const Json& json) : root_(json) {
        constexpr std::array<std::pair<const char*, const char*>, 13> names = {
            {{"node", "nodes"},
             {"mesh", "meshes"},
             {"accessor", "accessors"},
             {"bufferView", "bufferViews"},
             {"buffer", "buffers"},
             {"material", "materials"},
             {"texture", "textures"},
             {"sampler", "samplers"},
             {"image", "images"},
             {"camera", "cameras"},
             {"scene", "scenes"},
             {"skin", "skins"},
             {"animation", "animations"}}};
        for (const auto& [kind, list] : names) add(kind, list, root_);
        const auto extensions = root_.find("extensions");
        if (!extensions || !extensions->json().is_object()) return;
        const auto lights = extensions->find("KHR_lights_punctual");
        if (lights && lights->json().is_object()) add("light", "lights", *lights);
    }

    [[nodiscard]] const GltfValue& root() const { return root_; }

    /// Things called `kind` ("node", "light", ...). What is no list has none.
    [[nodiscard]] std::size_t count(std::string_view kind) const {
        const GltfValue* list = list_of(kind);
        return list != nullptr && list->json().is_array() ? list->json().size() : 0;
    }

    /// @pre index < count(kind)
    [[nodiscard]] GltfValue element(const char* kind, std::size_t index) const {
        return list_of(kind)->at(index).as(kind, index);
    }

    /// An index into the things called `kind`.
    /// @throws Error(invalid_input) when it is none, or the list is of another type.
    [[nodiscard]] int index(const GltfValue& value, const char* kind) const {
        check_list(kind);
        return value.index(kind, count(kind));
    }

    /// @throws Error(invalid_input) when the list of `kind` is there and no array.
    void check_list(std::string_view kind) const {
        if (const GltfValue* list = list_of(kind)) return (void)list->size();
        if (kind != "light") return;
        if (const auto extensions = root_.find("extensions"))
            if (const auto lights = extensions->find("KHR_lights_punctual"))
                (void)lights->find("lights");
    }

 private:
    struct List {
        std::string_view kind;
        GltfValue value;
    };

    void add(const char* kind, const char* name, const GltfValue& parent) {
        if (const auto list = parent.find(name)) lists_.push_back({kind, *list});
    }

    [[nodiscard]] const GltfValue* list_of(std::string_view kind) const {
        for (const List& list : lists_)
            if (list.kind == kind) return &list.value;
        return nullptr;
    }

    GltfValue root_;
    std::vector<List> lists_;
};

/// Overwrites `to` where the property is there.
inline void take(const GltfValue& from, const char* key, double& to) {
    if (const auto value = from.find(key)) to = value->number();
}

inline void take(const GltfValue& from, const char* key, bool& to) {
    if (const auto value = from.find(key)) to = value->truth();
}

inline void take(const GltfValue& from, const char* key, std::string& to) {
    if (const auto value = from.find(key)) to = value->text();
}

inline void take(const GltfValue& from, const char* key, std::size_t& to) {
    if (const auto value = from.find(key))
        to = static_cast<std::size_t>(value->whole(std::numeric_limits<std::size_t>::max()));
}

inline void take(const GltfValue& from, const char* key, int& to) {
    if (const auto value = from.find(key))
        to = static_cast<int>(value->whole(std::numeric_limits<int>::max()));
}

/// So many numbers, any number of them when `count` is 0.
inline void take(const GltfValue& from, const char* key, std::size_t count,
                 std::vector<double>& to) {
    if (const auto value = from.find(key)) to = value->numbers(count);
}

/// Members of an extension or of extras that are numbers, as tinygltf keeps them.
inline void take_number(const GltfValue& from, const char* key, tinygltf::Value::Object& to) {
    if (const auto value = from.find(key)) to[key] = tinygltf::Value(value->number());
}

inline void take_numbers(const GltfValue& from, const char* key, std::size_t count,
                         tinygltf::Value::Object& to) {
    const auto value = from.find(key);
    if (!value) return;
    tinygltf::Value::Array numbers;
    for (const double number : value->numbers(count)) numbers.emplace_back(number);
    to[key] = tinygltf::Value(std::move(numbers));
}

/// Notes that a member is there, of whatever type.
inline void take_presence(const GltfValue& from, const char* key, tinygltf::Value::Object& to) {
    if (from.find(key)) to[key] = tinygltf::Value(true);
}

/// Members of `extras`, which may be of any type and mean nothing then.
inline std::optional<GltfValue> extras_of(const GltfValue& from) {
    const auto extras = from.find("extras");
    return extras && extras->json().is_object() ? extras : std::nullopt;
}

/// The extensions of something, each made by `convert(name, value)`.
template <class Convert>
void take_extensions(const GltfValue& from, tinygltf::ExtensionMap& to, const Convert& convert) {
    const auto extensions = from.find("extensions");
    if (!extensions) return;
    if (!extensions->json().is_object()) extensions->fail_type("an object");
    for (const auto& member : extensions->json().items())
        to[member.key()] = convert(member.key(), *extensions->find(member.key().c_str()));
}

/// Names of extensions that nothing is read from, for the report.
inline void take_extension_names(const GltfValue& from, tinygltf::ExtensionMap& to) {
    const Json& json = from.json();
    const auto found = json.find("extensions");
    if (found == json.end() || !found->is_object()) return;
    for (const auto& member : found->items()) to[member.key()] = tinygltf::Value();
}

}  // namespace mir::detail
