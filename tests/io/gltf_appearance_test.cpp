// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/io/gltf_reader.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>

using namespace mirtest;
using mir::Vec3;

namespace {

mir::Material read_material(const std::string& json) {
    auto text = with(triangle_json(), R"("indices":1)", R"("indices":1,"material":0)");
    text = with(text, R"("scene":0)", R"("materials":[)" + json + R"(],"scene":0)");
    return read_text(text, triangle_bytes()).scene.materials.at(0);
}

}  // namespace

TEST_CASE("radiance is the emissive factor times the emissive strength") {
    const auto material = read_material(
        R"({"name":"lamp","emissiveFactor":[1,0.5,0],"doubleSided":true,"extras":{"light_group":3},)"
        R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":17}}})");
    CHECK(material.emission == mir::Rgb{17.0f, 8.5f, 0.0f});
    CHECK(material.emits_from_both_sides);
    CHECK(material.light_group == 3);
    CHECK(material.name == "lamp");
}

TEST_CASE("surface factors and their extensions are read") {
    const auto material = read_material(
        R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,0.1],"metallicFactor":0,)"
        R"("roughnessFactor":0.5},"extensions":{"KHR_materials_specular":{"specularFactor":0},)"
        R"("KHR_materials_ior":{"ior":1.25}}})");
    CHECK(material.base_color == mir::Rgb{0.25f, 0.5f, 0.75f});
    CHECK(material.is_lambertian());
    CHECK(material.roughness == 0.5f);
    CHECK(material.ior == 1.25f);
    CHECK_FALSE(material.emits());
    CHECK_FALSE(material.emits_from_both_sides);
}

TEST_CASE("what a material asks for and does not get is counted by name") {
    auto text = with(triangle_json(), R"("indices":1)", R"("indices":1,"material":0)");
    text = with(text, R"("scene":0)",
                R"("scene":0,"textures":[{"source":0}],)"
                R"("images":[{"uri":"no%20such.png"},{"uri":"data:image/png;base64,AAAA"}],)"
                R"("materials":[{"alphaMode":"BLEND",)"
                R"("pbrMetallicRoughness":{"roughnessFactor":1.5,"baseColorTexture":{"index":0,)"
                R"("extensions":{"KHR_texture_transform":{"scale":[2,2]}}}},)"
                R"("extensions":{"KHR_materials_unlit":{},)"
                R"("KHR_materials_specular":{"specularColorFactor":[1,0,0]}}}])");
    text = with(text, R"("scenes":[{)", R"("scenes":[{"extras":{"environment":{"file":"x"}},)");
    const auto loaded = read_text(text, triangle_bytes());
    const std::map<std::string, std::uint64_t> expected{
        {"KHR_materials_specular specularColorFactor", 1},
        {"environment", 1},
        {"image 'no such.png' (not found)", 1},
        {"roughnessFactor outside 0..1 (clamped)", 1},
        {"texture baseColorTexture without a PNG or JPEG image", 1}};
    CHECK(loaded.report.ignored == expected);
    CHECK(loaded.scene.materials.at(0).roughness == 1.0f);
    CHECK(loaded.scene.materials.at(0).is_blended);
}

TEST_CASE("an environment that a file names is not missed where another is given") {
    const std::string text =
        with(triangle_json(), R"("scenes":[{)", R"("scenes":[{"extras":{"environment":{}},)");
    auto loaded = read_text(text, triangle_bytes());
    REQUIRE(loaded.report.ignored.contains("environment"));
    mir::put_around(loaded.scene, {}, loaded.report);
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("punctual lights shine along -z of their nodes") {
    const std::string lights =
        R"("extensions":{"KHR_lights_punctual":{"lights":[)"
        R"({"type":"point","name":"p","color":[1,0.5,0],"intensity":4},)"
        R"({"type":"spot","spot":{"innerConeAngle":0.25,"outerConeAngle":0.5}},)"
        R"({"type":"directional","intensity":3}]}},)";
    const auto node = [](const char* k) {
        return std::string(R"("extensions":{"KHR_lights_punctual":{"light":)") + k + "}}";
    };
    const std::string turned = R"("translation":[1,2,3],"rotation":[-1,0,0,1])";
    const auto loaded =
        read_node(R"("children":[1,2,3]},{)" + turned + "," + node("0") + "},{" + turned +
                      R"(,"name":"s",)" + node("1") + "},{" + turned + "," + node("2"),
                  lights);
    const mir::Scene& scene = loaded.scene;
    REQUIRE(scene.point_lights.size() == 1);
    CHECK(scene.point_lights[0].name == "p");
    CHECK(scene.point_lights[0].position == Vec3(1, 2, 3));
    CHECK(scene.point_lights[0].intensity == mir::Rgb{4, 2, 0});
    REQUIRE(scene.spot_lights.size() == 1);
    CHECK(scene.spot_lights[0].name == "s");
    CHECK(scene.spot_lights[0].intensity == mir::Rgb{1, 1, 1});
    CHECK(distance(scene.spot_lights[0].direction, {0, -1, 0}) < 1e-6f);
    CHECK(scene.spot_lights[0].cos_inner == Approx(0.96891242f));
    CHECK(scene.spot_lights[0].cos_outer == Approx(0.87758256f));
    REQUIRE(scene.directional_lights.size() == 1);
    CHECK(distance(scene.directional_lights[0].direction, {0, -1, 0}) < 1e-6f);
    CHECK(scene.directional_lights[0].irradiance == mir::Rgb{3, 3, 3});
    CHECK_FALSE(loaded.report.is_dark());
}

namespace {

/// A spot, a directional light and a camera in one node with `own`, below a node with `above`.
mir::LoadedScene lamps_and_camera(const std::string& above, const std::string& own) {
    const std::string shared =
        R"("extensions":{"KHR_lights_punctual":{"lights":[)"
        R"({"type":"spot","spot":{}},{"type":"directional"}]}},)"
        R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],)";
    const auto light = [&](const char* k) {
        return "{" + own + R"("extensions":{"KHR_lights_punctual":{"light":)" + k + "}}}";
    };
    return read_node(above + R"("children":[1,2,3]},)" + light("0") + "," + light("1") + ",{" +
                         own + R"("camera":0)",
                     shared);
}

