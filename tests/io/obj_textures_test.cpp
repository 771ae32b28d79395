// SPDX-License-Identifier: MIT
#include "io/detail/read_file.hpp"
#include "io/gltf_fixture.hpp"
#include "mir/io/obj_reader.hpp"
#include "mir/scene/texture_table.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"
#include "support/textured_scene.hpp"

#include <png.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

using namespace mirtest;
using mir::ErrorCode;
using mir::Rgb;
using mir::Texture;
using mir::Vec2;
using mir::Wrap;

namespace {

using Texels = std::vector<std::uint32_t>;
using Ignored = std::map<std::string, std::uint64_t>;

/// 4 x 2 texels, rows from the top: no two are equal.
const Texels colors = {texel(255, 0, 0),  texel(0, 255, 0),    texel(0, 0, 255),
                       texel(10, 20, 30), texel(40, 50, 60),   texel(70, 80, 90),
                       texel(1, 2, 3),    texel(200, 210, 220)};

/// Red, green and blue of 8 texels, with these alphas.
Texels with_alpha(const Texels& alphas) {
    Texels texels = colors;
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = (texels[i] & 0xffffff) | alphas[i] << 24;
    return texels;
}

/// RGBA of 8 bits; a texel has the order of bytes that PNG has on this machine.
void write_image(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                 const Texels& texels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGBA;
    REQUIRE(png_image_write_to_file(&image, path.c_str(), 0, texels.data(), 0, nullptr) != 0);
}

/// A square whose texture coordinates are x and y, of a material with these lines.
const std::string square =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl a\nf 1/1 2/2 3/3 4/4\n";

class Folder {
 public:
    Folder() { write_image(folder_ / "colors.png", 4, 2, colors); }

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return folder_ / name;
    }
    [[nodiscard]] mir::LoadedScene read(const std::string& lines, const mir::Limits& limits = {},
                                        const std::string& obj = square) const {
        write_file(folder_ / "a.mtl", "newmtl a\n" + lines + "\n");
        write_file(folder_ / "a.obj", obj);
        return mir::read_obj(folder_ / "a.obj", limits);
    }
    [[nodiscard]] mir::Material material(const std::string& lines) const {
        return read(lines).scene.materials.at(0);
    }

 private:
    TemporaryFolder folder_{"obj_textures"};
};

/// Linear colour of a texel.
Rgb linear(std::uint32_t texel) {
    const auto value = [&](std::uint32_t k) {
        return mir::texel_values()[256 + (texel >> 8 * k & 0xff)];
    };
    return {value(0), value(1), value(2)};
}

/// Where the centre of a texel of colors.png lies on the square, v counted from below.
Vec2 centre(std::size_t column, std::size_t row) {
    return {(static_cast<float>(column) + 0.5f) / 4.0f,
            1.0f - (static_cast<float>(row) + 0.5f) / 2.0f};
}

/// Texture coordinates of the mesh at a point of the square.
Vec2 coordinates(const mir::Mesh& mesh, Vec2 at) {
    const auto& uv = mesh.texture_coordinates;
    return uv.at(0) + at.x * (uv.at(1) - uv.at(0)) + at.y * (uv.at(3) - uv.at(0));
}

}  // namespace

TEST_CASE("an OBJ file's texture has the sRGB colours of its texels at their centres, upright") {
    const Folder folder;
    const auto loaded = folder.read("map_Kd colors.png");
    CHECK(loaded.report.ignored.empty());
    REQUIRE(loaded.scene.images.size() == 1);
    CHECK(loaded.scene.images[0].texels == colors);
    const mir::Material& material = loaded.scene.materials.at(0);
    CHECK(material.base_color == Rgb{1, 1, 1});
    CHECK_FALSE(material.is_masked());
    const mir::TextureTable table(loaded.scene);
    for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const Vec2 uv = coordinates(loaded.scene.meshes.at(0), centre(column, row));
            CHECK(table.view().color(material.textures.base_color, uv, mir::TexelEncoding::srgb) ==
                  linear(colors[4 * row + column]));
        }
    // Half way between two texels: their mean.
    const Vec2 between = coordinates(loaded.scene.meshes.at(0), {0.25f, 0.75f});
    const Rgb mixed =
        table.view().color(material.textures.base_color, between, mir::TexelEncoding::srgb);
    CHECK(mixed.r == Approx(0.5));
    CHECK(mixed.g == Approx(0.5));
}

