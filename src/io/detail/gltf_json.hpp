// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/limits.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

using Json = nlohmann::json;

/// Extensions that are read beyond their name.
inline bool is_read_extension(std::string_view name) {
    constexpr std::array<std::string_view, 12> known = {"EXT_mesh_gpu_instancing",
                                                        "KHR_lights_punctual",
                                                        "KHR_materials_clearcoat",
                                                        "KHR_materials_diffuse_transmission",
                                                        "KHR_materials_emissive_strength",
                                                        "KHR_materials_ior",
                                                        "KHR_materials_pbrSpecularGlossiness",
                                                        "KHR_materials_specular",
                                                        "KHR_materials_transmission",
                                                        "KHR_materials_volume",
                                                        "KHR_node_visibility",
                                                        "KHR_texture_transform"};
    return std::find(known.begin(), known.end(), name) != known.end();
}

/// Builds and counts the values of a glTF file, for nlohmann's parser. They are those that
/// something may be read from. Everything else, most of `extras`, the inside of animations and of
/// unknown extensions, takes no memory, whatever its size.
class GltfJsonBuilder {
 public:
    /// `text` is what is parsed, for messages.
    GltfJsonBuilder(std::string_view text, const Limits& limits) : text_(text), limits_(limits) {}

    [[nodiscard]] Json take() { return std::move(root_); }

    // What nlohmann's parser calls; `true` goes on.
    bool null() { return store(nullptr); }
    bool boolean(bool value) { return store(value); }
    bool number_integer(Json::number_integer_t value) { return store(value); }
    bool number_unsigned(Json::number_unsigned_t value) { return store(value); }
    bool number_float(Json::number_float_t value, const std::string&) { return store(value); }
    bool string(std::string& value) { return store(std::move(value)); }
    bool binary(Json::binary_t&) { return true; }
    bool start_object(std::size_t) { return open(Json::object()); }
    bool end_object() { return close(); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_array() { return close(); }
    bool key(std::string& name);
    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::detail::exception& why);

 private:
    /// A list or an object that is not finished. Its parent does not grow meanwhile.
    struct Open {
        Json* value;
        std::string key;
    };
    enum class Keep { all, name, nothing };

    template <class Value>
    bool store(Value&& value) {
        if (Json* place = slot(false)) *place = std::forward<Value>(value);
        return true;
    }

    bool open(Json empty) {
        check_depth();
        Json* place = slot(empty.is_object());
        if (place == nullptr) {
            ++skipped_;
            return true;
        }
        *place = std::move(empty);
        open_.push_back({place, key_});
        key_.clear();
        return true;
    }

    bool close() {
        --depth_;
        if (skipped_ > 0)
            --skipped_;
        else
            open_.pop_back();
        return true;
    }

    void check_depth() {
        constexpr std::size_t deepest = 200;
        if (++depth_ > deepest)
            throw Error(ErrorCode::invalid_input,
                        "its JSON: nested more than " + std::to_string(deepest) +
                            " levels deep (no scene needs that); repair the file");
    }

    [[nodiscard]] Json* slot(bool is_object);
    void count(bool is_object);
    [[nodiscard]] bool is_open(std::size_t depth, std::string_view key) const {
        return open_.size() > depth && open_[depth].key == key;
    }
    [[nodiscard]] Keep keep(std::string_view name) const;
    [[nodiscard]] bool has_extras_to_read() const;

    std::string_view text_;
    const Limits& limits_;
    Json root_;
    std::vector<Open> open_;
    std::string key_;          ///< of the value that comes next
    Json* member_ = nullptr;   ///< where that goes
    bool skips_next_ = false;  ///< that goes nowhere
    std::size_t skipped_ = 0;  ///< levels that are open and go nowhere
    std::size_t depth_ = 0;
    std::uint64_t values_ = 0;
};

/// The place of the value that comes next, nullptr when nothing is read from it.
inline Json* GltfJsonBuilder::slot(bool is_object) {
    if (skipped_ > 0) return nullptr;
    if (std::exchange(skips_next_, false)) return nullptr;
    count(is_object);
    if (open_.empty()) return &root_;
    Json& parent = *open_.back().value;
    if (!parent.is_array()) return member_;
    parent.push_back(nullptr);
    // Animations are counted, no more.
    if (open_.size() == 2 && open_[1].key == "animations") return nullptr;
    return &parent.back();
}

