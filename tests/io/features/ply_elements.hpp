// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/feature.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mirtest::features {

/// A triangle in text: properties of a vertex behind its place, their values (the same for each),
/// and more elements with their values.
struct PlyText {
    std::string properties;
    std::string values;
    std::string elements = "element face 1\nproperty list uchar int vertex_indices\n";
    std::string rows = "3 0 1 2\n";
};

inline Files ply_file(std::string bytes) {
    return {{{"scene.ply", std::move(bytes)}}, "scene.ply"};
}

inline Files ply(const PlyText& text) {
    std::string file =
        "ply\nformat ascii 1.0\ncomment made here\nobj_info none\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\n" +
        text.properties + text.elements + "end_header\n";
    for (const char* place : {"0 0 0 ", "1 0 0 ", "0 1 0 "}) file += place + text.values + "\n";
    return ply_file(file + text.rows);
}

/// The same triangle in binary numbers.
inline Files ply_binary(bool big) {
    const auto number = [big](auto value) {
        std::string bytes = bytes_of<decltype(value)>({value});
        if (big) std::reverse(bytes.begin(), bytes.end());
        return bytes;
    };
    std::string file = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                       "_endian 1.0\nelement vertex 3\nproperty float x\nproperty double y\n"
                       "property short z\nelement face 1\n"
                       "property list uchar uint vertex_index\nend_header\n";
    for (const auto& [x, y] : {std::pair{0.0f, 0.0}, {1.0f, 0.0}, {0.0f, 1.0}})
        file += number(x) + number(y) + number(std::int16_t{0});
    file += number(std::uint8_t{3});
    for (std::uint32_t i = 0; i < 3; ++i) file += number(i);
    return ply_file(file);
}

inline Features ply_numbers() {
    const auto is_triangle = mesh([](const mir::Mesh& m) {
        CHECK(m.positions == std::vector<mir::Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(m.triangles == std::vector<mir::TriangleIndices>{{0, 1, 2}});
    });
    PlyText broken;
    broken.rows = "3 0 1 x\n";
    PlyText infinite;
    infinite.properties = "property float nx\n";
    infinite.values = "nan";
    PlyText cut;
    cut.rows = "";
    Files no_format = ply({});
    std::string& text = no_format.bytes_of["scene.ply"];
    text = with(text, "format ascii 1.0\n", "");
    return {
        {"text", "`format ascii`", {ply({})}, read(is_triangle), ""},
        {"binary, little-endian",
         "`format binary_little_endian`",
         {ply_binary(false)},
         read(is_triangle),
         ""},
        {"binary, big-endian",
         "`format binary_big_endian`",
         {ply_binary(true)},
         read(is_triangle),
         ""},
        {"no format", "no `format`", {no_format}, refused("header: it has no format"), ""},
        {"numbers that are none",
         "`3 0 1 x`",
         {ply(broken)},
         refused("a whole number was expected ('x' is none)"),
         ""},
        {"numbers that are not finite",
         "`nan`",
         {ply(infinite)},
         refused("nx is not a finite number"),
         ""},
        {"files that are cut short",
         "fewer numbers than announced",
         {ply(cut)},
         refused("the file ends there (it is cut short)"),
         ""},
    };
}

inline Features ply_vertices() {
    const PlyText normals{"property float nx\nproperty float ny\nproperty float nz\n", "0 0 2"};
    const PlyText bytes{"property uchar red\nproperty uchar green\nproperty uchar blue\n",
                        "255 0 0"};
    const PlyText shorts{"property ushort red\nproperty ushort green\nproperty ushort blue\n",
                         "65535 0 0"};
    const PlyText floats{"property float red\nproperty float green\nproperty float blue\n",
                         "1 0 0"};
    const PlyText alone{"property uchar red\nproperty float nx\n", "255 0"};
    const PlyText other{"property uchar alpha\nproperty float s\nproperty list uchar int q\n",
                        "255 0 2 1 1"};
    return {
        {"normals",
         "`nx ny nz`",
         {ply(normals)},
         read(mesh([](const mir::Mesh& m) { CHECK(m.normals.at(0) == mir::Vec3(0, 0, 1)); })),
         ""},
        {"vertex colours of 8 and 16 bits and of floats",
         "`red green blue`",
         {ply(bytes), ply(shorts), ply(floats)},
         read(mesh([](const mir::Mesh& m) {
             CHECK(m.colors.at(0) == mir::Rgb{1, 0, 0});
         })),
         "sRGB, the colour of the Lambertian material"},
        {"a part of a colour or of a normal",
         "`red` without `green`, `nx` without `ny`",
         {ply(alone)},
         counted({"PLY vertex property 'nx'", "PLY vertex property 'red'"}, triangles(1)),
         ""},
        {"any other property of vertices",
         "for instance `alpha`, `s`, lists",
         {ply(other)},
         counted(
             {"PLY vertex property 'alpha'", "PLY vertex property 'q'", "PLY vertex property 's'"},
             triangles(1)),
         ""},
        {"no colours",
         "no `red`",
         {ply({})},
         read(material([](const mir::Material& m) {
             CHECK(m.base_color == mir::Rgb{0.8f, 0.8f, 0.8f});
             CHECK(m.is_lambertian());
         })),
         "Lambertian, reflectance 0.8"},
    };
}

inline Features ply_faces() {
    PlyText quad;
    quad.rows = "4 0 1 2 1\n";
    PlyText named;
    named.elements = "element face 1\nproperty list uchar int vertex_index\n";
    PlyText more;
    more.elements =
        "element face 1\nproperty list uchar int vertex_indices\nproperty uchar flags\n"
        "property list uchar float texcoord\nelement edge 1\nproperty int vertex1\n";
    more.rows = "3 0 1 2 7 2 0 1\n5\n";
    PlyText strips;
    strips.elements = "element tristrips 1\nproperty list int int vertex_indices\n";
    PlyText few;
    few.rows = "2 0 1\n";
    PlyText beyond;
    beyond.rows = "3 0 1 9\n";
    PlyText cloud;
    cloud.elements = cloud.rows = "";
    return {
        {"faces",
         "`vertex_indices`, `vertex_index`",
         {ply({}), ply(named)},
         read(triangles(1)),
         ""},
        {"polygons",
         "lists of four and more",
         {ply(quad)},
         read(triangles(2)),
         "cut into triangles, as of OBJ"},
        {"faces of fewer than three corners",
         "`2 0 1`",
         {ply(few)},
         counted({"face of fewer than three corners"}),
         "left out"},
        {"vertices that do not exist",
         "`3 0 1 9`",
         {ply(beyond)},
         refused("it names vertex 9"),
         ""},
        {"any other element, any other property of faces",
         "for instance `edge`, `texcoord`",
         {ply(more)},
         counted(
             {"PLY element 'edge'", "PLY face property 'flags'", "PLY face property 'texcoord'"},
             triangles(1)),
         "skipped"},
        {"strips of triangles",
         "`tristrips`",
         {ply(strips)},
         counted({"PLY element 'tristrips'"}),
         "left out"},
        {"clouds of points",
         "no `face`",
         {ply(cloud)},
         noted("no triangles: there is nothing to see", triangles(0)),
         ""},
    };
}

inline Features ply_elements() {
    Features all = ply_numbers();
    append(all, ply_vertices());
    append(all, ply_faces());
    return all;
}

}  // namespace mirtest::features
