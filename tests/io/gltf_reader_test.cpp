// SPDX-License-Identifier: MIT
#include "mir/io/gltf_reader.hpp"

#include "io/detail/gltf_triangles.hpp"
#include "io/gltf_fixture.hpp"
#include "support/catch.hpp"

#include <cstdint>
#include <string>
#include <vector>

using namespace mirtest;
using mir::Vec3;

namespace {

using Triangles = std::vector<mir::TriangleIndices>;

}  // namespace

TEST_CASE("a triangle is read with the material that glTF gives by default") {
    const auto loaded = read_text(triangle_json(), triangle_bytes());
    const mir::Scene& scene = loaded.scene;
    CHECK(scene.name == "test");
    REQUIRE(scene.meshes.size() == 1);
    const mir::Mesh& mesh = scene.meshes[0];
    CHECK(mesh.name == "m");
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.normals.empty());
    CHECK(mesh.triangles == Triangles{{0, 1, 2}});
    REQUIRE(scene.instances.size() == 1);
    CHECK(scene.instances[0].to_world == mir::Mat4(1.0f));
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].base_color == mir::Rgb{1, 1, 1});
    CHECK(scene.materials[0].metallic == 1.0f);
    CHECK(scene.materials[0].roughness == 1.0f);
    CHECK(loaded.report.triangles == 1);
    CHECK(loaded.report.bounds.high == Vec3(1, 1, 0));
    CHECK(loaded.report.is_dark());
    CHECK(loaded.report.ignored.empty());
    CHECK(loaded.report.notes.size() == 2);
}

TEST_CASE("indices of 8, 16 and 32 bits and none at all give the same triangle") {
    const std::string positions = triangle_bytes().substr(0, 36);
    const auto read_wide = [&](const char* type, const std::string& indices) {
        const auto size = std::to_string(indices.size());
        const auto total = std::to_string(36 + indices.size());
        auto text = with(triangle_json(), "5121", type);
        text = with(text, R"("byteLength":4})", R"("byteLength":)" + size + "}");
        text = with(text, R"("byteLength":40)", R"("byteLength":)" + total);
        return read_text(text, positions + indices).scene.meshes.at(0).triangles;
    };
    CHECK(read_wide("5123", bytes_of<std::uint16_t>({2, 1, 0, 0})) == Triangles{{2, 1, 0}});
    CHECK(read_wide("5125", bytes_of<std::uint32_t>({2, 1, 0})) == Triangles{{2, 1, 0}});
    CHECK(read_wide("5121", bytes_of<std::uint8_t>({2, 1, 0, 0})) == Triangles{{2, 1, 0}});
    const auto none = read_text(with(triangle_json(), R"(,"indices":1)", ""), triangle_bytes());
    CHECK(none.scene.meshes.at(0).triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("strips and fans become triangles with the winding of the specification") {
    const std::vector<std::uint32_t> order{5, 6, 7, 8, 9};
    CHECK(mir::detail::gltf_triangles(order, 5) == Triangles{{5, 6, 7}, {6, 8, 7}, {7, 8, 9}});
    CHECK(mir::detail::gltf_triangles(order, 6) == Triangles{{6, 7, 5}, {7, 8, 5}, {8, 9, 5}});
    CHECK(mir::detail::gltf_triangles({1, 2}, 5).empty());
    const auto loaded = read_text(
        with(triangle_json(), R"("indices":1)", R"("indices":1,"mode":6)"), triangle_bytes());
    CHECK(loaded.scene.meshes.at(0).triangles == Triangles{{1, 2, 0}});
}

TEST_CASE("points and lines are left out and counted") {
    const auto loaded = read_text(
        with(triangle_json(), R"("indices":1)", R"("indices":1,"mode":1)"), triangle_bytes());
    CHECK(loaded.scene.meshes.empty());
    CHECK(loaded.scene.instances.empty());
    CHECK(loaded.report.ignored.at("primitive of lines") == 1);
}

TEST_CASE("interleaved positions and normals are read with their stride, normals made unit") {
    auto text = with(triangle_json(), R"({"POSITION":0})", R"({"POSITION":0,"NORMAL":1})");
    text = with(text, R"(,"indices":1)", "");
    text = with(text, R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"})",
                R"({"bufferView":0,"byteOffset":12,"componentType":5126,"count":3,"type":"VEC3"})");
    text = with(text, R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4})",
                R"({"buffer":0,"byteLength":72,"byteStride":24})");
    text = with(text, R"("byteLength":40)", R"("byteLength":72)");
    const auto bytes = bytes_of<float>({0, 0, 0, 0, 0, 2,  //
                                        1, 0, 0, 0, 3, 0,  //
                                        0, 1, 0, 0, 0, 0});
    const auto loaded = read_text(text, bytes);
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    CHECK(mesh.positions.at(2) == Vec3(0, 1, 0));
    CHECK(mesh.normals == std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}, {0, 0, 0}});
    CHECK(loaded.report.ignored.count("normal without a direction (mesh counted once)") == 1);
}