TEST_CASE(
    "options of a texture scale, offset and clamp, and its name may have blanks and backslashes") {
    const Folder folder;
    std::filesystem::create_directory(folder / "my maps");
    write_image(folder / "my maps/c d.png", 4, 2, colors);
    const auto loaded =
        folder.read("map_Kd -s 2 0.5 -o 0.25 0.125 0 -clamp on my maps\\c d.png\nKd .5 .25 1");
    CHECK(loaded.report.ignored.empty());
    CHECK(loaded.scene.materials.at(0).base_color == Rgb{0.5f, 0.25f, 1});
    const Texture t = loaded.scene.materials.at(0).textures.base_color;
    CHECK(t.wrap_u == Wrap::clamp);
    CHECK(t.wrap_v == Wrap::clamp);
    // (u, v) from below becomes (2 u + 0.25, 0.5 v + 0.125).
    const Vec2 at = t.place(coordinates(loaded.scene.meshes.at(0), {0.25f, 0.75f}));
    CHECK(at == Vec2(0.75f, 1.0f - 0.5f));
    CHECK(folder.material("map_Kd -s 3 3 colors.png").textures.base_color.u_axis == Vec2(3, 0));
    CHECK(folder.material("map_Kd -clamp off colors.png").textures.base_color.wrap_u ==
          Wrap::repeat);
}

TEST_CASE("emission and normals have textures, one image is read once") {
    const Folder folder;
    const auto loaded = folder.read("Ke 2 3 4\nmap_Ke colors.png\nnorm -bm 0.5 ./colors.png\n");
    CHECK(loaded.report.ignored.empty());
    CHECK(loaded.scene.images.size() == 1);
    const mir::Material& m = loaded.scene.materials.at(0);
    CHECK(m.emission == Rgb{2, 3, 4});
    CHECK(m.textures.emission.is_set());
    CHECK(m.textures.normal.is_set());
    CHECK(m.textures.normal_scale == 0.5f);
    CHECK_FALSE(m.textures.base_color.is_set());
    CHECK(folder.material("map_Ke colors.png").emission == Rgb{1, 1, 1});
    CHECK(folder.material("map_Ke nothing.png").emission == Rgb{});
}

TEST_CASE("map_d cuts out where it is below a half") {
    const Folder folder;
    const Texels alphas = {0, 255, 128, 127, 10, 20, 30, 40};
    const auto alphas_of = [](const mir::LoadedScene& loaded) {
        CHECK(loaded.report.ignored.empty());
        const mir::Material& m = loaded.scene.materials.at(0);
        CHECK(m.alpha_cutoff == 0.5f);
        Texels found;
        for (const std::uint32_t t : loaded.scene.images.at(m.textures.base_color.image).texels)
            found.push_back(t >> 24);
        return found;
    };
    write_image(folder / "leaf.png", 4, 2, with_alpha(alphas));
    CHECK(alphas_of(folder.read("map_Kd leaf.png\nmap_d leaf.png")) == alphas);
    const auto joined = folder.read("map_Kd colors.png\nmap_d leaf.png");
    CHECK(alphas_of(joined) == alphas);
    CHECK(joined.scene.images.at(joined.scene.materials.at(0).textures.base_color.image).texels ==
          with_alpha(alphas));
    // Without alpha brightness counts, or the channel that is named.
    Texels grey;
    for (const std::uint32_t a : alphas) grey.push_back(texel(a, a, a));
    write_image(folder / "grey.png", 4, 2, grey);
    CHECK(alphas_of(folder.read("map_d grey.png")) == alphas);
    CHECK(folder.material("map_d grey.png").base_color == Rgb{1, 1, 1});
    CHECK(alphas_of(folder.read("map_d -imfchan g colors.png")) ==
          Texels{0, 255, 0, 20, 50, 80, 2, 210});
}

TEST_CASE("a mask that cannot be had leaves a surface whole and is counted") {
    const Folder folder;
    write_image(folder / "small.png", 1, 1, {texel(0, 0, 0, 0)});
    const auto check = [&](const std::string& lines, const Ignored& ignored) {
        const auto loaded = folder.read(lines);
        CHECK(loaded.report.ignored == ignored);
        CHECK_FALSE(loaded.scene.materials.at(0).is_masked());
    };
    check("map_Kd colors.png\nmap_d small.png", {{"map_d of another size than map_Kd", 1}});
    check("map_Kd colors.png\nmap_d -s 2 colors.png",
          {{"map_d with other options than map_Kd", 1}});
    check("map_d none.png", {{"image 'none.png' (not found)", 1}});
    // An image without holes would only make rays slower.
    check("map_Kd colors.png\nmap_d colors.png", {});
}

