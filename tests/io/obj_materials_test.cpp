// SPDX-License-Identifier: MIT
#include "io/obj_fixture.hpp"
#include "mir/io/obj_reader.hpp"
#include "support/catch.hpp"

#include <filesystem>
#include <string>

using namespace mirtest;
using mir::ErrorCode;
using mir::Rgb;

namespace {

/// The scene of a square whose material has these lines.
mir::LoadedScene with_material(const std::string& lines) {
    return read_obj_text(obj_corners + "mtllib my scene.mtl\nusemtl a b\nf 1 2 3\nf 1 3 4\n",
                         "newmtl a b \n" + lines + "\n");
}

/// The only material of a library with these lines.
mir::Material material(const std::string& lines) {
    const auto loaded = with_material(lines);
    REQUIRE(loaded.scene.materials.size() == 1);
    return loaded.scene.materials[0];
}

/// What is not read of it.
Ignored lost(const std::string& lines) { return with_material(lines).report.ignored; }

}  // namespace

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
        CHECK(lost(std::string(key).append(" \t\n").append(key)) == once);
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

TEST_CASE("models of glass let light through, and those that refract are bodies") {
    for (const char* lines : {"illum 4\nNi 1.5", "illum 6\nNi 1.5", "illum 7\nTf 1 1 1\nNi 1.5",
                              "illum 9\nNi 1.5", "illum 7\nNi 1.5\nd 0"}) {
        INFO(lines);
        CHECK(lost(lines).empty());
        const mir::Material glass = material(lines);
        CHECK(glass.transmission == 1.0f);
        CHECK(glass.roughness == 0.0f);
        CHECK(glass.specular == 1.0f);
        CHECK(glass.base_color == Rgb{1, 1, 1});
        CHECK_FALSE(glass.is_blended);
    }
    CHECK(material("illum 4\nNi 1.5").is_thin);
    CHECK(material("illum 9\nNi 1.5").is_thin);
    CHECK_FALSE(material("illum 6\nNi 1.5").is_thin);
    CHECK_FALSE(material("illum 7\nNi 1.5").is_thin);
    CHECK(material("illum 7\nNi 1.33").ior == 1.33f);
    CHECK(material("illum 7\nTf .5 1 .25\nKd 0 0 0").base_color == Rgb{.5f, 1, .25f});
    CHECK(material("illum 7\nNi 1.5\nTf 0 0 0").base_color == Rgb{1, 1, 1});
    CHECK(material("illum 7\nNi 1.5\nPr .5").roughness == .5f);
}

TEST_CASE("a model of glass that exporters write for every material is none by itself") {
    for (const char* lines : {"Kd .6 .1 .1\nillum 4\nTf 1 1 1\nNi 1", "illum 9", "illum 6\nNi 1"}) {
        INFO(lines);
        CHECK_FALSE(material(lines).is_see_through());
        CHECK(material(lines).transmission == 0.0f);
        CHECK(lost(lines).empty());
    }
    const mir::Material veil = material("Kd .6 .1 .1\nillum 9\nNi 1.45\nd .5");
    CHECK(veil.is_blended);
    CHECK(veil.transmission == 0.0f);
    CHECK(veil.base_color == Rgb{.6f, .1f, .1f});
}

TEST_CASE("opacity of MTL is the covered share") {
    for (const char* lines : {"d .5", "Tr .5", "d 0.5\nTr 0", "d .5\nd .5", "d .5\nillum 2"}) {
        INFO(lines);
        CHECK(lost(lines).empty());
        CHECK(material(lines).is_blended);
        CHECK(material(lines).alpha == .5f);
    }
    for (const char* lines : {"illum 2", "illum 3", "illum 5", "illum 8", "illum 0", "Tf 1 1 1",
                              "Ni 1.5", "d 1\nTr 1", "Tr 0"}) {
        INFO(lines);
        CHECK(lost(lines).empty());
        CHECK_FALSE(material(lines).is_see_through());
    }
    CHECK(lost("d -halo 0.5") == Ignored{{"MTL option '-halo'", 1}});
    CHECK(lost("d -halo") == Ignored{{"MTL option '-halo'", 1}, {"MTL 'd' without a value", 1}});
    CHECK(lost("d 1.5") == Ignored{{"d outside 0..1 (clamped)", 1}});
}

