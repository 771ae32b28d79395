// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/obj_texture_use.hpp"
#include "io/detail/text_lines.hpp"
#include "io/detail/text_number.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

/// What the lines of one material of a library say.
struct MtlMaterial {
    using Numbers = std::array<float, 3>;

    std::string name;
    /// By keywords; what has one number has it three times. Kt is found as Tf.
    std::map<std::string, Numbers, std::less<>> numbers;
    std::map<std::string, ObjTextureUse, std::less<>> images;
    SceneReport lost;              ///< `ignored`: what is not read of it
    std::optional<Error> failure;  ///< of the first line that means nothing

    [[nodiscard]] std::optional<Numbers> find(std::string_view keyword) const {
        const auto found = numbers.find(keyword);
        return found == numbers.end() ? std::nullopt : std::optional(found->second);
    }
    [[nodiscard]] bool has(std::string_view keyword) const { return numbers.contains(keyword); }
};

/// True when the word is in the list.
template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

inline constexpr const char* mtl_defined_twice = "material defined twice (the first is used)";

/// Reads the statements of one material library. tinyobjloader's own reader knows no line numbers,
/// takes what is no number for zero, leaves green and blue black where red is meant for all, and
/// overflows at long exponents.
class MtlText {
 public:
    explicit MtlText(std::string library) : library_(std::move(library)) {}

    /// The materials in their order, each name once, with their failures. A failure is of no matter
    /// until a face has the material. `text` has plain_lines().
    [[nodiscard]] std::vector<MtlMaterial> read(const std::string& text);

 private:
    void begin(const std::string& name);
    void keep_failure(std::string_view keyword, std::string_view rest);
    void statement(std::string_view keyword, std::string_view rest);
    void color(std::string_view keyword, std::string_view rest);
    void number(std::string_view keyword, std::string_view rest);
    void opacity(std::string_view rest);
    void model(std::string_view rest);
    void image(std::string_view keyword, std::string_view rest);
    /// Numbers at the front of `rest`, at most `most`, up to a comment.
    [[nodiscard]] std::vector<float> numbers(std::string_view keyword, std::string_view rest,
                                             std::size_t most) const;
    void ignore(const std::string& what) { to_->lost.ignored[what] = 1; }
    void ignore_empty(std::string_view keyword) {
        ignore("MTL " + in_quotes(keyword) + " without a value");
    }

    std::string library_;
    std::string place_;
    std::vector<MtlMaterial> materials_;
    MtlMaterial unused_;  ///< takes lines before the first material, and those of second ones
    MtlMaterial* to_ = &unused_;
};

inline std::vector<MtlMaterial> MtlText::read(const std::string& text) {
    std::istringstream stream(text);
    std::string line;
    for (std::size_t count = 1; std::getline(stream, line); ++count) {
        const std::string_view keyword = keyword_of(line);
        if (keyword.empty()) continue;
        place_ = printable(library_) + ", line " + std::to_string(count);
        keep_failure(keyword,
                     std::string_view(line).substr(
                         static_cast<std::size_t>(keyword.data() - line.data()) + keyword.size()));
    }
    return std::move(materials_);
}

inline void MtlText::keep_failure(std::string_view keyword, std::string_view rest) {
    try {
        statement(keyword, rest);
    } catch (const Error& failure) {
        if (!to_->failure) to_->failure = failure;
    }
}

inline void MtlText::begin(const std::string& name) {
    to_ = &unused_;
    // Nothing can use a material without a name.
    if (name.empty()) return;
    const auto known = std::find_if(materials_.begin(), materials_.end(),
                                    [&](const MtlMaterial& m) { return m.name == name; });
    if (known != materials_.end()) {
        ++known->lost.ignored[mtl_defined_twice];
        return;
    }
    materials_.emplace_back();
    to_ = &materials_.back();
    to_->name = name;
}

inline void MtlText::statement(std::string_view keyword, std::string_view rest) {
    constexpr std::array<std::string_view, 5> colors = {"Kd", "Ks", "Ke", "Tf", "Kt"};
    constexpr std::array<std::string_view, 7> numbers = {"Ns", "Ni", "Tr", "Pr", "Pm", "Pc", "Pcr"};
    constexpr std::array<std::string_view, 4> images = {"map_Kd", "map_Ke", "map_d", "norm"};
    constexpr std::array<std::string_view, 3> meaningless = {"Ka", "sharpness", "map_Ka"};
    if (keyword == "newmtl") return begin(trimmed(rest));
    if (keyword == "d") return opacity(rest);
    if (keyword == "illum") return model(rest);
    if (is_one_of(keyword, colors)) return color(keyword, rest);
    if (is_one_of(keyword, numbers)) return number(keyword, rest);
    if (is_one_of(keyword, images)) return image(keyword, rest);
    if (!is_one_of(keyword, meaningless)) ignore("MTL " + in_quotes(keyword));
}

inline std::vector<float> MtlText::numbers(std::string_view keyword, std::string_view rest,
                                           std::size_t most) const {
    std::vector<float> found;
    bool ended = false;
    for_each_word(rest, [&](std::string_view word) {
        ended = ended || found.size() == most || word.starts_with('#');
        if (!ended) found.push_back(whole_number_token(word, std::string(keyword).c_str(), place_));
    });
    return found;
}

/// One number stands for all three.
inline void MtlText::color(std::string_view keyword, std::string_view rest) {
    std::string_view line = rest;
    const std::string_view form = take_word(line);
    if (form == "spectral" || form == "xyz")
        return ignore("MTL '" + std::string(keyword) + " " + std::string(form) + "'");
    const std::vector<float> found = numbers(keyword, rest, 3);
    if (found.empty()) return ignore_empty(keyword);
    if (found.size() == 2)
        fail_at(place_, std::string(keyword) +
                            " has 2 numbers (a colour has three, or one for all of them); repair "
                            "the material");
    to_->numbers[std::string(keyword == "Kt" ? "Tf" : keyword)] = {
        found.front(), found[found.size() / 2], found.back()};
}

inline void MtlText::number(std::string_view keyword, std::string_view rest) {
    const std::vector<float> found = numbers(keyword, rest, 1);
    if (found.empty()) return ignore_empty(keyword);
    to_->numbers[std::string(keyword)] = {found[0], found[0], found[0]};
}

inline void MtlText::opacity(std::string_view rest) {
    std::string_view behind = rest;
    const bool halo = take_word(behind) == "-halo";
    if (halo) ignore("MTL option '-halo'");
    number("d", halo ? behind : rest);
}

/// Nothing of the picture hangs on a model that is none.
inline void MtlText::model(std::string_view rest) {
    const auto found = leading_number(take_word(rest));
    if (!found) return ignore_empty("illum");
    const auto value = static_cast<float>(found->value);
    to_->numbers["illum"] = {value, value, value};
}

inline void MtlText::image(std::string_view keyword, std::string_view rest) {
    const std::string key(keyword);
    ObjTextureUse use = read_texture_use(key, rest, place_, to_->lost);
    if (use.file.empty()) return ignore_empty(keyword);
    to_->images.try_emplace(key, std::move(use));
}

}  // namespace mir::detail
