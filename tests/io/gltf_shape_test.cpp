// SPDX-License-Identifier: MIT
#include "io/gltf_everything.hpp"
#include "support/catch.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

using namespace mirtest;
using mir::Rgb;
using mir::Vec3;
using nlohmann::json;

namespace {

/// Builds a file of accessors of floats, one view and one accessor each.
class Builder {
 public:
    Builder() {
        file = json::parse(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"name":"m","primitives":[{"attributes":{}}]}],
"accessors":[],"bufferViews":[]})");
        attributes()["POSITION"] = add({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    }

    [[nodiscard]] json& primitive() { return file["meshes"][0]["primitives"][0]; }
    [[nodiscard]] json& attributes() { return primitive()["attributes"]; }

    std::size_t add(const std::vector<float>& values, const char* type) {
        return add_bytes(bytes_of(values), 5126, values.size(), type);
    }

    std::size_t add_whole(const std::vector<std::uint16_t>& values, const char* type) {
        return add_bytes(bytes_of(values), 5123, values.size(), type);
    }

    [[nodiscard]] mir::LoadedScene read(const mir::Limits& limits = {}) {
        file["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", "data.bin"}}};
        return read_text(file.dump(), bytes_, limits);
    }

    json file;

 private:
    std::size_t add_bytes(const std::string& bytes, int component, std::size_t count,
                          const char* type) {
        const std::map<std::string, std::size_t> sizes{
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
        file["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
        bytes_ += bytes;
        file["accessors"].push_back({{"bufferView", file["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count / sizes.at(type)},
                                     {"type", type}});
        return file["accessors"].size() - 1;
    }

    std::string bytes_;
};

using Ignored = std::map<std::string, std::uint64_t>;

const std::vector<float> up{0, 0, 1, 0, 0, 1, 0, 0, 1};

}  // namespace

TEST_CASE("morph targets move positions and normals by the weights of the mesh") {
    Builder b;
    b.attributes()["NORMAL"] = b.add(up, "VEC3");
    const auto moves = b.add({0, 0, 4, 0, 0, 4, 0, 0, 8}, "VEC3");
    const auto turns = b.add({0, 0, -1, 0, 0, -1, 0, 0, -3}, "VEC3");
    b.primitive()["targets"] =
        json::array({{{"POSITION", 0}}, {{"POSITION", moves}, {"NORMAL", turns}}});
    b.file["meshes"][0]["weights"] = {0, 0.5};
    const auto loaded = b.read();
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 2}, {1, 0, 2}, {0, 1, 4}});
    CHECK(mesh.normals == std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, -1}});
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("the weights of a node stand above those of its mesh, and nodes without share it") {
    Builder b;
    b.primitive()["targets"] = json::array({{{"POSITION", b.add(up, "VEC3")}}});
    b.file["meshes"][0]["weights"] = {1};
    b.file["scenes"][0]["nodes"] = {0, 1, 2, 3, 4};
    b.file["nodes"] = json::array({{{"mesh", 0}},
                                   {{"mesh", 0}, {"weights", {3}}},
                                   {{"mesh", 0}, {"weights", {0}}},
                                   {{"mesh", 0}, {"weights", {3}}},
                                   {{"mesh", 0}, {"weights", {1, 0}}}});
    const mir::Scene scene = b.read().scene;
    REQUIRE(scene.instances.size() == 5);
    CHECK(scene.meshes.size() == 3);
    const auto height = [&](std::size_t i) {
        return scene.meshes[scene.instances[i].mesh].positions[0].z;
    };
    CHECK(height(0) == 1.0f);
    CHECK(height(1) == 3.0f);
    CHECK(height(2) == 0.0f);
    CHECK(height(3) == 3.0f);
    CHECK(scene.instances[1].mesh == scene.instances[3].mesh);
    CHECK(scene.instances[0].mesh == scene.instances[4].mesh);
}

TEST_CASE("targets that no weight asks for may be broken, others not") {
    Builder b;
    b.primitive()["targets"] = json::array({{{"POSITION", "x"}}, nullptr});
    CHECK(b.read().report.ignored.empty());
    b.file["meshes"][0]["weights"] = {0, 0};
    CHECK(b.read().report.triangles == 1);
    b.file["meshes"][0]["weights"] = {0, 1};
    CHECK(message_of([&] { (void)b.read(); }).find("targets[0].POSITION is text") !=
          std::string::npos);
    Builder shorter;
    shorter.primitive()["targets"] =
        json::array({{{"POSITION", shorter.add({0, 0, 1, 0, 0, 1}, "VEC3")}}});
    shorter.file["meshes"][0]["weights"] = {1};
    CHECK(message_of([&] {
              (void)shorter.read();
          }).find("it has 2 morph targets for 3 positions") != std::string::npos);
}