TEST_CASE("a filter of MTL without a model of glass is counted") {
    const Ignored once = {{"Tf without a model of glass", 1}};
    for (const char* lines : {"Tf .5 1 1", "Tf 0.5", "Kt .9 .9 .9"}) {
        INFO(lines);
        CHECK(lost(lines) == once);
        CHECK_FALSE(material(lines).is_see_through());
    }
}

TEST_CASE("of materials with one name the first is taken, and the others are counted") {
    const Ignored once = {{"material defined twice (the first is used)", 1}};
    const auto loaded =
        read_obj_text("mtllib my scene.mtl\n" + obj_corners + "usemtl a\nf 1 2 3\n",
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
    const std::string rest = obj_corners + "usemtl a\nf 1 2 3\n";
    const auto two = from("mtllib a.mtl b.mtl\n" + rest);
    CHECK(two.report.ignored == once);
    CHECK(two.scene.materials.at(0).base_color == Rgb{1, 0, 0});
    CHECK(from("mtllib a.mtl\n" + rest + "mtllib b.mtl\nf 1 2 3\n").report.ignored == once);
    // One library that is named again, as exporters do for each object, is none.
    CHECK(from("mtllib a.mtl\n" + rest + "mtllib ./a.mtl\nusemtl a\nf 1 2 3\n")
              .report.ignored.empty());
}

TEST_CASE("materials that no face uses may have lines that mean nothing") {
    const std::string text = "mtllib my scene.mtl\n" + obj_corners;
    const std::string wrong = GENERATE("Kd red 0 0\n", "Ke -1 0 0\n", "Kd 1 0\n", "Ns nan\n");
    const std::string library = "Kd what\nnewmtl a\n" + wrong + "Kd 0 1 0\nnewmtl b\nKd 1 0 0\n";
    const auto unused = read_obj_text(text + "usemtl b\nf 1 2 3\n", library);
    CHECK(unused.scene.materials.at(0).name == "a");
    CHECK(unused.scene.materials.at(1).base_color == Rgb{1, 0, 0});
    CHECK_THROWS_AS(read_obj_text(text + "usemtl a\nf 1 2 3\n", library), mir::Error);
}

TEST_CASE("materials that no face uses lose nothing") {
    const std::string glass =
        "newmtl glass\nKd 2 0 0\nd .5\nillum 7\nfoo\nmap_Kd none.png\nKs 1 0 0\nnewmtl glass\n";
    const std::string text = "mtllib my scene.mtl\n" + obj_corners + "usemtl glass\n";
    const auto unused =
        read_obj_text(text + "f 1 2\nusemtl plain\nf 1 2 3\n", glass + "newmtl plain\n");
    for (const auto& [what, times] : unused.report.ignored) UNSCOPED_INFO(what << ": " << times);
    CHECK(unused.report.ignored == Ignored{{"face of fewer than three corners", 1}});
    CHECK(unused.scene.materials.size() == 2);
    const Ignored all = {{"Kd outside 0..1 (clamped)", 1},
                         {"MTL 'foo'", 1},
                         {"colour of Ks (its mean is used)", 1},
                         {"image 'none.png' (not found)", 1},
                         {"material defined twice (the first is used)", 1}};
    CHECK(read_obj_text(text + "f 1 2 3\nf 1 3 4\nusemtl glass\nf 1 2 3\n", glass).report.ignored ==
          all);
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
                   "mtllib " + library + "\n" + obj_corners + "usemtl a\nf 1 2 3\n");
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
