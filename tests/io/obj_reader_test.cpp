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

/// What is not read of it.
Ignored lost(const std::string& lines) {
    return read(corners + "mtllib my scene.mtl\nusemtl a b\nf 1 2 3\nf 1 3 4\n",
                "newmtl a b\n" + lines + "\n")
        .report.ignored;
}

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

TEST_CASE("an empty field of a corner means that it has none") {
    // Whatever number comes next would be in the lists.
    const std::string numbers = corners + "vn 0 0 1\nvn .8 0 .6\nvn .8 0 .6\nvn .8 0 .6\nvt 0 0\n";
    for (const std::string face : {"f 1// 2// 3// 4//", "f 1/ 2/ 3/ 4/", "f 1/1/ 2/1/ 3/1/ 4/1/",
                                   "f -4// -3/ -2/-1/ -1//", "f 1// \\\n2// 3//\t4//  # 1//1"}) {
        INFO(face);
        for (const std::string& before : {numbers, corners + "vt 0 0\n"}) {
            const auto loaded = read(before + face + "\n");
            const mir::Mesh& mesh = loaded.scene.meshes.at(0);
            CHECK(mesh.normals.empty());
            CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
            CHECK(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
            CHECK(loaded.report.ignored.empty());
        }
    }
    const auto smooth = read(numbers + "f 1//1 2/1/1 3//-4 4//1\n");
    CHECK(smooth.scene.meshes.at(0).normals == std::vector<Vec3>(4, Vec3(0, 0, 1)));
}

TEST_CASE("a face with normals at some corners alone is flat, and counted") {
    for (const std::string face : {"f 1//1 2//1 3", "f 1// 2//1 3//1", "f 1//1 2 3/"}) {
        INFO(face);
        const auto loaded = read(corners + "vn .6 0 .8\n" + face + "\nf 1//1 3//1 4//1\n");
        const mir::Mesh& mesh = loaded.scene.meshes.at(0);
        CHECK(loaded.report.ignored ==
              Ignored{{"face with normals at some corners alone (shaded flat)", 1}});
        REQUIRE(mesh.normals.size() == 6);
        for (std::size_t i = 0; i < 3; ++i) CHECK(mesh.normals[i] == Vec3(0));
        CHECK(mesh.normals[3] == Vec3(.6f, 0, .8f));
    }
}

TEST_CASE("one number of a colour of MTL stands for all three") {
    CHECK(material("Kd 0.5").base_color == Rgb{0.5f, 0.5f, 0.5f});
    CHECK(material("Kd +.5 # grey").base_color == Rgb{0.5f, 0.5f, 0.5f});
    CHECK(material("Ke 2").emission == Rgb{2, 2, 2});
    CHECK(material("Ks 0.25\nillum 2").specular == 0.25f);
    CHECK(material("Kd 1 1 1e-2147483648").base_color == Rgb{1, 1, 0});
    for (const char* line : {"Ka 0.5", "Ka", "Ka 1 1", "Tf 1", "Ks .5"}) {
        INFO(line);
        CHECK(lost(line).empty());
    }
}

TEST_CASE("lines of MTL that say nothing are counted, and the file is read") {
    for (const std::string key : {"Kd", "Ke", "Ks", "Tf", "Ns", "Ni", "d", "Tr", "Pr", "Pm",
                                  "illum", "map_Kd", "map_Ke", "map_d", "norm"}) {
        INFO(key);
        const Ignored once = {{"MTL '" + key + "' without a value", 1}};
        CHECK(lost(key) == once);
        CHECK(lost(key + " \t\n" + key) == once);
    }
    CHECK(material("Kd .1 .2 .3\nKd\nmap_Kd ").base_color == Rgb{.1f, .2f, .3f});
    CHECK(lost("Kd # none") == Ignored{{"MTL 'Kd' without a value", 1}});
    CHECK(lost("illum glass") == Ignored{{"MTL 'illum' without a value", 1}});
    CHECK(lost("map_Kd -clamp on") == Ignored{{"MTL 'map_Kd' without a value", 1}});
}

TEST_CASE("colours of MTL as spectra and CIE XYZ are not read, and counted") {
    for (const std::string key : {"Kd", "Ks", "Ke", "Tf"}) {
        INFO(key);
        CHECK(lost(key + " spectral file.rfl 2") == Ignored{{"MTL '" + key + " spectral'", 1}});
        CHECK(lost(key + " xyz .3 .4 .5") == Ignored{{"MTL '" + key + " xyz'", 1}});
    }
    CHECK(material("Kd spectral a.rfl").base_color == mir::Material{}.base_color);
}

TEST_CASE("glass of MTL is counted as transparency, once for each material") {
    const Ignored opacity = {{"transparency (d, Tr)", 1}};
    const Ignored glass = {{"transparency (illum, Tf)", 1}};
    for (const char* lines : {"illum 4", "illum 6", "illum 7\nTf 1 1 1\nNi 1.5", "illum 9",
                              "Tf .5 1 1", "Tf 0.5", "Kt .9 .9 .9", "Tf .5 .5 .5\nillum 7\nd 1"}) {
        INFO(lines);
        CHECK(lost(lines) == glass);
    }
    for (const char* lines : {"d .5", "Tr .5", "d .5\nNi 1.5\nillum 7\nTf 0 0 0", "Tr .5\nillum 4",
                              "d 0.5\nTr 0", "d .5\nd .5"}) {
        INFO(lines);
        CHECK(lost(lines) == opacity);
    }
    for (const char* lines : {"illum 2", "illum 3", "illum 5", "illum 8", "illum 0", "Tf 1 1 1",
                              "Ni 1.5", "d 1\nTr 1", "Tr 0"}) {
        INFO(lines);
        CHECK(lost(lines).empty());
    }
    CHECK(lost("d -halo 0.5") == Ignored{{"MTL option '-halo'", 1}, {"transparency (d, Tr)", 1}});
    CHECK(lost("d -halo") == Ignored{{"MTL option '-halo'", 1}, {"MTL 'd' without a value", 1}});
}

TEST_CASE("of materials with one name the first is taken, and the others are counted") {
    const Ignored once = {{"material defined twice (the first is used)", 1}};
    const auto loaded = read("mtllib my scene.mtl\n" + corners + "usemtl a\nf 1 2 3\n",
                             "newmtl a\nKe 1 1 1\nnewmtl b\nnewmtl a\nKd 1 0 0\nd .5\nfoo\n");
    CHECK(loaded.report.ignored == once);
    REQUIRE(loaded.scene.materials.size() == 2);
    CHECK(loaded.scene.materials[0].base_color == mir::Material{}.base_color);
    CHECK(loaded.scene.materials[0].emission == Rgb{1, 1, 1});

    const TemporaryFolder folder("obj_reader");
    write_file(folder / "a.mtl", "newmtl a\nKd 1 0 0\n");
    write_file(folder / "b.mtl", "newmtl a\nKd 0 1 0\n");
    const auto from = [&](const std::string& text) {
        write_file(folder / "scene.obj", text);
        return mir::read_obj(folder / "scene.obj");
    };
    const std::string rest = corners + "usemtl a\nf 1 2 3\n";
    const auto two = from("mtllib a.mtl b.mtl\n" + rest);
    CHECK(two.report.ignored == once);
    CHECK(two.scene.materials.at(0).base_color == Rgb{1, 0, 0});
    CHECK(from("mtllib a.mtl\n" + rest + "mtllib b.mtl\nf 1 2 3\n").report.ignored == once);
    // One library that is named again, as exporters do for each object, is none.
    CHECK(from("mtllib a.mtl\n" + rest + "mtllib ./a.mtl\nusemtl a\nf 1 2 3\n")
              .report.ignored.empty());
}

TEST_CASE("materials that no face uses lose nothing") {
    const std::string glass =
        "newmtl glass\nKd 2 0 0\nd .5\nillum 7\nfoo\nmap_Kd none.png\nKs 1 0 0\nnewmtl glass\n";
    const std::string text = "mtllib my scene.mtl\n" + corners + "usemtl glass\n";
    const auto unused = read(text + "f 1 2\nusemtl plain\nf 1 2 3\n", glass + "newmtl plain\n");
    for (const auto& [what, times] : unused.report.ignored) UNSCOPED_INFO(what << ": " << times);
    CHECK(unused.report.ignored == Ignored{{"face of fewer than three corners", 1}});
    CHECK(unused.scene.materials.size() == 2);
    const Ignored all = {{"Kd outside 0..1 (clamped)", 1},
                         {"MTL 'foo'", 1},
                         {"colour of Ks (its mean is used)", 1},
                         {"image 'none.png' (not found)", 1},
                         {"material defined twice (the first is used)", 1},
                         {"transparency (d, Tr)", 1}};
    CHECK(read(text + "f 1 2 3\nf 1 3 4\nusemtl glass\nf 1 2 3\n", glass).report.ignored == all);
}

TEST_CASE("a library outside of the folder of its OBJ file is refused unless that is allowed") {
    const TemporaryFolder folder("obj_reader");
    std::filesystem::create_directories(folder / "scene/below");
    write_file(folder / "lib.mtl", "newmtl a\nKe 1 2 3\n");
    write_file(folder / "scene/lib.mtl", "newmtl a\nKe 4 5 6\n");
    std::filesystem::create_symlink("../lib.mtl", folder / "scene/link.mtl");
    std::filesystem::create_symlink("lib.mtl", folder / "scene/inner.mtl");
    std::filesystem::create_directory_symlink("..", folder / "scene/up");
    const auto from = [&](const std::string& library, bool allowed) {
        write_file(folder / "scene/scene.obj",
                   "mtllib " + library + "\n" + corners + "usemtl a\nf 1 2 3\n");
        mir::Limits limits;
        limits.allow_outside = allowed;
        return mir::read_obj(folder / "scene/scene.obj", limits);
    };
    const std::string absolute = (folder / "lib.mtl").string();
    for (const std::string& library :
         {std::string("../lib.mtl"), std::string("below/../../lib.mtl"), absolute,
          std::string("link.mtl"), std::string("up/lib.mtl"), std::string("lib.mtl ../lib.mtl")}) {
        INFO(library);
        ErrorCode code = ErrorCode::internal;
        const std::string message = message_of([&] { (void)from(library, false); }, &code);
        INFO(message);
        CHECK(code == ErrorCode::invalid_input);
        CHECK(message.find("scene.obj: line 1: material library '") != std::string::npos);
        CHECK(message.find("--allow-outside") != std::string::npos);
        const float red = library.starts_with("lib") ? 4.0f : 1.0f;
        CHECK(from(library, true).scene.materials.at(0).emission.r == red);
    }
    for (const std::string library : {"inner.mtl", "below/../lib.mtl", "./lib.mtl"}) {
        INFO(library);
        CHECK(from(library, false).scene.materials.at(0).emission == Rgb{4, 5, 6});
    }
}

TEST_CASE("names of an OBJ file cannot reach a terminal as commands") {
    const std::string red = "\x1b[31mred\x1b[0m";
    const std::string turned = "\xe2\x80\xae" + std::string(5000, 'x');
    const auto loaded = read("mtllib " + red + ".mtl my scene.mtl\n" + corners + red + " 1\n" +
                                 turned + "\nmtllib my scene.mtl\nusemtl a\nf 1 2 3\n",
                             "newmtl a\nmap_Kd " + red + ".png\n" + red + " 1\n");
    CHECK(loaded.report.ignored.size() == 7);
    for (const auto& [what, times] : loaded.report.ignored) {
        CHECK(mir::printable(what, 300) == what);
        CHECK(what.size() < 250);
    }
    CHECK(loaded.report.ignored.contains("statement '\\x1b[31mred\\x1b[0m'"));
    const std::string message = message_of([&] { read(corners + "f 1 2 " + red + "\n"); });
    INFO(message);
    CHECK(message.find("'\\x1b[31mred\\x1b[0m'") != std::string::npos);
    CHECK(mir::printable(message, 2000) == message);
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
        {corners + "f 1/// 2 3\n", "line 5: a corner of a face is none ('1///'", ""},
        {corners + "f 1 // 2 3\n", "line 5: a corner of a face is none ('//'", ""},
        {corners + "f /1 2 3\n", "line 5: a corner of a face is none ('/1'", ""},
        {corners + "f 1 2 3/-\n", "line 5: a corner of a face is none ('3/-'", ""},
        {corners + "f 1 2 3+\n", "line 5: a corner of a face is none ('3+'", ""},
        {corners + "f 1 2// 9//\n", "line 5: a face names vertex 9", ""},
        {corners + "f 1 2 4294967297\n", "line 5: a corner of a face is none", ""},
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