namespace {

/// The triangle on two joints, which stand at x = 10 and, turned by a quarter about z, at x = 20.
/// Its node stands elsewhere.
Builder skinned() {
    Builder b;
    b.attributes()["NORMAL"] = b.add({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
    b.attributes()["JOINTS_0"] = b.add_whole({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    b.attributes()["WEIGHTS_0"] = b.add({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4");
    b.file["scenes"][0]["nodes"] = {0, 1};
    b.file["nodes"] = json::array({{{"mesh", 0}, {"skin", 0}, {"translation", {500, 0, 0}}},
                                   {{"translation", {10, 0, 0}}, {"children", {2}}},
                                   {{"translation", {10, 0, 0}}, {"rotation", {0, 0, 1, 1}}}});
    b.file["skins"] = json::array({{{"joints", {1, 2}}}});
    return b;
}

/// Positions in the coordinates of the file.
std::vector<Vec3> placed(const mir::LoadedScene& loaded) {
    const mir::Instance& instance = loaded.scene.instances.at(0);
    std::vector<Vec3> positions;
    for (const Vec3 p : loaded.scene.meshes.at(instance.mesh).positions)
        positions.push_back(Vec3(instance.to_world * mir::Vec4(p, 1.0f)) +
                            Vec3(loaded.scene.origin));
    return positions;
}

}  // namespace

TEST_CASE("a skin places its mesh by its joints, whatever the mesh's node says") {
    const auto loaded = skinned().read();
    CHECK(loaded.report.ignored.empty());
    CHECK(loaded.scene.meshes.size() == 1);
    const auto positions = placed(loaded);
    CHECK(distance(positions.at(0), {10, 0, 0}) < 1e-5f);
    CHECK(distance(positions.at(1), {20, 1, 0}) < 1e-5f);
    // Half of (10, 1, 0) and half of (19, 0, 0).
    CHECK(distance(positions.at(2), {14.5f, 0.5f, 0}) < 1e-5f);
    const auto& normals = loaded.scene.meshes.at(0).normals;
    CHECK(distance(normals.at(0), {1, 0, 0}) < 1e-6f);
    CHECK(distance(normals.at(1), {0, 1, 0}) < 1e-6f);
}

TEST_CASE("inverse bind matrices come before the joints, and joints may mirror") {
    Builder b = skinned();
    const std::vector<float> matrices{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -10, 0, 0, 1,
                                      1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,   0, 7, 1};
    b.file["skins"][0]["inverseBindMatrices"] = b.add(matrices, "MAT4");
    auto positions = placed(b.read());
    CHECK(distance(positions.at(0), {0, 0, 0}) < 1e-5f);
    CHECK(distance(positions.at(1), {20, 1, 7}) < 1e-5f);
    b.file["nodes"][1]["scale"] = {-1, 1, 1};
    const auto mirrored = b.read();
    CHECK(mirrored.scene.meshes.at(0).triangles.at(0) == mir::TriangleIndices{{0, 2, 1}});
    CHECK(distance(mirrored.scene.meshes.at(0).normals.at(0), {-1, 0, 0}) < 1e-6f);
}

TEST_CASE("a skin that cannot be used is counted and its mesh placed by its node") {
    const auto change = GENERATE(values<std::pair<const char*, const char*>>({
        {"/nodes/0/skin", "7"},
        {"/nodes/0/skin", "null"},
        {"/skins/0", "{}"},
        {"/skins/0", "3"},
        {"/skins/0/joints", "[99]"},
        {"/skins/0/joints", "[]"},
        {"/skins/0/inverseBindMatrices", "null"},
        // A joint that is not in the scene.
        {"/scenes/0/nodes", "[0]"},
        {"/meshes/0/primitives/0/attributes", R"({"POSITION":0})"},
    }));
    CAPTURE(change.first, change.second);
    Builder b = skinned();
    b.file[json::json_pointer(change.first)] = json::parse(change.second);
    const auto loaded = b.read();
    CHECK(loaded.report.ignored == Ignored{{"skin", 1}});
    CHECK(distance(placed(loaded).at(0), {500, 0, 0}) < 1e-4f);
}

TEST_CASE("vertices that hang on joints that a skin has not are refused") {
    Builder b = skinned();
    b.file["skins"][0]["joints"] = {1};
    CHECK(message_of([&] { (void)b.read(); }).find("hangs on joint 1") != std::string::npos);
}

TEST_CASE("colours of vertices tint unlit materials and thin masks where they are one colour") {
    Builder b;
    b.primitive()["material"] = 0;
    b.attributes()["COLOR_0"] =
        b.add({0.5f, 1, 0, 0.25f, 0.5f, 1, 0, 0.25f, 0.5f, 1, 0, 0.25f}, "VEC4");
    b.file["materials"] = json::parse(R"([{"extensions":{"KHR_materials_unlit":{}},
"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,1,0.5]}}])");
    const auto loaded = b.read();
    CHECK(loaded.report.ignored.empty());
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    CHECK(mesh.colors.empty());
    CHECK(loaded.scene.materials.at(mesh.material).emission == Rgb{0.25f, 0.5f, 0});
    CHECK(loaded.scene.materials.at(mesh.material).alpha == 0.125f);
    CHECK(loaded.scene.materials.at(0).emission == Rgb{0.5f, 0.5f, 1});
    // Meshes of one colour share a material.
    b.file["meshes"][0]["primitives"].push_back(b.primitive());
    CHECK(b.read().scene.materials.size() == 2);
    b.attributes()["COLOR_0"] = b.add({0, 0, 0, 1, 1, 1, 1, 0, 1, 1, 1, 1}, "VEC4");
    b.file["meshes"][0]["primitives"].erase(1);
    CHECK(b.read().report.ignored ==
          Ignored{{"COLOR_0 of an unlit material", 1}, {"alpha of COLOR_0 in a mask", 1}});
    // Nothing else asks for alpha.
    b.file["materials"][0] = json::object();
    CHECK(b.read().report.ignored.empty());
    CHECK(b.read().scene.meshes.at(0).colors.size() == 3);
}

TEST_CASE("a primitive keeps the vertices that it uses, whoever shares them") {
    Builder b;
    std::vector<float> many(3 * 1000, 7.0f);
    std::vector<float> colors(3 * 1000, 0.25f);
    for (std::size_t i = 0; i < 1000; ++i) many[3 * i] = static_cast<float>(i);
    colors[3 * 998] = 1.0f;
    b.attributes()["POSITION"] = b.add(many, "VEC3");
    b.attributes()["COLOR_0"] = b.add(colors, "VEC3");
    std::vector<std::uint16_t> order{999, 2, 998};
    b.primitive()["indices"] = b.add_whole(order, "SCALAR");
    const auto check = [&](const mir::LoadedScene& loaded, std::size_t vertices) {
        const mir::Mesh& mesh = loaded.scene.meshes.at(0);
        REQUIRE(mesh.positions.size() == vertices);
        REQUIRE(mesh.colors.size() == vertices);
        const mir::TriangleIndices& t = mesh.triangles.at(0);
        CHECK(mesh.positions.at(t[0]) == Vec3(999, 7, 7));
        CHECK(mesh.positions.at(t[1]) == Vec3(2, 7, 7));
        CHECK(mesh.positions.at(t[2]) == Vec3(998, 7, 7));
        CHECK(mesh.colors.at(t[2]).r == 1.0f);
    };
    check(b.read(), 3);
    for (int i = 0; i < 300; ++i) order.insert(order.end(), {0, 0, 1});
    b.primitive()["indices"] = b.add_whole(order, "SCALAR");
    check(b.read(), 5);
    // A sparse accessor is read as a whole first.
    const auto number = b.add_whole({5, 998}, "SCALAR");
    const auto value = b.add({1, 1, 1, 1, 0, 0}, "VEC3");
    b.file["accessors"][b.attributes()["COLOR_0"].get<std::size_t>()]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", number}, {"componentType", 5123}}},
        {"values", {{"bufferView", value}}}};
    check(b.read(), 5);
}

TEST_CASE("the memory of meshes is bounded before it is taken") {
    Builder b;
    std::vector<float> many(3 * 3000, 1.0f);
    b.attributes()["POSITION"] = b.add(many, "VEC3");
    const json one = b.primitive();
    for (int i = 1; i < 1000; ++i) b.file["meshes"][0]["primitives"].push_back(one);
    mir::Limits limits;
    limits.mesh_bytes = 1'000'000;
    mir::ErrorCode code = mir::ErrorCode::internal;
    const std::string message = message_of([&] { (void)b.read(limits); }, &code);
    CHECK(message.find("Limits::mesh_bytes allows 1000000") != std::string::npos);
    CHECK(code == mir::ErrorCode::limit_exceeded);
    // Three vertices each fit.
    const auto order = b.add_whole({0, 1, 2}, "SCALAR");
    for (json& primitive : b.file["meshes"][0]["primitives"]) primitive["indices"] = order;
    CHECK(b.read(limits).report.vertices == 3000);
}
