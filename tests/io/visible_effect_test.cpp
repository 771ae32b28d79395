// SPDX-License-Identifier: MIT
#include "mir/io/visible_effect.hpp"

#include "io/detail/visible_effects.hpp"
#include "support/catch.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

using mir::visible_effect;

namespace {

/// Names that docs/scene_files.md says are counted; another test holds its tables to the readers.
std::set<std::string> counted_names() {
    std::ifstream page(std::filesystem::path(MIR_DOCS_DIR) / "scene_files.md");
    const std::string mark = "counted: `";
    std::set<std::string> names;
    for (std::string line; std::getline(page, line);) {
        std::size_t begin = line.find(mark);
        if (!line.starts_with("| ") || begin == std::string::npos) continue;
        begin += mark.size();
        for (bool more = true; more;) {
            const std::size_t end = line.find('`', begin);
            names.insert(line.substr(begin, end - begin));
            more = line.compare(end, 4, "`, `") == 0;
            begin = end + 4;
        }
    }
    return names;
}

}  // namespace

TEST_CASE("every feature that a reader counts has words on what one sees of it") {
    const std::set<std::string> names = counted_names();
    CHECK(names.size() > 90);
    for (const std::string& name : names) {
        INFO(name);
        CHECK((visible_effect(name) == mir::detail::effect_of_unknown_feature) ==
              (name == "VENDOR_some_extension"));
    }
}

TEST_CASE("words on what one sees are short parts of sentences, and none hides behind another") {
    for (const auto& list : mir::detail::visible_effect_lists)
        for (const mir::detail::VisibleEffect& effect : list) {
            INFO(effect.pattern);
            CHECK(effect.words.size() < 90);
            CHECK(effect.words.back() != '.');
            std::string name(effect.pattern);
            if (const std::size_t star = name.find('*'); star != std::string::npos)
                name.replace(star, 1, "some");
            CHECK(visible_effect(name) == effect.words);
        }
}

TEST_CASE("glass and what scatters in it look different") {
    CHECK(visible_effect("texture transmissionTexture") ==
          "it is equally clear all over the surface");
    CHECK(visible_effect("KHR_materials_dispersion") !=
          visible_effect("KHR_materials_volume_scatter"));
    CHECK(visible_effect("KHR_materials_of_tomorrow") ==
          "drawn as if the material did not have it");
    CHECK(visible_effect("texture normalTexture on a second set of coordinates") ==
          visible_effect("texture normalTexture without a PNG or JPEG image"));
    CHECK(visible_effect("") == visible_effect("skin_of_some_vendor"));
}