/// Structures that are made of an element of a list are larger than its JSON. An empty material
/// takes two kilobytes.
inline void GltfJsonBuilder::count(bool is_object) {
    std::uint64_t cost = 1;
    if (is_object && !open_.empty() && open_.back().value->is_array()) {
        const std::string& list = open_.back().key;
        cost = list == "materials" || list == "cameras" || list == "lights" ? 24 : 4;
    }
    values_ += cost;
    check_limit(values_, limits_.json_values, "json_values");
}

inline bool GltfJsonBuilder::has_extras_to_read() const {
    if (open_.size() == 5) return is_open(3, "lights");
    return open_.size() == 3 &&
           (is_open(1, "materials") || is_open(1, "cameras") || is_open(1, "scenes"));
}

inline GltfJsonBuilder::Keep GltfJsonBuilder::keep(std::string_view name) const {
    const auto is_one_of = [&](std::initializer_list<std::string_view> list) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    const std::string_view above = open_.back().key;
    if (name == "extras") return has_extras_to_read() ? Keep::all : Keep::nothing;
    if (above == "extensions") return is_read_extension(name) ? Keep::all : Keep::name;
    if (above == "extras") {
        if (is_one_of({"light_group", "lens_radius", "focus_distance", "resolution"}))
            return Keep::all;
        return name == "environment" ? Keep::name : Keep::nothing;
    }
    if (open_.size() == 1)
        return is_one_of({"accessors", "animations", "asset", "bufferViews", "buffers", "cameras",
                          "extensions", "extensionsRequired", "images", "materials", "meshes",
                          "nodes", "samplers", "scene", "scenes", "skins", "textures"})
                   ? Keep::all
                   : Keep::nothing;
    // Of accessors: bounds that nothing relies on.
    return is_one_of({"min", "max"}) && is_open(1, "accessors") ? Keep::nothing : Keep::all;
}

inline bool GltfJsonBuilder::key(std::string& name) {
    if (skipped_ > 0) return true;
    const Keep kept = keep(name);
    skips_next_ = kept != Keep::all;
    if (kept == Keep::nothing) return true;
    auto& members = *open_.back().value->get_ptr<Json::object_t*>();
    const auto [at, is_new] = members.try_emplace(name, nullptr);
    if (!is_new)
        throw Error(ErrorCode::invalid_input,
                    "its JSON: the key '" + name.substr(0, 40) + "' stands twice in one object" +
                        (open_.back().key.empty() ? "" : " ('" + open_.back().key + "')") +
                        " (glTF asks for names that differ); remove one of them");
    if (kept == Keep::name) count(false);
    member_ = &at->second;
    key_ = std::move(name);
    return true;
}

/// The parser's complaint, with the place in the text, safe for terminals.
inline bool GltfJsonBuilder::parse_error(std::size_t position, const std::string&,
                                         const nlohmann::detail::exception& why) {
    // The last character that was read is the one that is wrong.
    const std::string_view before = text_.substr(0, position == 0 ? 0 : position - 1);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n');
    const std::size_t column =
        before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1;
    std::string reason = why.what();
    const std::size_t place = reason.find("column ");
    const std::size_t words = reason.find(place == std::string::npos ? "] " : ": ",
                                          place == std::string::npos ? 0 : place);
    if (words != std::string::npos) reason.erase(0, words + 2);
    reason = reason.substr(0, 160);
    for (char& c : reason)
        if (c < ' ' || c > '~') c = '?';
    throw Error(ErrorCode::invalid_input,
                "it is no valid glTF 2.0 file (its JSON is broken at line " + std::to_string(line) +
                    ", column " + std::to_string(column) + ": " + reason +
                    "); repair or export it again");
}

/// The values of a JSON text that something is read from.
/// @throws Error(invalid_input) with line and column; Error(limit_exceeded) before there are more
///         values than `limits` allows.
inline Json parse_gltf_json(std::string_view text, const Limits& limits) {
    GltfJsonBuilder builder(text, limits);
    Json::sax_parse(text.begin(), text.end(), &builder);
    Json root = builder.take();
    if (!root.is_object())
        throw Error(ErrorCode::invalid_input,
                    "it is no valid glTF 2.0 file (its JSON is no object); repair or export it "
                    "again");
    return root;
}

}  // namespace mir::detail
