// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/detail/obj_text.hpp"
#include "mir/io/detail/obj_textures.hpp"
#include "mir/io/detail/read_file.hpp"
#include "mir/io/detail/text_encoding.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace mir::detail {

/// Roughness whose GGX lobe is as wide as a Phong lobe of the given exponent: alpha^2 =
/// 2 / (exponent + 2). Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction
/// through rough surfaces", EGSR 2007, section 5.2.
inline float roughness_of_phong(float exponent) {
    return std::sqrt(std::sqrt(2.0f / (exponent + 2.0f)));
}

/// Reads the material libraries of one OBJ file through tinyobjloader and converts what they hold.
class ObjMaterials : public tinyobj::MaterialReader {
 public:
    ObjMaterials(const ObjText& text, const std::filesystem::path& folder, FileBudget& budget,
                 const Limits& limits, Scene& scene, SceneReport& report)
        : text_(text),
          folder_(folder),
          budget_(budget),
          scene_(scene),
          report_(report),
          textures_(folder, budget, limits, scene, report) {}

    /// Called by tinyobjloader for the first name behind `mtllib`: reads all libraries named there,
    /// or the one whose name has blanks. True: no other names need to be tried.
    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* by_name, std::string* warning,
                    std::string* error) override;

    /// Material of the scene; nothing when no library has one of this name, which is counted.
    [[nodiscard]] std::optional<std::uint32_t> find(const std::string& name) {
        const auto found = indices_.find(trimmed(name));
        if (found != indices_.end()) return found->second;
        ++report_.ignored["use of a material that no library has"];
        return std::nullopt;
    }

 private:
    using Keys = std::set<std::string, std::less<>>;
    /// What a material of the library says: its keywords, and the images among them that are read.
    struct Given : Keys {
        std::map<std::string, ObjTextureUse, std::less<>> images;
    };

    [[nodiscard]] bool exists(const std::string& library) const {
        std::error_code failure;
        return !library.empty() && std::filesystem::is_regular_file(folder_ / library, failure);
    }
    void read(const std::string& library);
    [[nodiscard]] std::string checked(const std::string& text, const std::string& library);
    bool check_numbers(std::string_view keyword, std::string_view line, const std::string& place);
    [[nodiscard]] Material convert(const tinyobj::material_t& from, const std::string& library);
    void interface_of(const tinyobj::material_t& from, const Keys& given, Material& to);
    void textures_of(const Given& given, Material& to);
    void note_unused(const tinyobj::material_t& from, const Keys& given);
    [[nodiscard]] Rgb factors(const float (&channels)[3], const char* what) {
        return {unit_factor(channels[0], what, place_, report_),
                unit_factor(channels[1], what, place_, report_),
                unit_factor(channels[2], what, place_, report_)};
    }

    const ObjText& text_;
    std::filesystem::path folder_;
    FileBudget& budget_;
    Scene& scene_;
    SceneReport& report_;
    std::map<std::string, std::uint32_t> indices_;
    ObjTextures textures_;
    std::map<std::string, Given> given_;  ///< by the names of the library's materials
    std::string place_;
};

inline bool ObjMaterials::operator()(const std::string&, std::vector<tinyobj::material_t>*,
                                     std::map<std::string, int>*, std::string*, std::string*) {
    if (exists(text_.libraries())) {
        read(text_.libraries());
        return true;
    }
    for_each_word(text_.libraries(), [&](std::string_view word) {
        const std::string library(word);
        if (exists(library))
            read(library);
        else
            ++report_.ignored["material library " + in_quotes(library) + " (not found)"];
    });
    return true;
}

inline void ObjMaterials::read(const std::string& library) {
    const std::string text = plain_lines(text_of(read_whole_file(folder_ / library, budget_)));
    given_.clear();
    textures_.begin_library(library);
    std::istringstream stream(checked(text, library));
    std::map<std::string, int> by_name;
    std::vector<tinyobj::material_t> materials;
    std::string ignored;
    tinyobj::LoadMtl(&by_name, &materials, &stream, &ignored, &ignored);
    for (const tinyobj::material_t& material : materials) {
        const std::string key = trimmed(material.name);
        // A library without materials gives one without name; of two with one name the first is
        // taken, as tinyobjloader does.
        if (key.empty() || indices_.contains(key)) continue;
        indices_[key] = scene_.add(convert(material, library));
    }
}

/// What tinyobjloader is to read of a library: lines that are used, with checked numbers. It takes
/// what is no number for zero and overflows at long exponents.
inline std::string ObjMaterials::checked(const std::string& text, const std::string& library) {
    std::istringstream stream(text);
    std::string kept;
    std::string line;
    Given* given = nullptr;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
        const std::string_view word = keyword_of(line);
        if (word.empty()) continue;
        const std::string_view rest = std::string_view(line).substr(
            static_cast<std::size_t>(word.data() - line.data()) + word.size());
        if (word == "newmtl") {
            given = &given_[trimmed(rest)];
            kept += line + '\n';
            continue;
        }
        const std::string place = library + ", line " + std::to_string(number);
        if (given != nullptr) {
            given->emplace(word);
            if (word == "map_Kd" || word == "map_Ke" || word == "map_d" || word == "norm") {
                const std::string key(word);
                given->images.try_emplace(key, read_texture_use(key, rest, place, report_));
            }
        }
        if (check_numbers(word, rest, place) || word == "illum") kept += line + '\n';
    }
    return kept;
}

