// SPDX-License-Identifier: MIT
#include "mir/io/obj_reader.hpp"

#include "io/obj_fixture.hpp"
#include "support/catch.hpp"

#include <string>
#include <vector>

using namespace mirtest;
using mir::ErrorCode;
using mir::Rgb;
using mir::Vec3;

namespace {

using Triangles = std::vector<mir::TriangleIndices>;

}  // namespace

TEST_CASE("groups and materials of an OBJ file become meshes") {
    const auto loaded = read_obj_text("# comment\nmtllib my scene.mtl\n" + obj_corners +
                                          "vn 0 0 2\no wall\nusemtl red\nf 1//1 2//1 3//1 4//1\n"
                                          "usemtl lamp\nf -4 -3 -2 # comment\ng floor left\n"
                                          "usemtl red\nf 1 \\\n 2 3\n",
                                      "newmtl red\nKd 1 0 0\nnewmtl lamp\nKe 17 12 4\n");
    const mir::Scene& scene = loaded.scene;
    CHECK(scene.name == "scene");
    REQUIRE(scene.meshes.size() == 3);
    CHECK(scene.meshes[0].name == "wall/red");
    CHECK(scene.meshes[0].triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
    CHECK(scene.meshes[0].normals == std::vector<Vec3>(4, Vec3(0, 0, 1)));
    CHECK(scene.meshes[1].name == "wall/lamp");
    CHECK(scene.meshes[1].positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    CHECK(scene.meshes[1].normals.empty());
    CHECK(scene.meshes[2].name == "floor left");
    CHECK(scene.instances.size() == 3);
    CHECK(scene.materials[scene.meshes[1].material].emission == Rgb{17, 12, 4});
    CHECK(scene.materials[scene.meshes[2].material].base_color == Rgb{1, 0, 0});
    CHECK(loaded.report.triangles == 4);
    CHECK(loaded.report.emitting_triangles == 1);
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("a vertex with several normals is split, an equal corner is shared") {
    const auto loaded = read_obj_text(
        obj_corners + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\nf 1//2 3//2 4//2\n");
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    CHECK(mesh.positions.size() == 7);
    CHECK(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}});
    CHECK(mesh.normals[4] == Vec3(1, 0, 0));
}

TEST_CASE("line ends of every system, tabs, byte order marks and UTF-16 are read") {
    const std::string text = "v\t0 0 0\nv  1 0 0 \n v 1 1 0\nf 1 2 3";
    std::string mac = text;
    std::string windows;
    std::string wide("\xff\xfe", 2);
    for (char& c : mac) c = c == '\n' ? '\r' : c;
    for (char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
    for (char c : text) wide += {c, '\0'};
    for (const std::string& form : {text, mac, windows, wide, "\xef\xbb\xbf" + text})
        CHECK(read_obj_text(form).report.triangles == 1);
}

TEST_CASE("colours of OBJ vertices are sRGB and make the base white") {
    const auto loaded = read_obj_text("v 0 0 0 1 0 0.5\nv 1 0 0 0 2 0\nv 0 1 0\nf 1 2 3\n");
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    REQUIRE(mesh.colors.size() == 3);
    CHECK(mesh.colors[0].r == 1.0f);
    CHECK(mesh.colors[0].b == Approx(0.2140411405));
    CHECK(mesh.colors[1] == Rgb{0, 1, 0});
    CHECK(mesh.colors[2] == Rgb{1, 1, 1});
    CHECK(loaded.scene.materials.at(0).base_color == Rgb{1, 1, 1});
    CHECK(loaded.report.ignored == Ignored{{"vertex colour outside 0..1 (clamped)", 1}});
}

TEST_CASE("what an OBJ file asks for and does not get is counted") {
    const auto loaded = read_obj_text(
        "mtllib my scene.mtl\nmtllib other.mtl\n" + obj_corners +
            "v 0 0 1e+2 # not used\nv 3.1+e2 0 0\nvt 0 0\ns 1\nusemtl a\nf 1/1 2/1 3/1\n"
            "usemtl none\nf 1 2 3\nf 1 2\nl 1 2\np 1\ncurv 0 1 2\n",
        "newmtl a\nd .5\nKs 1 0 0\nsharpness 3\nmap_Kd x.png\nmap_Bump y.png\n");
    for (const auto& [what, times] : loaded.report.ignored) UNSCOPED_INFO(what << ": " << times);
    CHECK(loaded.report.ignored == Ignored{{"MTL 'map_Bump'", 1},
                                           {"characters behind a number", 1},
                                           {"colour of Ks (its mean is used)", 1},
                                           {"face of fewer than three corners", 1},
                                           {"lines", 1},
                                           {"image 'x.png' (not found)", 1},
                                           {"material library 'other.mtl' (not found)", 1},
                                           {"points", 1},
                                           {"smoothing groups without normals (shaded flat)", 1},
                                           {"statement 'curv'", 1},
                                           {"use of a material that no library has", 1}});
    CHECK(loaded.report.triangles == 2);
}

TEST_CASE("an empty field of a corner means that it has none") {
    // Whatever number comes next would be in the lists.
    const std::string numbers =
        obj_corners + "vn 0 0 1\nvn .8 0 .6\nvn .8 0 .6\nvn .8 0 .6\nvt 0 0\n";
    for (const std::string face : {"f 1// 2// 3// 4//", "f 1/ 2/ 3/ 4/", "f 1/1/ 2/1/ 3/1/ 4/1/",
                                   "f -4// -3/ -2/-1/ -1//", "f 1// \\\n2// 3//\t4//  # 1//1"}) {
        INFO(face);
        for (const std::string& before : {numbers, obj_corners + "vt 0 0\n"}) {
            const auto loaded = read_obj_text(before + face + "\n");
            const mir::Mesh& mesh = loaded.scene.meshes.at(0);
            CHECK(mesh.normals.empty());
            CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
            CHECK(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
            CHECK(loaded.report.ignored.empty());
        }
    }
    const auto smooth = read_obj_text(numbers + "f 1//1 2/1/1 3//-4 4//1\n");
    CHECK(smooth.scene.meshes.at(0).normals == std::vector<Vec3>(4, Vec3(0, 0, 1)));
}

TEST_CASE("a face with normals at some corners alone is flat, and counted") {
    for (const std::string face : {"f 1//1 2//1 3", "f 1// 2//1 3//1", "f 1//1 2 3/"}) {
        INFO(face);
        const auto loaded = read_obj_text(std::string(obj_corners)
                                              .append("vn .6 0 .8\n")
                                              .append(face)
                                              .append("\nf 1//1 3//1 4//1\n"));
        const mir::Mesh& mesh = loaded.scene.meshes.at(0);
        CHECK(loaded.report.ignored ==
              Ignored{{"face with normals at some corners alone (shaded flat)", 1}});
        REQUIRE(mesh.normals.size() == 6);
        for (std::size_t i = 0; i < 3; ++i) CHECK(mesh.normals[i] == Vec3(0));
        CHECK(mesh.normals[3] == Vec3(.6f, 0, .8f));
    }
}

TEST_CASE("names of an OBJ file cannot reach a terminal as commands") {
    const std::string red = "\x1b[31mred\x1b[0m";
    const std::string turned = "\xe2\x80\xae" + std::string(5000, 'x');
    const auto loaded =
        read_obj_text("mtllib " + red + ".mtl my scene.mtl\n" + obj_corners + red + " 1\n" +
                          turned + "\nmtllib my scene.mtl\nusemtl a\nf 1 2 3\n",
                      "newmtl a\nmap_Kd " + red + ".png\n" + red + " 1\n");
    CHECK(loaded.report.ignored.size() == 7);
    for (const auto& [what, times] : loaded.report.ignored) {
        CHECK(mir::printable(what, 300) == what);
        CHECK(what.size() < 250);
    }
    CHECK(loaded.report.ignored.contains("statement '\\x1b[31mred\\x1b[0m'"));
    const std::string message =
        message_of([&] { read_obj_text(obj_corners + "f 1 2 " + red + "\n"); });
    INFO(message);
    CHECK(message.find("'\\x1b[31mred\\x1b[0m'") != std::string::npos);
    CHECK(mir::printable(message, 2000) == message);
}

TEST_CASE("an OBJ file may begin with blank lines") {
    // A sanitizer noticed that the search for a backslash left the text.
    const auto loaded = read_obj_text("   \n \n" + obj_corners + "f 1 2 \\\n 3\n");
    CHECK(loaded.report.triangles == 1);
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("damage in an OBJ file is refused with its line and a remedy") {
    struct Damage {
        std::string obj;
        const char* says;
        std::string mtl;
    };
    const std::string lib = "mtllib my scene.mtl\n" + obj_corners + "usemtl a\nf 1 2 3\n";
    const auto damage = GENERATE_COPY(values<Damage>({
        {"v 0 0 nan\n", "line 1: a vertex is not a finite number", ""},
        {"\n\nv 0 1e39 0\n", "line 3: a vertex is not a finite number", ""},
        {"v 0 -1e999 0\n", "line 1: a vertex is not a finite number", ""},
        {"v 0 inf 0\n", "line 1: a vertex is not a finite number", ""},
        {"v 0 x 0\n", "line 1: a vertex is no number ('x')", ""},
        {"v 0 0 \\\n\n", "line 2: a vertex has 2 numbers instead of 3", ""},
        {"vn 0 0\n", "line 1: a normal has 2 numbers", ""},
        {obj_corners + "f 1 2 5\n", "line 5: a face names vertex 5, but 4 come before it", ""},
        {obj_corners + "f 1 2 0\n", "line 5: a face names vertex 0", ""},
        {obj_corners + "f 1 2 -5\n", "line 5: a face names vertex -5", ""},
        {obj_corners + "f 1//1 2 3\n", "line 5: a face names normal 1, but 0 come", ""},
        {obj_corners + "f 1/2 2 3\n", "line 5: a face names texture coordinate 2", ""},
        {obj_corners + "f a b c\n", "line 5: a corner of a face is none ('a'", ""},
        {obj_corners + "f 1/1/1/1 2 3\n", "line 5: a corner of a face is none", ""},
        {obj_corners + "f 1/// 2 3\n", "line 5: a corner of a face is none ('1///'", ""},
        {obj_corners + "f 1 // 2 3\n", "line 5: a corner of a face is none ('//'", ""},
        {obj_corners + "f /1 2 3\n", "line 5: a corner of a face is none ('/1'", ""},
        {obj_corners + "f 1 2 3/-\n", "line 5: a corner of a face is none ('3/-'", ""},
        {obj_corners + "f 1 2 3+\n", "line 5: a corner of a face is none ('3+'", ""},
        {obj_corners + "f 1 2// 9//\n", "line 5: a face names vertex 9", ""},
        {obj_corners + "f 1 2 4294967297\n", "line 5: a corner of a face is none", ""},
        {std::string("v 0 0 0\n\0", 9), "byte 8: it is zero", ""},
        {"vt x\n", "line 1: a texture coordinate is no number", ""},
        {"vt\n", "line 1: a texture coordinate has 0 numbers instead of 1", ""},
        {lib, "my scene.mtl, line 2: Kd is no number ('red')", "newmtl a\nKd red\n"},
        {lib, "my scene.mtl, line 2: Kd is not a finite number", "newmtl a\nKd 1 1 1e2147483648\n"},
        {lib, "my scene.mtl, line 3: Kd has 2 numbers", "newmtl a\n\nKd .5 .5 # grey\n"},
        {lib, "my scene.mtl, line 2: Kd is no number ('x')", "newmtl a\nKd .5 x\n"},
        {lib, "my scene.mtl, line 2: d is no number ('-haloo')", "newmtl a\nd -haloo .5\n"},
        {lib, "line 2: Ns is not a finite number", "newmtl a\nNs inf\n"},
        {lib, "my scene.mtl, material 'a': Ke is negative", "newmtl a\nKe 1 1 -1\n"},
        {lib, "my scene.mtl, material 'a': Ns is negative", "newmtl a\nNs -3\n"},
    }));
    ErrorCode code = ErrorCode::internal;
    const std::string message = message_of([&] { read_obj_text(damage.obj, damage.mtl); }, &code);
    INFO(message);
    CHECK(message.find("scene.obj: ") != std::string::npos);
    CHECK(message.find(damage.says) != std::string::npos);
    CHECK(message.find("; ") != std::string::npos);
    CHECK(code == ErrorCode::invalid_input);
}

TEST_CASE("an OBJ file keeps to the limits") {
    ErrorCode code = ErrorCode::internal;
    mir::Limits limits;
    limits.triangles = 1;
    CHECK(message_of([&] { read_obj_text(obj_corners + "f 1 2 3 4\n", "", limits); }, &code) !=
          "no error");
    CHECK(code == ErrorCode::limit_exceeded);
    limits = {};
    limits.vertices = 3;
    CHECK(message_of([&] { read_obj_text(obj_corners, "", limits); }, &code) != "no error");
    CHECK(code == ErrorCode::limit_exceeded);
    limits = {};
    limits.file_bytes = 80;
    CHECK(message_of([&] { read_obj_text(obj_corners, "", limits); }) == "no error");
    const std::string library(60, '#');
    CHECK(message_of([&] { read_obj_text("mtllib my scene.mtl\n" + obj_corners, library, limits); },
                     &code) != "no error");
    CHECK(code == ErrorCode::limit_exceeded);
}
