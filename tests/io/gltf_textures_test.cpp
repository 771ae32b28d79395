// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/io/gltf_writer.hpp"
#include "mir/scene/texture_table.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"
#include "support/textured_scene.hpp"

#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace mirtest;
using mir::ErrorCode;
using mir::Rgb;
using mir::Vec2;
using mir::Wrap;

namespace {

/// 2 x 2 pixels of 8 bits: red, green above blue, white of alpha 128.
const std::string png8 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4z8DwHwyBNAg0AABJSQl4"
    "nFEXkgAAAABJRU5ErkJggg==";

/// One pixel of 16 bits: 65535, 32896, 257, 65535.
const std::string png16 =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAYAAABPhRjKAAAAEUlEQVR42mP4/7+hgZHx/38AF34E/8QD"
    "V3UAAAAASUVORK5CYII=";

const std::string data_uri = "data:image/png;base64,";

/// The triangle with coordinates, of a material with these fields and an image of this URI. The
/// buffer holds behind the triangle: three pairs of coordinates, three RGB colours of 16 bits.
mir::LoadedScene read_textured(const std::string& fields, const std::string& uri = data_uri + png8,
                               const std::string& texture = R"("source":0)",
                               const mir::Limits& limits = {}) {
    auto json = with(triangle_json(), R"({"POSITION":0})",
                     R"({"POSITION":0,"TEXCOORD_0":2,"TEXCOORD_1":2,"COLOR_0":3})");
    json = with(json, R"("indices":1)", R"("indices":1,"material":0)");
    json = with(json, R"("accessors":[)",
                R"("materials":[{)" + fields + R"(}],"textures":[{)" + texture +
                    R"(}],"images":[{"uri":")" + uri + R"("}],
"samplers":[{"magFilter":9728,"wrapS":33071,"wrapT":33648},{"wrapS":7}],"accessors":[)");
    json = with(json, R"("type":"SCALAR"})",
                R"("type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":3,"componentType":5123,"normalized":true,"count":3,"type":"VEC3"})");
    json = with(json, R"("byteOffset":36,"byteLength":4})",
                R"("byteOffset":36,"byteLength":4},
{"buffer":0,"byteOffset":40,"byteLength":24},{"buffer":0,"byteOffset":64,"byteLength":24,"byteStride":8})");
    json = with(json, R"("byteLength":40,)", R"("byteLength":88,)");
    const std::string bytes =
        triangle_bytes() + bytes_of<float>({0, 1, 1, 1, 0, 0}) +
        bytes_of<std::uint16_t>({65535, 0, 0, 0, 0, 65535, 0, 0, 13107, 0, 0, 0});
    return read_text(json, bytes, limits);
}

const std::string base = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";

/// The base colour texture with this KHR_texture_transform.
mir::Texture transformed(const std::string& transform) {
    return read_textured(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":
{"KHR_texture_transform":{)" +
                         transform + "}}}}")
        .scene.materials.at(0)
        .textures.base_color;
}

void check_close(Vec2 a, Vec2 b) { CHECK(glm::length(a - b) < 1e-6f); }

using Ignored = std::map<std::string, std::uint64_t>;

}  // namespace

TEST_CASE("images, coordinates and vertex colours are read") {
    const auto loaded = read_textured(base);
    CHECK(loaded.report.ignored.empty());
    REQUIRE(loaded.scene.images.size() == 1);
    const mir::TextureImage& image = loaded.scene.images[0];
    CHECK(image.width == 2);
    CHECK(image.texels == std::vector<std::uint32_t>{texel(255, 0, 0), texel(0, 255, 0),
                                                     texel(0, 0, 255), texel(255, 255, 255, 128)});
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    CHECK(mesh.texture_coordinates == std::vector<Vec2>{{0, 1}, {1, 1}, {0, 0}});
    CHECK(mesh.colors == std::vector<Rgb>{{1, 0, 0}, {0, 1, 0}, {0.2f, 0, 0}});
    const mir::Texture& texture = loaded.scene.materials.at(0).textures.base_color;
    CHECK(texture.image == 0);
    CHECK(texture.wrap_u == Wrap::repeat);
    CHECK_FALSE(texture.nearest);
    CHECK(texture.place({0.3f, 0.7f}) == Vec2(0.3f, 0.7f));
    const auto wide = read_textured(base, data_uri + png16);
    CHECK(wide.scene.images.at(0).texels == std::vector<std::uint32_t>{texel(255, 128, 1)});
}

TEST_CASE("samplers choose how images go on and how they are filtered") {
    const auto loaded = read_textured(base, data_uri + png8, R"("source":0,"sampler":0)");
    const mir::Texture& texture = loaded.scene.materials.at(0).textures.base_color;
    CHECK(texture.wrap_u == Wrap::clamp);
    CHECK(texture.wrap_v == Wrap::mirror);
    CHECK(texture.nearest);
}

TEST_CASE("KHR_texture_transform shifts, scales, and turns against the clock as images are seen") {
    const mir::Texture shifted = transformed(R"("offset":[0.25,0.5],"scale":[2,4])");
    check_close(shifted.place({0.5f, 0.5f}), {1.25f, 2.5f});
    // The example of the extension's text: the lower left quarter of the image.
    const mir::Texture turned =
        transformed(R"("offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5])");
    check_close(turned.place({0, 0}), {0, 1});
    check_close(turned.place({1, 0}), {0, 0.5f});
    check_close(turned.place({0, 1}), {0.5f, 1});
    // That of an upward axis.
    check_close(transformed(R"("offset":[0,1],"scale":[1,-1])").place({0.2f, 0.3f}), {0.2f, 0.7f});
}

TEST_CASE("every part of a material has its texture, one image is read once") {
    const auto loaded = read_textured(
        R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0}},
"normalTexture":{"index":0,"scale":0.5},"emissiveTexture":{"index":0},"occlusionTexture":{"index":0})");
    CHECK(loaded.scene.images.size() == 1);
    const mir::MaterialTextures& t = loaded.scene.materials.at(0).textures;
    for (const mir::Texture& x : {t.base_color, t.metallic_roughness, t.normal, t.emission})
        CHECK(x.is_set());
    CHECK(t.normal_scale == 0.5f);
    CHECK(loaded.report.ignored == Ignored{{"texture occlusionTexture", 1}});
}

