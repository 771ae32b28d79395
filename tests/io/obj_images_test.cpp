// SPDX-License-Identifier: MIT
// Which image files of an OBJ file's materials are read, left out or refused.
#include "io/obj_folder.hpp"
#include "mir/io/obj_reader.hpp"
#include "support/catch.hpp"

#include <string>

using namespace mirtest;
using mir::ErrorCode;

TEST_CASE("images that are missing or lie elsewhere are counted, not looked at") {
    const ObjFolder folder;
    const std::string outside = (folder / "colors.png").string();
    const auto check = [&](const std::string& name, const std::string& why) {
        INFO(name);
        const auto loaded = folder.read("map_Kd " + name + "\nKd .1 .2 .3");
        const mir::Material& m = loaded.scene.materials.at(0);
        CHECK(loaded.report.ignored == Ignored{{why, 1}});
        CHECK_FALSE(m.textures.base_color.is_set());
        CHECK(m.base_color == mir::Rgb{0.1f, 0.2f, 0.3f});
        CHECK(loaded.scene.meshes.at(0).texture_coordinates.empty());
    };
    const std::string elsewhere = " (outside of the folder of the OBJ file)";
    check("none.png", "image 'none.png' (not found)");
    check("../a.png", "image '../a.png'" + elsewhere);
    check("x/../../a.png", "image 'x/../../a.png'" + elsewhere);
    check(outside, "image '" + mir::printable(outside) + "'" + elsewhere);
    const TemporaryFolder outer("obj_outer");
    write_file(outer / "a.png", "never looked at");
    std::filesystem::create_symlink(outer / "a.png", folder / "link.png");
    check("link.png", "image 'link.png'" + elsewhere);
    write_file(folder / "text.png", "no image");
    check("text.png", "image that is neither PNG nor JPEG");
    CHECK(folder.read("map_Kd -mm 0 2 colors.png").report.ignored ==
          Ignored{{"MTL option '-mm'", 1}});
    CHECK(folder.read("map_d -imfchan z colors.png").report.ignored ==
          Ignored{{"MTL option '-imfchan'", 1}});
}

TEST_CASE("images that lie elsewhere are read where that is allowed") {
    const ObjFolder outer;
    const ObjFolder folder;
    std::filesystem::create_symlink(outer / "colors.png", folder / "link.png");
    mir::Limits limits;
    limits.allow_outside = true;
    for (const std::string& name : {(outer / "colors.png").string(), std::string("link.png")}) {
        const auto loaded = folder.read("map_Kd " + name, limits);
        CHECK(loaded.report.ignored.empty());
        REQUIRE(loaded.scene.images.size() == 1);
        CHECK(loaded.scene.images[0].texels == eight_colors);
    }
}

TEST_CASE("images of a material that no face uses are not looked at") {
    const ObjFolder folder;
    write_file(folder / "cut.png", "\x89PNG\r\n\x1a\n");
    const auto loaded =
        folder.read("Kd 1 1 1\nnewmtl b\nmap_Kd cut.png\nnewmtl c\nmap_Kd colors.png");
    CHECK(loaded.scene.images.empty());
    CHECK(loaded.scene.materials.size() == 3);
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("images are found beside their library, below the OBJ file") {
    const ObjFolder folder;
    std::filesystem::create_directory(folder / "sub");
    write_file(folder / "sub/b.mtl", "newmtl a\nmap_Kd ../colors.png\n");
    const auto loaded = folder.read("", {}, with(textured_square, "a.mtl", "sub/b.mtl"));
    CHECK(loaded.report.ignored.empty());
    CHECK(loaded.scene.materials.at(0).textures.base_color.is_set());
}

TEST_CASE("broken textures of an OBJ file are refused with their place, before memory is taken") {
    const ObjFolder folder;
    // Literals that know where they end, zeros and all.
    using namespace std::string_literals;
    // A header of 65535 x 65535 pixels and nothing behind it.
    write_file(folder / "huge.png",
               "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xff\xff\0\0\xff\xff\x08\x06\0\0\0"s);
    // A pixel whose data is said to take half a gigabyte.
    write_file(folder / "long.png",
               "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\x06\0\0\0"
               "\x1f\x15\xc4\x89\x20\0\0\0IDATx\x9c\x63\0\0\0\0"s);
    write_file(folder / "cut.png", "\x89PNG\r\n\x1a\n");
    struct Damage {
        std::string lines;
        const char* says;
    };
    const auto damage = GENERATE(values<Damage>({
        {"map_Kd huge.png", "a.mtl, line 2, image 'huge.png': it is no image"},
        {"map_Kd huge.png", "announce 65535 x 65535 pixels"},
        {"map_Kd long.png", "its chunk at byte 33 announces 536870912 bytes, of which 3 are there"},
        {"map_d cut.png", "a.mtl, line 2, image 'cut.png'"},
        {"map_Kd -s", "a.mtl, line 2: map_Kd -s has no value"},
        {"norm -bm x colors.png", "a.mtl, line 2: norm -bm is no number ('x')"},
        {"map_Ke -o 1e39 colors.png", "a.mtl, line 2: map_Ke -o is not a finite number"},
    }));
    ErrorCode code = ErrorCode::internal;
    const std::string message = message_of([&] { (void)folder.read(damage.lines); }, &code);
    INFO(message);
    CHECK(message.find("a.obj: ") != std::string::npos);
    CHECK(message.find(damage.says) != std::string::npos);
    CHECK(code == ErrorCode::invalid_input);
}

TEST_CASE("images of an OBJ file keep to the limit of pixels together") {
    const ObjFolder folder;
    mir::Limits limits;
    limits.pixels = 8;
    CHECK(folder.read("map_Kd colors.png\nmap_Ke colors.png", limits).scene.images.size() == 1);
    write_png(folder / "more.png", 1, 1, {texel(1, 1, 1)});
    ErrorCode code = ErrorCode::internal;
    (void)message_of([&] { (void)folder.read("map_Kd colors.png\nmap_Ke more.png", limits); },
                     &code);
    CHECK(code == ErrorCode::limit_exceeded);
}
