// SPDX-License-Identifier: MIT
#include "io/obj_folder.hpp"
#include "mir/io/obj_reader.hpp"
#include "mir/scene/texture_table.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"
#include "support/textured_scene.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace mirtest;
using mir::ErrorCode;
using mir::Rgb;
using mir::Texture;
using mir::Vec2;
using mir::Wrap;

namespace {

/// Red, green and blue of 8 texels, with these alphas.
Texels with_alpha(const Texels& alphas) {
    Texels texels = eight_colors;
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = (texels[i] & 0xffffff) | alphas[i] << 24;
    return texels;
}

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
    const ObjFolder folder;
    const auto loaded = folder.read("map_Kd colors.png");
    CHECK(loaded.report.ignored.empty());
    REQUIRE(loaded.scene.images.size() == 1);
    CHECK(loaded.scene.images[0].texels == eight_colors);
    const mir::Material& material = loaded.scene.materials.at(0);
    CHECK(material.base_color == Rgb{1, 1, 1});
    CHECK_FALSE(material.is_masked());
    const mir::TextureTable table(loaded.scene);
    for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const Vec2 uv = coordinates(loaded.scene.meshes.at(0), centre(column, row));
            CHECK(table.view().color(material.textures.base_color, uv, mir::TexelEncoding::srgb) ==
                  linear(eight_colors[4 * row + column]));
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
    const ObjFolder folder;
    std::filesystem::create_directory(folder / "my maps");
    write_png(folder / "my maps/c d.png", 4, 2, eight_colors);
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
    const ObjFolder folder;
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
    const ObjFolder folder;
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
    write_png(folder / "leaf.png", 4, 2, with_alpha(alphas));
    CHECK(alphas_of(folder.read("map_Kd leaf.png\nmap_d leaf.png")) == alphas);
    const auto joined = folder.read("map_Kd colors.png\nmap_d leaf.png");
    CHECK(alphas_of(joined) == alphas);
    CHECK(joined.scene.images.at(joined.scene.materials.at(0).textures.base_color.image).texels ==
          with_alpha(alphas));
    // Without alpha brightness counts, or the channel that is named.
    Texels grey;
    for (const std::uint32_t a : alphas) grey.push_back(texel(a, a, a));
    write_png(folder / "grey.png", 4, 2, grey);
    CHECK(alphas_of(folder.read("map_d grey.png")) == alphas);
    CHECK(folder.material("map_d grey.png").base_color == Rgb{1, 1, 1});
    CHECK(alphas_of(folder.read("map_d -imfchan g colors.png")) ==
          Texels{0, 255, 0, 20, 50, 80, 2, 210});
}

TEST_CASE("a mask that cannot be had leaves a surface whole and is counted") {
    const ObjFolder folder;
    write_png(folder / "small.png", 1, 1, {texel(0, 0, 0, 0)});
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

TEST_CASE("textured corners are split where their coordinates differ, and counted without") {
    const ObjFolder folder;
    const std::string faces =
        with(textured_square, "f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3\nf 1/2 3/3 4/4");
    CHECK(folder.read("Kd 1 1 1", {}, faces).scene.meshes.at(0).positions.size() == 4);
    const auto loaded = folder.read("map_Kd colors.png", {}, faces);
    CHECK(loaded.scene.meshes.at(0).positions.size() == 5);
    CHECK(loaded.scene.meshes.at(0).texture_coordinates.size() == 5);
    CHECK(folder.read("map_Kd colors.png", {}, with(textured_square, "4/4", "4")).report.ignored ==
          Ignored{{"textured corner without texture coordinates", 1}});
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