/// False when the keyword is not one that numbers follow.
inline bool ObjMaterials::check_numbers(std::string_view keyword, std::string_view line,
                                        const std::string& place) {
    constexpr std::array<std::string_view, 9> numeric = {"Kd", "Ks", "Ke", "Ns", "Ni",
                                                         "d",  "Tr", "Pr", "Pm"};
    if (std::find(numeric.begin(), numeric.end(), keyword) == numeric.end()) return false;
    const std::string what(keyword);
    // Behind the numbers there may be a comment.
    const std::size_t wanted = keyword[0] == 'K' ? 3 : 1;
    std::size_t count = 0;
    for_each_word(line, [&](std::string_view word) {
        if (count++ >= wanted) return;
        (void)whole_number_token(word, what.c_str(), place);
        constexpr std::size_t longest_exponent = 8;
        const std::size_t e = std::min(word.find_first_of("eE"), word.size());
        if (word.size() - e > longest_exponent)
            fail_at(place, what + " has an exponent of many digits (" + in_quotes(word) +
                               "); repair the material");
    });
    if (count == 0) fail_at(place, what + " has no number; repair the material");
    return true;
}

inline Material ObjMaterials::convert(const tinyobj::material_t& from, const std::string& library) {
    Material to;
    to.name = trimmed(from.name);
    place_ = library + ", material '" + to.name + "'";
    const Given& given = given_[to.name];
    if (given.contains("Kd")) to.base_color = factors(from.diffuse, "Kd");
    to.emission = {checked_amount(from.emission[0], "Ke", place_),
                   checked_amount(from.emission[1], "Ke", place_),
                   checked_amount(from.emission[2], "Ke", place_)};
    textures_of(given, to);
    interface_of(from, given, to);
    note_unused(from, given);
    return to;
}

/// Ks weighs a dielectric interface, Ns or Pr roughens it; with Pr or Pm alone it is a whole one.
inline void ObjMaterials::interface_of(const tinyobj::material_t& from, const Keys& given,
                                       Material& to) {
    const bool matte = given.contains("illum") && (from.illum == 0 || from.illum == 1);
    const bool physical = given.contains("Pr") || given.contains("Pm");
    to.specular = physical && !given.contains("Ks") ? 1.0f : 0.0f;
    if (given.contains("Ks") && !matte) {
        const Rgb ks = factors(from.specular, "Ks");
        to.specular = (ks.r + ks.g + ks.b) / 3.0f;
        if (ks.r != ks.g || ks.g != ks.b) ++report_.ignored["colour of Ks (its mean is used)"];
    }
    to.metallic = unit_factor(from.metallic, "Pm", place_, report_);
    if (given.contains("Pr"))
        to.roughness = unit_factor(from.roughness, "Pr", place_, report_);
    else if (given.contains("Ns"))
        to.roughness = roughness_of_phong(checked_amount(from.shininess, "Ns", place_));
    // Exporters write 1 for "none", and nothing is below that.
    if (from.ior > 1.0f) to.ior = checked_float(from.ior, "Ni", place_);
}

/// Images multiply Kd and Ke, which are one where only the image is given.
inline void ObjMaterials::textures_of(const Given& given, Material& to) {
    const auto texture = [&](const char* key) {
        const auto found = given.images.find(key);
        return found == given.images.end() ? Texture{} : textures_.find(found->second);
    };
    MaterialTextures& t = to.textures;
    t.base_color = texture("map_Kd");
    if (const auto mask = given.images.find("map_d");
        mask != given.images.end() && textures_.cut(t.base_color, mask->second))
        to.alpha_cutoff = 0.5f;
    if (t.base_color.is_set() && !given.contains("Kd")) to.base_color = {1.0f, 1.0f, 1.0f};
    t.emission = texture("map_Ke");
    if (t.emission.is_set() && !given.contains("Ke")) to.emission = {1.0f, 1.0f, 1.0f};
    t.normal = texture("norm");
    if (t.normal.is_set()) t.normal_scale = given.images.find("norm")->second.bump;
}

inline void ObjMaterials::note_unused(const tinyobj::material_t& from, const Keys& given) {
    constexpr std::array<std::string_view, 20> read = {
        "Ka", "Kd", "Ks", "Ke",     "Ns",        "Ni",     "Pr",     "Pm",     "illum", "d",
        "Tr", "Tf", "Kt", "newmtl", "sharpness", "map_Ka", "map_Kd", "map_Ke", "map_d", "norm"};
    for (const std::string& key : given)
        if (std::find(read.begin(), read.end(), key) == read.end())
            ++report_.ignored["MTL " + in_quotes(key)];
    if (from.dissolve < 1.0f) ++report_.ignored["transparency (d, Tr)"];
}

}  // namespace mir::detail