TEST_CASE("normalised integers are mapped and bounded below by minus one") {
    auto text = with(triangle_json(), R"("componentType":5126,)",
                     R"("componentType":5120,"normalized":true,)");
    text = with(text, R"("byteLength":36})", R"("byteLength":36,"byteStride":4})");
    const auto bytes = bytes_of<std::int8_t>({127, 0, -128, 0, 0, 127, 0, 0, -127, 0, 0, 0}) +
                       std::string(24, '\0') + triangle_bytes().substr(36);
    const auto loaded = read_text(text, bytes);
    CHECK(loaded.scene.meshes.at(0).positions ==
          std::vector<Vec3>{{1, 0, -1}, {0, 1, 0}, {-1, 0, 0}});
}

TEST_CASE("a sparse accessor replaces elements, with data below it or zeros") {
    const std::string sparse =
        R"("sparse":{"count":1,"indices":{"bufferView":1,"byteOffset":1,"componentType":5121},)"
        R"("values":{"bufferView":0,"byteOffset":24}},)";
    // Index 1 of the index bytes is vertex 1; it gets the bytes of vertex 2.
    const auto over_data = read_text(
        with(triangle_json(), R"("componentType":5126,)", sparse + R"("componentType":5126,)"),
        triangle_bytes());
    CHECK(over_data.scene.meshes.at(0).positions ==
          std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}});
    const auto over_zeros =
        read_text(with(triangle_json(), R"("bufferView":0,"componentType":5126,)",
                       sparse + R"("componentType":5126,)"),
                  triangle_bytes());
    CHECK(over_zeros.scene.meshes.at(0).positions ==
          std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {0, 0, 0}});
}

TEST_CASE("nested transforms are multiplied, mirroring ones kept as they are") {
    const auto loaded =
        read_node(R"("children":[1],"translation":[1,2,3],"rotation":[0,0,2,2],"scale":[-1,1,1]},)"
                  R"({"mesh":0,"matrix":[2,0,0,0, 0,2,0,0, 0,0,2,0, 1,0,0,1])");
    REQUIRE(loaded.scene.instances.size() == 1);
    const mir::Mat4& m = loaded.scene.instances[0].to_world;
    // The child's origin (1,0,0) is mirrored to -x, turned to -y and moved.
    CHECK(distance(Vec3(m[3]), {1, 1, 3}) < 1e-6f);
    CHECK(distance(Vec3(m * mir::Vec4(0, 1, 0, 0)), {-2, 0, 0}) < 1e-6f);
    CHECK(glm::determinant(mir::Mat3(m)) == Approx(-8.0f));
}

TEST_CASE("a mesh shared by nodes is stored once and placed twice") {
    const auto loaded = read_node(R"("mesh":0,"children":[1]},{"mesh":0,"translation":[0,0,5])");
    CHECK(loaded.scene.meshes.size() == 1);
    CHECK(loaded.scene.instances.size() == 2);
    CHECK(loaded.report.triangles == 2);
    CHECK(loaded.report.stored_triangles == 1);
    CHECK(loaded.report.bounds.high.z == 5.0f);
}

TEST_CASE("instances of EXT_mesh_gpu_instancing are placed below their node") {
    const auto loaded =
        read_node(R"("mesh":0,"scale":[2,2,2],"extensions":{"EXT_mesh_gpu_instancing":)"
                  R"({"attributes":{"TRANSLATION":0}}})");
    REQUIRE(loaded.scene.instances.size() == 3);
    CHECK(distance(Vec3(loaded.scene.instances[1].to_world[3]), {2, 0, 0}) < 1e-6f);
    CHECK(distance(Vec3(loaded.scene.instances[2].to_world[0]), {2, 0, 0}) < 1e-6f);
}

TEST_CASE("without scenes every root node is placed, and the report says so") {
    const auto loaded =
        read_text(with(triangle_json(), R"("scene":0,"scenes":[{"name":"test","nodes":[0]}],)", ""),
                  triangle_bytes());
    CHECK(loaded.scene.instances.size() == 1);
    CHECK(loaded.report.notes.at(0).find("no scene") != std::string::npos);
}

TEST_CASE("a buffer inside the file as base64 is read") {
    const auto text =
        with(triangle_json(), "data.bin",
             "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAA"
             "AAAAAgD8AAAAAAAECAA==");
    CHECK(read_text(text, "unused").scene.meshes.at(0).positions.at(2) == Vec3(0, 1, 0));
}
