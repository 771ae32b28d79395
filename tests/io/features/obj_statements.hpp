// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/feature.hpp"
#include "io/gltf_everything.hpp"
#include "io/obj_fixture.hpp"
#include "mir/scene/world_geometry.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mirtest::features {

/// An OBJ file of these lines behind four corners of a square, with other files beside it.
inline Files obj(const std::string& lines, std::map<std::string, std::string> beside = {}) {
    beside["scene.obj"] = obj_corners + lines;
    return {std::move(beside), "scene.obj"};
}

inline Feature obj_feature(std::string name, std::string says,
                           const std::vector<std::string>& variants, Outcome outcome,
                           std::string words = "") {
    Feature to{std::move(name), std::move(says), {}, std::move(outcome), std::move(words)};
    for (const std::string& lines : variants) to.variants.push_back(obj(lines));
    return to;
}

/// Normals and texture coordinates for the four corners.
inline const std::string obj_directions =
    "vn 0 0 1\nvn 0 0 1\nvn 0 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

inline Features obj_faces() {
    const auto same = mesh([](const mir::Mesh& m) {
        CHECK(m.triangles == std::vector<mir::TriangleIndices>{{0, 1, 2}, {0, 2, 3}});
    });
    const std::string& d = obj_directions;
    return {
        obj_feature("faces, counted from the front or the back", "`f 1 2 3 4`, `f -4 -3 -2 -1`",
                    {"f 1 2 3 4\n", "f -4 -3 -2 -1\n"}, read(same)),
        obj_feature(
            "faces with texture coordinates", "`f 1/1 2/2 3/3`, `f 1/1/ 2/2/ 3/3/`",
            {d + "f 1/1 2/2 3/3 4/4\n", d + "f 1/1/ 2/2/ 3/3/ 4/4/\n", d + "f 1/ 2/ 3/ 4/\n"},
            read(same), "kept for materials with textures"),
        obj_feature(
            "faces with normals", "`f 1//1 2//2 3//3`, `f 1/1/1 2/2/2 3/3/3`",
            {d + "f 1//1 2//2 3//3 4//4\n", d + "f 1/1/1 2/2/2 3/3/3 4/4/4\n"},
            read(mesh([](const mir::Mesh& m) { CHECK(m.normals.at(2) == mir::Vec3(0, 1, 0)); })),
            "faces without are flat"),
        obj_feature("faces with normals at some corners", "`f 1//1 2 3`", {d + "f 1//1 2 3\n"},
                    counted({"face with normals at some corners alone (shaded flat)"})),
        obj_feature("polygons, dents included", "`f` with four corners and more",
                    {"v 0.3 0.7 0\nf 1 5 3 4\n"}, read([](const mir::LoadedScene& loaded) {
                        const mir::WorldGeometry geometry(loaded.scene);
                        // A cut across the dent would make it 0.7.
                        CHECK(geometry.area(0) + geometry.area(1) == Approx(0.3));
                    }),
                    "cut into triangles; with dents at most 4096 corners"),
        obj_feature("faces of fewer than three corners", "`f 1 2`, `f 1`", {"f 1 2\n", "f 1\n"},
                    counted({"face of fewer than three corners"}), "left out"),
        obj_feature("corners that are not there yet", "`f 0 1 2`, `f 1 2 9`, `f 1/9 2/9 3/9`",
                    {"f 0 1 2\n", "f 1 2 9\n", "f 1/9 2/9 3/9\n", "f 1//9 2//9 3//9\n"},
                    refused("line 5: a face names")),
        obj_feature("corners that are none", "`f 1 2 x`", {"f 1 2 x\n", "f 1//// 2 3\n"},
                    refused("line 5: a corner of a face is none")),
    };
}

inline Features obj_elements() {
    return {
        obj_feature("lines", "`l`", {"l 1 2 3\nf 1 2 3\n"}, counted({"lines"}, triangles(1)),
                    "left out"),
        obj_feature("points", "`p`", {"p 1 2\nf 1 2 3\n"}, counted({"points"}, triangles(1)),
                    "left out"),
        obj_feature("vertices alone", "`v` without `f`", {""},
                    noted("no triangles: there is nothing to see", triangles(0))),
        obj_feature("vertex colours", "`v x y z r g b`",
                    {"v 0 0 1 1 0 0\nv 1 0 1 1 0 0\nv 0 1 1 1 0 0\nf 5 6 7\n"},
                    read(mesh([](const mir::Mesh& m) {
                        CHECK(m.colors.at(0) == mir::Rgb{1, 0, 0});
                    })),
                    "sRGB; they multiply the base colour, white without material"),
        obj_feature("vertex colours outside 0..1", "`v x y z r g b`", {"v 0 0 1 2 0 0\nf 1 2 5\n"},
                    counted({"vertex colour outside 0..1 (clamped)"})),
        obj_feature("weights of vertices, depths of textures", "`v x y z w`, `vt u v w`",
                    {"v 0 0 1 1\nvt 0 0 0\nf 1 2 5\n"}, read(triangles(1)), "not used"),
        obj_feature("curves", "`cstype`, `deg`, `curv`, `parm`, `end`",
                    {"cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\nf 1 2 3\n"},
                    counted({"statement 'cstype'", "statement 'curv'", "statement 'deg'",
                             "statement 'end'", "statement 'parm'"},
                            triangles(1)),
                    "left out"),
        obj_feature("surfaces, curves on them", "`surf`, `vp`, `curv2`, `trim`, `hole`",
                    {"surf 0 1 0 1 1 2 3 4\nvp 0 0\ncurv2 1 1\ntrim 0 1 1\nhole 0 1 1\nf 1 2 3\n"},
                    counted({"statement 'curv2'", "statement 'hole'", "statement 'surf'",
                             "statement 'trim'", "statement 'vp'"},
                            triangles(1)),
                    "left out"),
        obj_feature(
            "any other statement", "for instance `lod`, `bevel`, `usemap`",
            {"bevel on\nlod 1\nusemap a\nf 1 2 3\n"},
            counted({"statement 'bevel'", "statement 'lod'", "statement 'usemap'"}, triangles(1))),
    };
}

