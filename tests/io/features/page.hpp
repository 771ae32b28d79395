// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/gltf_extensions.hpp"
#include "io/features/gltf_geometry.hpp"
#include "io/features/gltf_materials.hpp"
#include "io/features/gltf_scene.hpp"
#include "io/features/mtl_keys.hpp"
#include "io/features/obj_statements.hpp"
#include "io/features/ply_elements.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

namespace mirtest::features {

inline constexpr const char* page_begin = "<!-- features: begin -->\n";
inline constexpr const char* page_end = "<!-- features: end -->\n";

/// What stands between the two comments of docs/scene_files.md.
inline std::string page_tables() {
    return "\n### glTF: files, scenes, nodes, cameras\n\n" + table_of(gltf_scenes()) +
           "\n### glTF: geometry\n\n" + table_of(gltf_geometry()) +
           "\n### glTF: materials and images\n\n" + table_of(gltf_appearance()) +
           "\n### glTF: extensions\n\n" + table_of(gltf_extensions()) +
           "\n### OBJ: statements\n\n" + table_of(obj_statements()) + "\n### MTL: keywords\n\n" +
           table_of(mtl_keys()) + "\n### PLY: elements and properties\n\n" +
           table_of(ply_elements()) + "\n";
}

/// `page` with these tables between its comments.
/// @throws std::logic_error when it lacks one.
inline std::string with_tables(const std::string& page, const std::string& tables) {
    const std::string begin = page_begin;
    const std::size_t first = page.find(begin);
    const std::size_t last = page.find(page_end);
    if (first == std::string::npos || last == std::string::npos || last < first)
        throw std::logic_error("the page lacks the comments around the features");
    return page.substr(0, first + begin.size()) + tables + page.substr(last);
}

/// The first line in which two texts differ, as each has it.
inline std::string first_difference(const std::string& a, const std::string& b) {
    std::istringstream in_a(a);
    std::istringstream in_b(b);
    for (;;) {
        std::string line_a;
        std::string line_b;
        const bool has_a = bool(std::getline(in_a, line_a));
        const bool has_b = bool(std::getline(in_b, line_b));
        if (!has_a && !has_b) return "";
        if (line_a != line_b || has_a != has_b)
            return std::string("- ").append(line_a).append("\n+ ").append(line_b);
    }
}

}  // namespace mirtest::features
