// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/mtl_text.hpp"
#include "io/detail/obj_text.hpp"
#include "io/detail/obj_textures.hpp"
#include "io/detail/outside.hpp"
#include "io/detail/read_file.hpp"
#include "io/detail/text_encoding.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_obj_loader.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

/// Roughness whose GGX lobe is as wide as a Phong lobe. With the given exponent alpha^2 = 2 /
/// (exponent + 2). Source: Walter, Marschner, Li, Torrance, "Microfacet models for refraction
/// through rough surfaces", EGSR 2007, section 5.2.
inline float roughness_of_phong(float exponent) {
    return std::sqrt(std::sqrt(2.0f / (exponent + 2.0f)));
}

/// The names in a list between blanks. A backslash before a blank makes it a part of the name.
inline std::vector<std::string> library_names(std::string_view list) {
    std::vector<std::string> names;
    bool open = false;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const auto is_blank = [&](std::size_t at) { return list[at] == ' ' || list[at] == '\t'; };
        const bool escapes = list[i] == '\\' && i + 1 < list.size() && is_blank(i + 1);
        if (escapes) ++i;
        const bool between = !escapes && is_blank(i);
        if (!between && !open) names.emplace_back();
        open = !between;
        if (open) names.back() += list[i];
    }
    return names;
}

/// Reads the material libraries of one OBJ file and converts what they hold. Images of a material
/// are read, and what it loses is counted, when a face uses it.
class ObjMaterials : public tinyobj::MaterialReader {
 public:
    ObjMaterials(const ObjText& text, const std::filesystem::path& folder, FileBudget& budget,
                 const Limits& limits, Scene& scene, SceneReport& report)
        : text_(text),
          folder_(folder),
          budget_(budget),
          allow_outside_(limits.allow_outside),
          scene_(scene),
          report_(report),
          textures_(folder, budget, limits, scene, report) {}

    /// Called by tinyobjloader for the first name behind `mtllib`. Reads all libraries named there,
    /// or the one whose name has blanks. True: no other names need to be tried.
    /// @throws Error(invalid_input) when one lies outside of the folder.
    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* by_name, std::string* warning,
                    std::string* error) override;

    /// Material of the scene. Nothing when no library has one of this name, which is counted.
    [[nodiscard]] std::optional<std::uint32_t> find(const std::string& name) {
        const auto found = indices_.find(trimmed(name));
        if (found != indices_.end()) return found->second;
        ++report_.ignored["use of a material that no library has"];
        return std::nullopt;
    }

    /// Completes a material that a face has.
    /// @throws Error(invalid_input) when it has values that mean nothing or an image of it is
    ///         broken; Error(limit_exceeded)
    void use(std::uint32_t material);

 private:
    /// A material that no face has had yet.
    struct Unused {
        MtlMaterial text;
        std::string read_from;  ///< name of its library
    };

    [[nodiscard]] bool exists(const std::string& library) const {
        std::error_code failure;
        return !library.empty() && std::filesystem::is_regular_file(folder_ / library, failure);
    }
    void check_inside(const std::string& library) const;
    void read(const std::string& library);
    void add(MtlMaterial text, const std::string& library);
    [[nodiscard]] Material converted(MtlMaterial& from);
    [[nodiscard]] Material convert(MtlMaterial& from);
    void interface_of(MtlMaterial& from, Material& to);
    void textures_of(const MtlMaterial& from, Material& to);
    void transparency(MtlMaterial& from, Material& to);
    [[nodiscard]] Rgb factors(MtlMaterial::Numbers channels, const char* what, SceneReport& lost) {
        return {unit_factor(channels[0], what, place_, lost),
                unit_factor(channels[1], what, place_, lost),
                unit_factor(channels[2], what, place_, lost)};
    }

    const ObjText& text_;
    std::filesystem::path folder_;
    FileBudget& budget_;
    bool allow_outside_;
    Scene& scene_;
    SceneReport& report_;
    std::map<std::string, std::uint32_t> indices_;
    std::map<std::uint32_t, Unused> unused_;
    std::set<std::filesystem::path> read_;  ///< libraries
    ObjTextures textures_;
    std::string place_;
};