TEST_CASE("a material reads one set of coordinates, and textures on another are counted") {
    const auto loaded = read_textured(
        R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}},
"normalTexture":{"index":0})");
    CHECK(loaded.report.ignored ==
          Ignored{{"texture normalTexture on a second set of coordinates", 1}});
    CHECK(loaded.scene.meshes.at(0).texture_coordinates.size() == 3);
    const auto missing =
        read_textured(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":2}})");
    CHECK(missing.report.ignored == Ignored{{"textured mesh without texture coordinates", 1}});
}

TEST_CASE("unlit materials shine with their colour") {
    const auto loaded = read_textured(
        R"("pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1],"baseColorTexture":{"index":0}},
"extensions":{"KHR_materials_unlit":{}})");
    const mir::Material& m = loaded.scene.materials.at(0);
    CHECK(m.emission == Rgb{1, 0.5f, 0});
    CHECK(m.textures.emission.is_set());
    CHECK_FALSE(m.textures.base_color.is_set());
    CHECK(m.is_lambertian());
    CHECK(m.base_color == Rgb{});
    CHECK(loaded.report.emitting_triangles == 1);
    // Its vertex colours differ, and emission knows no colours of vertices.
    CHECK(loaded.report.ignored == Ignored{{"COLOR_0 of an unlit material", 1}});
}

TEST_CASE("masks are read with their cutoff and the alpha of factor and texture") {
    const auto loaded = read_textured(
        R"("alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.75],
"baseColorTexture":{"index":0}})");
    const mir::Material& m = loaded.scene.materials.at(0);
    CHECK(m.alpha_cutoff == 0.5f);
    CHECK(m.alpha == 0.75f);
    CHECK(loaded.scene.images.at(0).texels.at(3) >> 24 == 128);
    CHECK(loaded.report.ignored.empty());
    const auto cutoff = [](const std::string& fields) {
        return read_textured(fields + "," + base).scene.materials.at(0).alpha_cutoff;
    };
    CHECK(cutoff(R"("alphaMode":"MASK","alphaCutoff":0.25)") == 0.25f);
    CHECK(cutoff(R"("alphaMode":"MASK","alphaCutoff":0)") == 0.0f);
    CHECK(cutoff(R"("alphaMode":"OPAQUE","alphaCutoff":0.25)") == 0.0f);
    const auto blended = read_textured(R"("alphaMode":"BLEND",)" + base);
    CHECK(blended.report.ignored.empty());
    CHECK(blended.scene.materials.at(0).is_blended);
    ErrorCode code = ErrorCode::internal;
    const std::string says = message_of(
        [&] { read_textured(R"("alphaMode":"MASK","alphaCutoff":-0.5,)" + base); }, &code);
    CAPTURE(says);
    CHECK(code == ErrorCode::invalid_input);
    CHECK(says.find("material 0") != std::string::npos);
    CHECK(says.find("alphaCutoff") != std::string::npos);
}