void check_aim(const mir::LoadedScene& loaded, Vec3 direction) {
    REQUIRE(loaded.scene.spot_lights.size() == 1);
    REQUIRE(loaded.scene.directional_lights.size() == 1);
    REQUIRE(loaded.scene.cameras.size() == 1);
    CHECK(distance(loaded.scene.spot_lights[0].direction, direction) < 1e-6f);
    CHECK(distance(loaded.scene.directional_lights[0].direction, direction) < 1e-6f);
    CHECK(distance(loaded.scene.cameras[0].back, -direction) < 1e-6f);
}

}  // namespace

TEST_CASE("the scale of its node does not turn a light or a camera") {
    // A quarter turn about y: -z becomes -x.
    const std::string turned = R"("translation":[1,2,3],"rotation":[0,1,0,1],)";
    for (const char* scale : {"[-1,-1,-1]", "[1,1,-1]", "[-2,1,1]", "[3,0.5,-7]", "[0,0,0]"}) {
        CAPTURE(scale);
        const auto loaded = lamps_and_camera("", turned + R"("scale":)" + scale + ",");
        check_aim(loaded, {-1, 0, 0});
        CHECK(loaded.scene.spot_lights[0].position == Vec3(1, 2, 3));
        CHECK(distance(loaded.scene.cameras[0].right, {0, 0, -1}) < 1e-6f);
        CHECK(distance(loaded.scene.cameras[0].up, {0, 1, 0}) < 1e-6f);
    }
}

TEST_CASE("scale above a light or a camera tilts and mirrors it, at a point does not") {
    const std::string turned = R"("translation":[1,2,3],"rotation":[0,1,0,1],)";
    check_aim(lamps_and_camera(R"("scale":[-1,-1,-1],)", turned), {-1, 0, 0});
    CHECK(lamps_and_camera(R"("scale":[-1,-1,-1],)", turned).scene.spot_lights[0].position ==
          Vec3(-1, -2, -3));
    check_aim(lamps_and_camera(R"("scale":[1,1,-1],)", turned), {-1, 0, 0});
    check_aim(lamps_and_camera(R"("scale":[-1,1,1],)", turned), {1, 0, 0});
    // An eighth of a turn about y, half as far along x.
    check_aim(
        lamps_and_camera(R"("scale":[0.5,1,1],)", R"("rotation":[0,0.3826834324,0,0.9238795325],)"),
        Vec3(-0.4472136f, 0, -0.8944272f));
}

TEST_CASE("a scale by a power of two above a light or a camera changes no digit of its aim") {
    const std::string turned = R"("rotation":[0.1,-0.2,0.3,0.9],)";
    const mir::Scene home = lamps_and_camera("", turned).scene;
    for (const int exponent : {-70, -20, 1, 20, 60}) {
        CAPTURE(exponent);
        const double s = std::scalbn(1.0, exponent);
        std::ostringstream scale;
        scale << std::setprecision(17) << R"("scale":[)" << s << "," << s << "," << s << "],";
        const mir::Scene scene = lamps_and_camera(scale.str(), turned).scene;
        CHECK(scene.spot_lights[0].direction == home.spot_lights[0].direction);
        CHECK(scene.directional_lights[0].direction == home.directional_lights[0].direction);
        CHECK(scene.cameras[0].right == home.cameras[0].right);
        CHECK(scene.cameras[0].up == home.cameras[0].up);
        CHECK(scene.cameras[0].back == home.cameras[0].back);
    }
}

TEST_CASE("cameras keep their frame without the scale of their nodes") {
    const std::string cameras =
        R"("cameras":[{"type":"perspective","name":"c","perspective":{"yfov":0.75,"znear":1,)"
        R"("aspectRatio":1.5},"extras":{"resolution":[300,200],"lens_radius":0.25}},)"
        R"({"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":2,"znear":1}}],)";
    const auto loaded = read_node(
        R"("children":[1],"camera":0,"translation":[1,2,3],"rotation":[0,1,0,1],"scale":[2,3,4]},)"
        R"({"name":"flat","camera":1)",
        cameras);
    REQUIRE(loaded.scene.cameras.size() == 1);
    const mir::Camera& camera = loaded.scene.cameras[0];
    CHECK(camera.name == "c");
    CHECK(camera.position == Vec3(1, 2, 3));
    CHECK(distance(camera.back, {1, 0, 0}) < 1e-6f);
    CHECK(distance(camera.right, {0, 0, -1}) < 1e-6f);
    CHECK(distance(camera.up, {0, 1, 0}) < 1e-6f);
    CHECK(camera.vertical_fov == 0.75f);
    CHECK(camera.aspect_ratio == 1.5f);
    CHECK(camera.lens_radius == 0.25f);
    REQUIRE(loaded.report.cameras.size() == 2);
    CHECK(loaded.report.cameras[0].index == 0u);
    CHECK(loaded.report.cameras[0].width == 300);
    CHECK(loaded.report.cameras[0].height == 200);
    CHECK(loaded.report.cameras[1].name == "flat");
    CHECK(loaded.report.cameras[1].kind == "orthographic");
    CHECK_FALSE(loaded.report.cameras[1].index.has_value());
    CHECK(loaded.report.ignored.at("camera of type 'orthographic'") == 1);
}
