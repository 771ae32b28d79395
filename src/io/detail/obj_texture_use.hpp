// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/text_lines.hpp"
#include "io/detail/text_number.hpp"
#include "mir/scene/texture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mir::detail {

/// What stands behind a keyword like map_Kd. An image and how it lies on the surface.
struct ObjTextureUse {
    std::string file;     ///< as the library names it, with slashes
    std::string place;    ///< line of the library, for messages
    Vec2 scale{1.0f};     ///< -s: factors of the texture coordinates
    Vec2 offset{0.0f};    ///< -o: added to them then
    bool clamp = false;   ///< -clamp on
    float bump = 1.0f;    ///< -bm
    char channel = '\0';  ///< -imfchan; zero: not given
};

/// An option of a texture with the smallest and the largest number of its values.
struct ObjTextureOption {
    std::string_view name;
    std::size_t least;
    std::size_t most;
};

/// The option that `word` is. Nullptr when it is none, but the beginning of a file's name.
inline const ObjTextureOption* obj_texture_option(std::string_view word) {
    static constexpr std::array<ObjTextureOption, 13> options = {{{"-blendu", 1, 1},
                                                                  {"-blendv", 1, 1},
                                                                  {"-bm", 1, 1},
                                                                  {"-boost", 1, 1},
                                                                  {"-clamp", 1, 1},
                                                                  {"-colorspace", 1, 1},
                                                                  {"-imfchan", 1, 1},
                                                                  {"-mm", 2, 2},
                                                                  {"-o", 1, 3},
                                                                  {"-s", 1, 3},
                                                                  {"-t", 1, 3},
                                                                  {"-texres", 1, 1},
                                                                  {"-type", 1, 1}}};
    const auto found = std::find_if(options.begin(), options.end(),
                                    [&](const ObjTextureOption& o) { return o.name == word; });
    return found == options.end() ? nullptr : &*found;
}

/// Takes the first word off `line`.
inline std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
}

/// Takes the values of an option off `line`. Where their number is free those that are numbers.
inline std::vector<std::string_view> take_values(const ObjTextureOption& option,
                                                 std::string_view& line) {
    std::vector<std::string_view> values;
    while (values.size() < option.most) {
        std::string_view rest = line;
        const std::string_view word = take_word(rest);
        const auto number = leading_number(word);
        const bool optional = values.size() >= option.least;
        if (word.empty() || (optional && (!number || !number->rest.empty()))) break;
        values.push_back(word);
        line = rest;
    }
    return values;
}

/// Reads what follows `keyword` in a material library. Options, then a file's name, which may hold
/// blanks; an empty one where there is none. Options that change the picture and are not read are
/// counted.
/// @throws Error(invalid_input)
inline ObjTextureUse read_texture_use(const std::string& keyword, std::string_view line,
                                      const std::string& place, SceneReport& report) {
    ObjTextureUse use;
    use.place = place;
    for (;;) {
        std::string_view rest = line;
        const ObjTextureOption* option = obj_texture_option(take_word(rest));
        if (option == nullptr) break;
        line = rest;
        const std::vector<std::string_view> values = take_values(*option, line);
        const std::string what = keyword + " " + std::string(option->name);
        if (values.size() < option->least) fail_at(place, what + " has no value; repair the line");
        const auto number = [&](std::size_t i, float otherwise) {
            return i < values.size() ? whole_number_token(values[i], what.c_str(), place)
                                     : otherwise;
        };
        if (option->name == "-s")
            use.scale = {number(0, 1.0f), number(1, 1.0f)};
        else if (option->name == "-o")
            use.offset = {number(0, 0.0f), number(1, 0.0f)};
        else if (option->name == "-bm")
            use.bump = number(0, 1.0f);
        else if (option->name == "-clamp")
            use.clamp = values[0] == "on";
        else if (option->name == "-imfchan" && values[0].size() == 1 &&
                 std::string_view("rgbml").find(values[0]) != std::string_view::npos)
            use.channel = values[0][0];
        else
            ++report.ignored["MTL option " + in_quotes(option->name)];
    }
    use.file = trimmed(line);
    std::replace(use.file.begin(), use.file.end(), '\\', '/');
    return use;
}

}  // namespace mir::detail