TEST_CASE("an unlit mask keeps the texture that cuts it out") {
    const auto loaded =
        read_textured(R"("alphaMode":"MASK","extensions":{"KHR_materials_unlit":{}},)" + base);
    const mir::Material& m = loaded.scene.materials.at(0);
    CHECK(m.textures.emission.is_set());
    CHECK(m.textures.base_color.is_set());
    CHECK(m.base_color == Rgb{});
}

TEST_CASE("images that are not there or of other formats are counted") {
    CHECK(read_textured(base, "no such.png").report.ignored ==
          Ignored{{"image 'no such.png' (not found)", 1},
                  {"texture baseColorTexture without a PNG or JPEG image", 1}});
    CHECK(read_textured(base, "data:image/png;base64,R0lGODlhAQABAAAAACw=").report.ignored ==
          Ignored{{"image that is neither PNG nor JPEG", 1},
                  {"texture baseColorTexture without a PNG or JPEG image", 1}});
    CHECK(read_textured(base, data_uri + png8, R"("name":"webp")").report.ignored ==
          Ignored{{"texture baseColorTexture without a PNG or JPEG image", 1}});
}

TEST_CASE("broken textures are refused with their place") {
    struct Damage {
        std::string fields;
        std::string uri;
        std::string texture;
        const char* says;
    };
    const std::string good = data_uri + png8;
    // Width and height are bytes 16 to 23.
    const std::string huge = data_uri + "iVBORw0KGgoAAAANSUhEUgAA//8AAP//" + png8.substr(32);
    const std::string jpeg = "data:image/jpeg;base64,/9j/wAARCP////8DAREAAhEAAxEAAAAAAAAAAAAA";
    const auto damage = GENERATE_COPY(values<Damage>({
        {base, good, R"("source":3)", "texture 0: it names image 3"},
        {base, good, R"("source":0,"sampler":4)", "texture 0: it names sampler 4"},
        {base, good, R"("source":0,"sampler":1)", "sampler 1: wrap mode 7"},
        {base, good.substr(0, good.size() - 60), R"("source":0)", "image 0: it cannot be decoded"},
        {base, huge, R"("source":0)", "announce 65535 x 65535 pixels"},
        {base, jpeg, R"("source":0)", "announce 65535 x 65535 pixels"},
        {base, data_uri + "iVBORw0KGgo=", R"("source":0)", "announce 0 x 0 pixels"},
        {R"("normalTexture":{"index":0,"scale":1e300})", good, R"("source":0)",
         "scale of a normalTexture is not a finite number"},
        {R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":
{"KHR_texture_transform":{"offset":[1]}}}})",
         good, R"("source":0)", "offset of KHR_texture_transform is no pair"},
    }));
    ErrorCode code = ErrorCode::internal;
    const std::string message =
        message_of([&] { read_textured(damage.fields, damage.uri, damage.texture); }, &code);
    INFO(message);
    CHECK(message.find("scene.gltf: ") != std::string::npos);
    CHECK(message.find(damage.says) != std::string::npos);
    CHECK(code == ErrorCode::invalid_input);
}

TEST_CASE("images keep to the limit of pixels") {
    mir::Limits limits;
    limits.pixels = 3;
    ErrorCode code = ErrorCode::internal;
    (void)message_of([&] { read_textured(base, data_uri + png8, R"("source":0)", limits); }, &code);
    CHECK(code == ErrorCode::limit_exceeded);
}