inline bool ObjMaterials::operator()(const std::string&, std::vector<tinyobj::material_t>*,
                                     std::map<std::string, int>*, std::string*, std::string*) {
    if (exists(text_.libraries())) {
        read(text_.libraries());
        return true;
    }
    for (const std::string& library : library_names(text_.libraries())) {
        check_inside(library);
        if (exists(library))
            read(library);
        else
            ++report_.ignored["material library " + in_quotes(library) + " (not found)"];
    }
    return true;
}

inline void ObjMaterials::check_inside(const std::string& library) const {
    if (allow_outside_ || !leads_outside(folder_, library)) return;
    fail_at(text_.place(), "material library " + in_quotes(library) +
                               " lies outside of the folder of the OBJ file (a scene from a "
                               "stranger could look at any file); move it there, or allow it with "
                               "--allow-outside");
}

inline void ObjMaterials::read(const std::string& library) {
    check_inside(library);
    // Exporters name one library again and again.
    if (!read_.insert(resolved(folder_ / library)).second) return;
    const std::string text = plain_lines(text_of(read_whole_file(folder_ / library, budget_)));
    for (MtlMaterial& material : MtlText(library).read(text)) add(std::move(material), library);
}

/// Of two materials with one name the first is taken.
inline void ObjMaterials::add(MtlMaterial text, const std::string& library) {
    place_ = printable(library) + ", material " + in_quotes(text.name);
    Material material = converted(text);
    const auto known = indices_.find(text.name);
    if (known != indices_.end()) {
        const auto unused = unused_.find(known->second);
        ++(unused != unused_.end() ? unused->second.text.lost : report_).ignored[mtl_defined_twice];
        return;
    }
    const std::uint32_t index = scene_.add(std::move(material));
    indices_[text.name] = index;
    unused_[index] = {std::move(text), library};
}

inline void ObjMaterials::use(std::uint32_t material) {
    const auto node = unused_.extract(material);
    if (node.empty()) return;
    const Unused& from = node.mapped();
    if (from.text.failure) throw Error(*from.text.failure);
    for (const auto& [what, times] : from.text.lost.ignored) report_.ignored[what] += times;
    textures_.begin_library(from.read_from);
    textures_of(from.text, scene_.materials[material]);
}

/// What fails is kept for the first face that has the material.
inline Material ObjMaterials::converted(MtlMaterial& from) {
    try {
        if (!from.failure) return convert(from);
    } catch (const Error& failure) {
        from.failure = failure;
    }
    Material name_alone;
    name_alone.name = from.name;
    return name_alone;
}

inline Material ObjMaterials::convert(MtlMaterial& from) {
    Material to;
    to.name = from.name;
    if (const auto kd = from.find("Kd")) to.base_color = factors(*kd, "Kd", from.lost);
    if (const auto ke = from.find("Ke"))
        to.emission = {checked_amount((*ke)[0], "Ke", place_),
                       checked_amount((*ke)[1], "Ke", place_),
                       checked_amount((*ke)[2], "Ke", place_)};
    interface_of(from, to);
    transparency(from, to);
    return to;
}

