// SPDX-License-Identifier: MIT
#include "mir/io/obj_reader.hpp"

#include "io/gltf_fixture.hpp"
#include "support/catch.hpp"

#include <map>
#include <string>
#include <vector>

using namespace mirtest;
using mir::ErrorCode;
using mir::Rgb;
using mir::Vec3;

namespace {

mir::LoadedScene read(const std::string& obj, const std::string& mtl = "",
                      const mir::Limits& limits = {}) {
    const TemporaryFolder folder("obj_reader");
    write_file(folder / "my scene.mtl", mtl);
    write_file(folder / "scene.obj", obj);
    return mir::read_obj(folder / "scene.obj", limits);
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// The only material of a library with these lines.
mir::Material material(const std::string& lines) {
    const auto loaded = read(corners + "mtllib my scene.mtl\nusemtl a b\nf 1 2 3\n",
                             "newmtl a b \n" + lines + "\n");
    REQUIRE(loaded.scene.materials.size() == 1);
    return loaded.scene.materials[0];
}

using Ignored = std::map<std::string, std::uint64_t>;
using Triangles = std::vector<mir::TriangleIndices>;

}  // namespace

TEST_CASE("groups and materials of an OBJ file become meshes") {
    const auto loaded = read("# comment\nmtllib my scene.mtl\n" + corners +
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
    const auto loaded = read(
        corners + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\nf 1//2 3//2 4//2\n");
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
        CHECK(read(form).report.triangles == 1);
}

TEST_CASE("MTL is mapped to metallic-roughness parameters") {
    const mir::Material plain = material("Kd .1 .2 .3");
    CHECK(plain.name == "a b");
    CHECK(plain.base_color == Rgb{0.1f, 0.2f, 0.3f});
    CHECK(plain.is_lambertian());
    CHECK(material("Ks 0 0 0\nNs 400").is_lambertian());
    CHECK(material("Ks 1 1 1\nillum 1").is_lambertian());
    const mir::Material phong = material("Kd .5 .5 .5\nKs .3 .3 .3\nNs 30\nNi 1.3\nillum 2");
    CHECK(phong.specular == Approx(0.3));
    CHECK(phong.metallic == 0.0f);
    // alpha^2 = 2 / (30 + 2) = 1/16, and roughness^2 = alpha.
    CHECK(phong.roughness == Approx(0.5));
    CHECK(phong.ior == 1.3f);
    CHECK(material("Ks .3 .3 .3\nNi 1").ior == 1.5f);
    const mir::Material physical = material("Kd 1 .8 0\nPr .25\nPm 1\nNs 7");
    CHECK(physical.roughness == 0.25f);
    CHECK(physical.metallic == 1.0f);
    CHECK(physical.specular == 1.0f);
}

TEST_CASE("colours of OBJ vertices are sRGB and make the base white") {
    const auto loaded = read("v 0 0 0 1 0 0.5\nv 1 0 0 0 2 0\nv 0 1 0\nf 1 2 3\n");
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
    const auto loaded =
        read("mtllib my scene.mtl\nmtllib other.mtl\n" + corners +
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
                                           {"transparency (d, Tr)", 1},
                                           {"use of a material that no library has", 1}});
    CHECK(loaded.report.triangles == 2);
}

TEST_CASE("an OBJ file may begin with blank lines") {
    // A sanitizer noticed that the search for a backslash left the text.
    const auto loaded = read("   \n \n" + corners + "f 1 2 \\\n 3\n");
    CHECK(loaded.report.triangles == 1);
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("damage in an OBJ file is refused with its line and a remedy") {
    struct Damage {
        std::string obj;
        const char* says;
        std::string mtl;
    };
    const std::string lib = "mtllib my scene.mtl\nnothing\n";
    const auto damage = GENERATE_COPY(values<Damage>({
        {"v 0 0 nan\n", "line 1: a vertex is not a finite number", ""},
        {"\n\nv 0 1e39 0\n", "line 3: a vertex is not a finite number", ""},
        {"v 0 -1e999 0\n", "line 1: a vertex is not a finite number", ""},
        {"v 0 inf 0\n", "line 1: a vertex is not a finite number", ""},
        {"v 0 x 0\n", "line 1: a vertex is no number ('x')", ""},
        {"v 0 0 \\\n\n", "line 2: a vertex has 2 numbers instead of 3", ""},
        {"vn 0 0\n", "line 1: a normal has 2 numbers", ""},
        {corners + "f 1 2 5\n", "line 5: a face names vertex 5, but 4 come before it", ""},
        {corners + "f 1 2 0\n", "line 5: a face names vertex 0", ""},
        {corners + "f 1 2 -5\n", "line 5: a face names vertex -5", ""},
        {corners + "f 1//1 2 3\n", "line 5: a face names normal 1, but 0 come", ""},
        {corners + "f 1/2 2 3\n", "line 5: a face names texture coordinate 2", ""},
        {corners + "f a b c\n", "line 5: a corner of a face is none ('a'", ""},
        {corners + "f 1/1/1/1 2 3\n", "line 5: a corner of a face is none", ""},
        {corners + "f 1 2 4294967297\n", "line 5: a corner of a face is none", ""},
        {std::string("v 0 0 0\n\0", 9), "byte 8: it is zero", ""},
        {"vt x\n", "line 1: a texture coordinate is no number", ""},
        {"vt\n", "line 1: a texture coordinate has 0 numbers instead of 1", ""},
        {lib, "my scene.mtl, line 2: Kd is no number ('red')", "newmtl a\nKd red\n"},
        {lib, "my scene.mtl, line 2: Kd has an exponent of many digits ('1e-2147483648')",
         "newmtl a\nKd 1 1 1e-2147483648\n"},
        {lib, "line 2: Ns is not a finite number", "newmtl a\nNs inf\n"},
        {lib, "my scene.mtl, line 2: Ke has no number", "newmtl a\nKe\n"},
        {lib, "my scene.mtl, material 'a': Ke is negative", "newmtl a\nKe 1 1 -1\n"},
        {lib, "my scene.mtl, material 'a': Ns is negative", "newmtl a\nNs -3\n"},
    }));
    ErrorCode code = ErrorCode::internal;
    const std::string message = message_of([&] { read(damage.obj, damage.mtl); }, &code);
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
    CHECK(message_of([&] { read(corners + "f 1 2 3 4\n", "", limits); }, &code) != "no error");
    CHECK(code == ErrorCode::limit_exceeded);
    limits = {};
    limits.vertices = 3;
    CHECK(message_of([&] { read(corners, "", limits); }, &code) != "no error");
    CHECK(code == ErrorCode::limit_exceeded);
    limits = {};
    limits.file_bytes = 80;
    CHECK(message_of([&] { read(corners, "", limits); }) == "no error");
    const std::string library(60, '#');
    CHECK(message_of([&] { read("mtllib my scene.mtl\n" + corners, library, limits); }, &code) !=
          "no error");
    CHECK(code == ErrorCode::limit_exceeded);
}