TEST_CASE("textures, coordinates and colours survive being written and read") {
    mir::Scene scene = textured_triangle({});
    mir::MaterialTextures& t = scene.materials[0].textures;
    t.base_color = t.normal = t.emission = texture_of(0);
    scene.materials[0].emission = {1, 1, 1};
    scene.materials[0].alpha = 0.3f;
    scene.materials[0].alpha_cutoff = 0.7f;
    t.normal_scale = 0.25f;
    t.normal.wrap_v = Wrap::mirror;
    t.emission.nearest = true;
    const float c = std::cos(0.3f);
    const float s = std::sin(0.3f);
    t.emission.u_axis = 2.0f * Vec2(c, -s);
    t.emission.v_axis = -3.0f * Vec2(s, c);
    t.emission.offset = {0.5f, 0.25f};
    scene.images[0].texels[1] = texel(1, 2, 3, 4);
    scene.meshes[0].colors = {{1, 0, 0}, {0, 0.3f, 0}, {0, 0, 1}};
    const TemporaryFolder folder("textured_writer");
    mir::write_glb(scene, folder / "scene.glb");
    const mir::LoadedScene loaded = mir::read_gltf(folder / "scene.glb");
    CHECK(loaded.report.ignored.empty());
    CHECK(loaded.scene.images.at(0).texels == scene.images[0].texels);
    CHECK(loaded.scene.meshes.at(0).texture_coordinates == scene.meshes[0].texture_coordinates);
    CHECK(loaded.scene.meshes.at(0).colors == scene.meshes[0].colors);
    CHECK(loaded.scene.materials.at(0).alpha == 0.3f);
    CHECK(loaded.scene.materials.at(0).alpha_cutoff == 0.7f);
    const mir::MaterialTextures& back = loaded.scene.materials.at(0).textures;
    CHECK(back.base_color.is_set());
    CHECK_FALSE(back.metallic_roughness.is_set());
    CHECK(back.normal.wrap_v == Wrap::mirror);
    CHECK(back.normal_scale == 0.25f);
    CHECK(back.emission.nearest);
    for (const Vec2 at : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)})
        check_close(back.emission.place(at), t.emission.place(at));
    t.emission.v_axis = {1, 1};
    CHECK_THROWS_AS(mir::write_glb(scene, folder / "scene.glb"), mir::Error);
}

TEST_CASE("textures of extensions survive being written and read") {
    mir::Material m;
    m.transmission = 0.5f;
    m.clearcoat = m.clearcoat_roughness = 0.75f;
    m.diffuse_transmission = 0.25f;
    m.diffuse_transmission_color = {0.5f, 1.0f, 0.25f};
    mir::MaterialTextures& t = m.textures;
    t.transmission = t.clearcoat = t.clearcoat_roughness = texture_of(0);
    t.diffuse_transmission = t.diffuse_transmission_color = texture_of(0);
    t.clearcoat.nearest = true;
    t.diffuse_transmission.u_axis = {2, 0};
    const TemporaryFolder folder("extension_textures");
    mir::write_glb(textured_triangle(m), folder / "scene.glb");
    const mir::LoadedScene loaded = mir::read_gltf(folder / "scene.glb");
    // Nothing is lost by it; here glass has no coat where it is clear.
    CHECK(loaded.report.ignored.size() == 1);
    CHECK(loaded.report.ignored.contains("KHR_materials_clearcoat on glass"));
    const mir::Material& back = loaded.scene.materials.at(0);
    CHECK(back.diffuse_transmission == 0.25f);
    CHECK(back.diffuse_transmission_color == m.diffuse_transmission_color);
    CHECK(back.textures.transmission.is_set());
    CHECK(back.textures.clearcoat.nearest);
    CHECK_FALSE(back.textures.clearcoat_roughness.nearest);
    CHECK(back.textures.diffuse_transmission_color.is_set());
    check_close(back.textures.diffuse_transmission.place({1, 0}), {2, 0});
    CHECK_FALSE(back.textures.base_color.is_set());
}

TEST_CASE("the JPEG images of the wooden staircase are read") {
    const auto folder = shared_scenes();
    if (!folder) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    const auto loaded = mir::read_gltf(*folder / "staircase/staircase.glb");
    REQUIRE(loaded.scene.images.size() == 9);
    const mir::TextureTable table(loaded.scene);
    for (const mir::TextureImage& image : loaded.scene.images) {
        INFO(image.name);
        const Rgb mean = mir::mean_of(image, mir::TexelEncoding::srgb);
        CHECK(mir::luminance(mean) > 0.02f);
        CHECK(mir::luminance(mean) < 0.9f);
    }
    // Wood is brown.
    const Rgb wood = mir::mean_of(loaded.scene.images[0], mir::TexelEncoding::srgb);
    CHECK(wood.r > wood.g);
    CHECK(wood.g > wood.b);
}