/// Ks weighs a dielectric interface, Ns or Pr roughens it. With Pr or Pm alone it is a whole one.
inline void ObjMaterials::interface_of(MtlMaterial& from, Material& to) {
    const auto model = from.find("illum");
    const bool matte = model && ((*model)[0] == 0.0f || (*model)[0] == 1.0f);
    const auto ks = from.find("Ks");
    to.specular = (from.has("Pr") || from.has("Pm")) && !ks ? 1.0f : 0.0f;
    if (ks && !matte) {
        const Rgb weight = factors(*ks, "Ks", from.lost);
        to.specular = (weight.r + weight.g + weight.b) / 3.0f;
        if (weight.r != weight.g || weight.g != weight.b)
            ++from.lost.ignored["colour of Ks (its mean is used)"];
    }
    if (const auto pm = from.find("Pm"))
        to.metallic = unit_factor((*pm)[0], "Pm", place_, from.lost);
    if (const auto pr = from.find("Pr"))
        to.roughness = unit_factor((*pr)[0], "Pr", place_, from.lost);
    else if (const auto ns = from.find("Ns"))
        to.roughness = roughness_of_phong(checked_amount((*ns)[0], "Ns", place_));
    if (const auto pc = from.find("Pc"))
        to.clearcoat = unit_factor((*pc)[0], "Pc", place_, from.lost);
    if (const auto pcr = from.find("Pcr"))
        to.clearcoat_roughness = unit_factor((*pcr)[0], "Pcr", place_, from.lost);
    // Exporters write 1 for "none", and nothing is below that.
    if (const auto ni = from.find("Ni"); ni && (*ni)[0] > 1.0f) to.ior = (*ni)[0];
}

/// Images multiply Kd and Ke, which are one where only the image is given.
inline void ObjMaterials::textures_of(const MtlMaterial& from, Material& to) {
    const auto texture = [&](const char* key) {
        const auto found = from.images.find(key);
        return found == from.images.end() ? Texture{} : textures_.find(found->second);
    };
    MaterialTextures& t = to.textures;
    t.base_color = texture("map_Kd");
    if (const auto mask = from.images.find("map_d");
        mask != from.images.end() && textures_.cut(t.base_color, mask->second)) {
        to.alpha_cutoff = 0.5f;
        to.alpha = 1.0f;
        to.is_blended = false;
    }
    if (t.base_color.is_set() && !from.has("Kd")) to.base_color = {1.0f, 1.0f, 1.0f};
    t.emission = texture("map_Ke");
    if (t.emission.is_set() && !from.has("Ke")) to.emission = {1.0f, 1.0f, 1.0f};
    t.normal = texture("norm");
    if (t.normal.is_set()) t.normal_scale = from.images.find("norm")->second.bump;
}

/// Glass by its model, otherwise what is open by `d`, which counts before `Tr`. Models that refract
/// are bodies, others sheets. Exporters write 4, 6 and 9 for opaque or blended materials, too:
/// there a colour of the filter, or an index, must say the same. A filter that is black is none.
inline void ObjMaterials::transparency(MtlMaterial& from, Material& to) {
    const auto model = from.find("illum");
    const auto is_model = [&](float number) { return model && (*model)[0] == number; };
    if (is_model(10.0f)) ++from.lost.ignored["illum 10 (shadows on what is not seen)"];
    const MtlMaterial::Numbers white = {1.0f, 1.0f, 1.0f};
    const MtlMaterial::Numbers tf = from.find("Tf").value_or(white);
    const auto d = from.find("d");
    const auto tr = from.find("Tr");
    const float opacity = d ? (*d)[0] : tr ? 1.0f - (*tr)[0] : 1.0f;
    const bool has_index = from.find("Ni") && (*from.find("Ni"))[0] > 1.0f;
    const bool is_tinted = tf != white && tf != MtlMaterial::Numbers{0, 0, 0};
    const bool says_more = is_tinted || (has_index && !(opacity < 1.0f && opacity > 0.0f));
    const bool refracts = is_model(6.0f) || is_model(7.0f);
    if (says_more && (refracts || is_model(4.0f) || is_model(9.0f))) {
        const Rgb filter = factors(tf, "Tf", from.lost);
        to.base_color = is_black(filter) ? Rgb{1.0f, 1.0f, 1.0f} : filter;
        to.transmission = 1.0f;
        to.is_thin = !refracts;
        to.metallic = 0.0f;
        to.specular = 1.0f;
        if (!from.has("Pr")) to.roughness = 0.0f;
        return;
    }
    if (is_tinted) ++from.lost.ignored["Tf without a model of glass"];
    to.alpha = unit_factor(opacity, d ? "d" : "Tr", place_, from.lost);
    to.is_blended = to.alpha < 1.0f;
}

}  // namespace mir::detail