TEST_CASE("images that are missing or lie elsewhere are counted, not looked at") {
    const Folder folder;
    const std::string outside = (folder / "colors.png").string();
    const auto check = [&](const std::string& name, const std::string& why) {
        INFO(name);
        const auto loaded = folder.read("map_Kd " + name + "\nKd .1 .2 .3");
        const mir::Material& m = loaded.scene.materials.at(0);
        CHECK(loaded.report.ignored == Ignored{{why, 1}});
        CHECK_FALSE(m.textures.base_color.is_set());
        CHECK(m.base_color == Rgb{0.1f, 0.2f, 0.3f});
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
    const Folder outer;
    const Folder folder;
    std::filesystem::create_symlink(outer / "colors.png", folder / "link.png");
    mir::Limits limits;
    limits.allow_outside = true;
    for (const std::string& name : {(outer / "colors.png").string(), std::string("link.png")}) {
        const auto loaded = folder.read("map_Kd " + name, limits);
        CHECK(loaded.report.ignored.empty());
        REQUIRE(loaded.scene.images.size() == 1);
        CHECK(loaded.scene.images[0].texels == colors);
    }
}

TEST_CASE("images of a material that no face uses are not looked at") {
    const Folder folder;
    write_file(folder / "cut.png", "\x89PNG\r\n\x1a\n");
    const auto loaded =
        folder.read("Kd 1 1 1\nnewmtl b\nmap_Kd cut.png\nnewmtl c\nmap_Kd colors.png");
    CHECK(loaded.scene.images.empty());
    CHECK(loaded.scene.materials.size() == 3);
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("images are found beside their library, below the OBJ file") {
    const Folder folder;
    std::filesystem::create_directory(folder / "sub");
    write_file(folder / "sub/b.mtl", "newmtl a\nmap_Kd ../colors.png\n");
    const auto loaded = folder.read("", {}, with(square, "a.mtl", "sub/b.mtl"));
    CHECK(loaded.report.ignored.empty());
    CHECK(loaded.scene.materials.at(0).textures.base_color.is_set());
}

TEST_CASE("textured corners are split where their coordinates differ, and counted without") {
    const Folder folder;
    const std::string faces = with(square, "f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3\nf 1/2 3/3 4/4");
    CHECK(folder.read("Kd 1 1 1", {}, faces).scene.meshes.at(0).positions.size() == 4);
    const auto loaded = folder.read("map_Kd colors.png", {}, faces);
    CHECK(loaded.scene.meshes.at(0).positions.size() == 5);
    CHECK(loaded.scene.meshes.at(0).texture_coordinates.size() == 5);
    CHECK(folder.read("map_Kd colors.png", {}, with(square, "4/4", "4")).report.ignored ==
          Ignored{{"textured corner without texture coordinates", 1}});
}

TEST_CASE("broken textures of an OBJ file are refused with their place, before memory is taken") {
    const Folder folder;
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
    const Folder folder;
    mir::Limits limits;
    limits.pixels = 8;
    CHECK(folder.read("map_Kd colors.png\nmap_Ke colors.png", limits).scene.images.size() == 1);
    write_image(folder / "more.png", 1, 1, {texel(1, 1, 1)});
    ErrorCode code = ErrorCode::internal;
    (void)message_of([&] { (void)folder.read("map_Kd colors.png\nmap_Ke more.png", limits); },
                     &code);
    CHECK(code == ErrorCode::limit_exceeded);
}

TEST_CASE("the cow Spot wears its texture: pink muzzle, grey hooves, brown horns") {
    const auto shared = shared_scenes();
    if (!shared) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    const TemporaryFolder folder("spot");
    std::filesystem::copy(*shared / "spot/spot_texture.png", folder / "spot_texture.png");
    const mir::detail::Bytes shape = [&] {
        mir::detail::FileBudget budget(mir::Limits{});
        return mir::detail::read_whole_file(*shared / "spot/spot_triangulated.obj", budget);
    }();
    write_file(folder / "spot.mtl", "newmtl spot\nmap_Kd spot_texture.png\n");
    write_file(folder / "spot.obj",
               "mtllib spot.mtl\nusemtl spot\n" + std::string(shape.begin(), shape.end()));
    const auto loaded = mir::read_obj(folder / "spot.obj");
    CHECK(loaded.report.ignored.empty());
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    const mir::TextureTable table(loaded.scene);
    const auto color_at = [&](const auto& is_before) {
        const auto& p = mesh.positions;
        const auto at = std::min_element(p.begin(), p.end(), is_before) - p.begin();
        return table.view().color(loaded.scene.materials.at(0).textures.base_color,
                                  mesh.texture_coordinates.at(static_cast<std::size_t>(at)),
                                  mir::TexelEncoding::srgb);
    };
    const Rgb muzzle = color_at([](mir::Vec3 a, mir::Vec3 b) { return a.z < b.z; });
    const Rgb hoof = color_at([](mir::Vec3 a, mir::Vec3 b) { return a.y < b.y; });
    const Rgb horn = color_at([](mir::Vec3 a, mir::Vec3 b) { return a.y > b.y; });
    INFO(muzzle.r << ' ' << muzzle.g << ' ' << muzzle.b << ", " << hoof.r << ' ' << hoof.g << ", "
                  << horn.r << ' ' << horn.g);
    // White codes are 255, 238, 230; pink 255, 197, 167; brown 160, 91, 53; grey 106.
    CHECK(muzzle.r > 0.9f);
    CHECK(muzzle.g < 0.7f);
    CHECK(hoof.r < 0.2f);
    CHECK(hoof.r == Approx(hoof.g));
    CHECK(horn.r > 0.3f);
    CHECK(horn.g < 0.2f);
}