inline Features obj_grouping() {
    const auto names = [](const std::vector<std::string>& expected) {
        return read([expected](const mir::LoadedScene& loaded) {
            std::vector<std::string> found;
            for (const mir::Mesh& m : loaded.scene.meshes) found.push_back(m.name);
            CHECK(found == expected);
        });
    };
    return {
        obj_feature("groups and objects", "`g`, `o`",
                    {"g a\nf 1 2 3\ng b\nf 1 3 4\n", "o a\nf 1 2 3\no b\nf 1 3 4\n"},
                    names({"a", "b"}), "one mesh per group and material"),
        obj_feature("smoothing groups with normals", "`s`",
                    {obj_directions + "s 1\nf 1//1 2//2 3//3\n"},
                    read(mesh([](const mir::Mesh& m) { CHECK(m.normals.size() == 3); })),
                    "the normals stand"),
        obj_feature("smoothing groups without normals", "`s`", {"s 1\nf 1 2 3\n"},
                    counted({"smoothing groups without normals (shaded flat)"})),
        obj_feature("no smoothing", "`s off`, `s 0`", {"s off\nf 1 2 3\n", "s 0\nf 1 2 3\n"},
                    without_effect(obj("f 1 2 3\n"))),
    };
}

inline Features obj_text() {
    const std::string wide = [] {
        std::string text = "\xff\xfe";
        for (const char c : obj_corners + "f 1 2 3\n") text += {c, '\0'};
        return text;
    }();
    return {
        obj_feature("continued lines, comments", "`\\` before the end of a line, `#`",
                    {"f 1 2 \\\n 3 # x\n"}, read(triangles(1))),
        {"UTF-8, UTF-16, line ends of any system",
         "text",
         {{{{"scene.obj", wide}}, "scene.obj"}, obj("f 1 2 3\r\n"), obj("f 1 2 3\r")},
         read(triangles(1)),
         ""},
        obj_feature("numbers that are none", "`v 0 x 0`", {"v 0 x 0\n"},
                    refused("line 5: a vertex is no number")),
        obj_feature("numbers that are not finite", "`v 0 nan 0`",
                    {"v 0 nan 0\n", "v 0 inf 0\n", "v 0 1e99 0\n"},
                    refused("line 5: a vertex is not a finite number")),
        obj_feature("bytes that are no text", "a zero", {std::string("o a\0b\n", 6)},
                    refused("the file is no text")),
        obj_feature("characters behind a number", "`3.1+e2`", {"v 0 3.1+e2 0\nf 1 2 5\n"},
                    counted({"characters behind a number"}), "read as 3.1"),
    };
}

inline Features obj_libraries() {
    const std::string use = "usemtl a\nf 1 2 3\n";
    const std::string red = "newmtl a\nKd 1 0 0\n";
    const auto is_red = material([](const mir::Material& m) {
        CHECK(m.base_color == mir::Rgb{1, 0, 0});
    });
    const auto is_default = material([](const mir::Material& m) {
        CHECK(m.base_color == mir::Rgb{0.8f, 0.8f, 0.8f});
        CHECK(m.is_lambertian());
    });
    const std::string unknown = "use of a material that no library has";
    return {
        {"libraries: several in a line, blanks in a name, repeated",
         "`mtllib`",
         {obj("mtllib b.mtl a.mtl\n" + use, {{"a.mtl", red}, {"b.mtl", ""}}),
          obj("mtllib my own.mtl\n" + use, {{"my own.mtl", red}}),
          obj("mtllib my\\ own.mtl b.mtl\n" + use, {{"my own.mtl", red}, {"b.mtl", ""}}),
          obj("mtllib sub/a.mtl\nmtllib sub/a.mtl\n" + use, {{"sub/a.mtl", red}})},
         read(is_red),
         "relative to the file; a blank may have a backslash before it"},
        {"libraries that are missing",
         "`mtllib`",
         {obj("mtllib none.mtl\n" + use)},
         counted({"material library 'none.mtl' (not found)", unknown}, is_default),
         ""},
        {"libraries outside of the folder",
         "`mtllib`",
         {obj("mtllib ../a.mtl\n" + use, {{"../a.mtl", red}})},
         refused("lies outside of the folder of the OBJ file"),
         "see [OBJ and MTL](#obj-and-mtl)"},
        obj_feature("materials that no library has", "`usemtl`", {use},
                    counted({unknown}, is_default)),
        {"several materials of one name",
         "`newmtl`",
         {obj("mtllib a.mtl\n" + use, {{"a.mtl", red + "newmtl a\nKd 0 1 0\n"}})},
         counted({"material defined twice (the first is used)"}, is_red),
         ""},
        {"materials that no face uses",
         "`newmtl`",
         {obj("mtllib a.mtl\n" + use, {{"a.mtl", red + "newmtl b\nrefl x.png\nmap_Kd x.png\n"}})},
         read(is_red),
         "not counted; images not read"},
        obj_feature("no material", "no `usemtl`", {"f 1 2 3\n"}, read(is_default),
                    "Lambertian, reflectance 0.8"),
    };
}

inline Features obj_statements() {
    Features all = obj_faces();
    append(all, obj_elements());
    append(all, obj_grouping());
    append(all, obj_libraries());
    append(all, obj_text());
    return all;
}

}  // namespace mirtest::features
