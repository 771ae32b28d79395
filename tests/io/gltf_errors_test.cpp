// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/io/gltf_reader.hpp"
#include "support/catch.hpp"

#include <limits>
#include <string>

using namespace mirtest;
using mir::ErrorCode;

namespace {

/// A change to the triangle file and what the message has to say about it.
struct Damage {
    const char* from;
    std::string to;
    const char* says;
    ErrorCode code = ErrorCode::invalid_input;
};

void check_refused(const std::string& json, const std::string& bytes, const std::string& says,
                   ErrorCode code) {
    ErrorCode found = ErrorCode::internal;
    const std::string message = message_of([&] { read_text(json, bytes); }, &found);
    INFO(message);
    CHECK(message.find("scene.gltf: ") != std::string::npos);
    CHECK(message.find(says) != std::string::npos);
    CHECK(message.find("; ") != std::string::npos);
    CHECK(found == code);
}

/// The triangle with a material.
std::string made_of(const std::string& material) {
    const std::string text =
        with(triangle_json(), R"("scene":0)", R"("materials":[{)" + material + R"(}],"scene":0)");
    return with(text, R"("indices":1)", R"("indices":1,"material":0)");
}

}  // namespace

TEST_CASE("every kind of damage is refused with its place and a remedy") {
    const char* nodes = R"("nodes":[{"name":"n","mesh":0}])";
    const char* view = R"("byteOffset":36,"byteLength":4)";
    const char* positions = R"("bufferView":0,"componentType":5126,"count":3)";
    const auto damage = GENERATE_COPY(values<Damage>({
        {R"("2.0")", R"("1.0")", "asset: it is glTF 1.0", ErrorCode::unsupported},
        {R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"],"scene":0)",
         "'KHR_draco_mesh_compression'", ErrorCode::unsupported},
        {R"("data.bin")", R"("bad_alloc.bin")", "no valid glTF"},
        {R"("scene":0)", R"("scene":7)", "names scene 7"},
        {R"("nodes":[0])", R"("nodes":[0,0])", "listed twice"},
        {R"("nodes":[0])", R"("nodes":[9])", "names node 9"},
        {nodes, R"("nodes":[{"children":[1]},{"children":[0]}])", "cycle"},
        {nodes, R"("nodes":[{"children":[0]}])", "cycle"},
        {nodes, R"("nodes":[{},{"children":[2]},{"children":[1]}])",
         "node 1: it is its own ancestor"},
        {nodes, R"("nodes":[{"children":[1,1]},{}])", "a child twice"},
        {nodes, R"("nodes":[{"children":[4]}])", "names node 4"},
        {nodes, R"("nodes":[{"mesh":5}])", "names mesh 5"},
        {nodes, R"("nodes":[{"camera":0}])", "names camera 0"},
        {nodes, R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":1e300}}}])",
         "names light 1e+300"},
        {nodes, R"("nodes":[{"rotation":[0,0,0,0]}])", "no quaternion"},
        {nodes, R"("nodes":[{"scale":[1,2]}])", "2 numbers instead of 3"},
        {nodes, R"("nodes":[{"scale":[1,2,1e300]}])", "scale is not a finite number"},
        {nodes, R"("nodes":[{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]}])", "not affine"},
        {nodes, R"("nodes":[{"scale":[1e30,1,1],"children":[1]},{"scale":[1e30,1,1],"mesh":0}])",
         "transform to the world"},
        {R"("indices":1)", R"("indices":1,"mode":9)", "mode 9"},
        {R"("indices":1)", R"("indices":1,"material":2)", "names material 2"},
        {R"("indices":1)", R"("indices":0)", "does not hold unsigned numbers"},
        {R"("POSITION":0)", R"("POSITION":1)", "does not hold vectors of 3"},
        {R"("POSITION":0)", R"("POSITION":8)", "names accessor 8"},
        {R"({"POSITION":0})", R"({"POSITION":0,"NORMAL":-1})", "names accessor -1"},
        {R"("count":3,"type":"VEC3")", R"("count":4,"type":"VEC3")", "reach past bufferView 0"},
        {R"("count":3,"type":"VEC3")", R"("count":2,"type":"VEC3")", "uses vertex 2 of 2"},
        {R"("count":3,"type":"VEC3")", R"("count":0,"type":"VEC3")", "no elements"},
        {R"("count":3,"type":"VEC3")", R"("count":18446744073709551615,"type":"VEC3")",
         "reach past bufferView"},
        {R"("bufferView":0,)", R"("bufferView":0,"byteOffset":18446744073709551615,)",
         "reach past bufferView"},
        {positions, R"("componentType":5126,"count":4000000000)", "elements without data"},
        {positions, R"("bufferView":0,"componentType":5124,"count":3)", "component type 5124"},
        {positions, R"("bufferView":5,"componentType":5126,"count":3)", "names bufferView 5"},
        {view, R"("byteOffset":36,"byteLength":5)", "reach past its buffer"},
        {view, R"("byteOffset":18446744073709551615,"byteLength":4)", "reach past its buffer"},
        {R"("byteLength":36})", R"("byteLength":36,"byteStride":4})", "overlap"},
        {R"("byteLength":40,)", R"("byteLength":99999999999,)", "File size mismatch"},
        {"data.bin", "other.bin", "File not found"},
        {R"("componentType":5126,)",
         R"("sparse":{"count":1,"indices":{"bufferView":1,"byteOffset":1,"componentType":5123},)"
         R"("values":{"bufferView":0}},"componentType":5126,)",
         "replaces element 513 of 3"},
        {R"("componentType":5126,)",
         R"("sparse":{"count":2000000000,"indices":{"bufferView":1,"componentType":5121},)"
         R"("values":{"bufferView":0}},"componentType":5126,)",
         "sparse part is broken"},
        {R"("asset")", R"("x":)" + std::string(5000, '[') + std::string(5000, ']') + R"(,"asset")",
         "nested more than"},
    }));
    check_refused(with(triangle_json(), damage.from, damage.to), triangle_bytes(), damage.says,
                  damage.code);
}

TEST_CASE("damage of a material that is used is refused with its place and a remedy") {
    struct Wrong {
        const char* material;
        const char* says;
    };
    const auto wrong = GENERATE(values<Wrong>({
        {R"("emissiveFactor":[-1,0,0])", "emissiveFactor is negative"},
        {R"("emissiveFactor":[1e200,0,0])", "is not a finite number"},
        {R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":-2}})",
         "emissiveStrength is negative"},
        {R"("extensions":{"KHR_materials_ior":{"ior":0.5}})", "below 1"},
        {R"("extras":{"light_group":70000})", "light_group"},
        {R"("normalTexture":{"index":0})", "names texture 0"},
    }));
    check_refused(made_of(wrong.material), triangle_bytes(), wrong.says, ErrorCode::invalid_input);
}

TEST_CASE("a position that is not finite is refused by mesh and number") {
    auto bytes = triangle_bytes();
    bytes.replace(12, 4, bytes_of<float>({std::numeric_limits<float>::quiet_NaN()}));
    check_refused(triangle_json(), bytes, "mesh 'm': position 1 is not finite",
                  ErrorCode::invalid_input);
}

TEST_CASE("cameras and lights that make no sense are refused") {
    const auto read_camera = [](const std::string& yfov, const std::string& node) {
        auto text = with(triangle_json(), R"("mesh":0)", R"("camera":0)" + node);
        return with(text, R"("scene":0)",
                    R"("cameras":[{"type":"perspective","perspective":{"znear":1,"yfov":)" + yfov +
                        R"(}}],"scene":0)");
    };
    check_refused(read_camera("0", ""), triangle_bytes(), "yfov", ErrorCode::invalid_input);
    check_refused(read_camera("4", ""), triangle_bytes(), "yfov", ErrorCode::invalid_input);
    check_refused(read_camera("1", R"(,"matrix":[1,0,0,0,0,1,0,0,0,0,0,0,0,0,0,1])"),
                  triangle_bytes(), "flattens", ErrorCode::invalid_input);
    const auto read_light = [](const std::string& fields) {
        auto text = with(triangle_json(), R"("mesh":0)",
                         R"("extensions":{"KHR_lights_punctual":{"light":0}})");
        return with(
            text, R"("scene":0)",
            R"("extensions":{"KHR_lights_punctual":{"lights":[{)" + fields + R"(}]}},"scene":0)");
    };
    check_refused(read_light(R"("type":"point","intensity":-1)"), triangle_bytes(),
                  "intensity is negative", ErrorCode::invalid_input);
    check_refused(read_light(R"("type":"point","color":[1,2])"), triangle_bytes(),
                  "2 numbers instead of 3", ErrorCode::invalid_input);
    check_refused(read_light(R"("type":"spot","spot":{"innerConeAngle":1,"outerConeAngle":0.5})"),
                  triangle_bytes(), "cone angles", ErrorCode::invalid_input);
}

TEST_CASE("files that are no glTF at all are refused") {
    const auto text = GENERATE(std::string(), std::string("glTF"), std::string("glTF\2\0\0\0", 8),
                               std::string("{}"), std::string("[1,2,3]"), std::string("{\"asset\""),
                               std::string(100, '\xff'), std::string(100'000, '{'),
                               std::string("\"unterminated"));
    check_refused(text, "", "", ErrorCode::invalid_input);
}

TEST_CASE("a binary file cut short at any byte is refused or read, never worse") {
    auto json = with(triangle_json(), R"(,"uri":"data.bin")", "");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto chunk = [](const char* type, const std::string& data) {
        return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(data.size())}) +
               std::string(type, 4) + data;
    };
    const auto body = chunk("JSON", json) + chunk("BIN\0", triangle_bytes());
    const auto whole =
        "glTF" + bytes_of<std::uint32_t>({2, static_cast<std::uint32_t>(12 + body.size())}) + body;
    CHECK(read_text(whole, "").scene.meshes.at(0).triangles.size() == 1);
    for (std::size_t length = 0; length < whole.size(); ++length)
        CHECK(message_of([&] { read_text(whole.substr(0, length), ""); }) != "no error");
}

TEST_CASE("any single byte of a file may be wrong without harm") {
    const auto json = triangle_json();
    for (std::size_t i = 0; i < json.size(); ++i) {
        auto text = json;
        text[i] = static_cast<char>(text[i] ^ 9);
        // Only mir::Error is caught here: any other exception fails the test.
        (void)message_of([&] { read_text(text, triangle_bytes()); });
    }
    SUCCEED();
}

TEST_CASE("limits stop the reader before it takes memory") {
    mir::Limits limits;
    ErrorCode code = ErrorCode::internal;
    const auto read = [&] { read_text(triangle_json(), triangle_bytes(), limits); };
    limits.triangles = 0;
    CHECK(message_of(read, &code).find("Limits::triangles") != std::string::npos);
    CHECK(code == ErrorCode::limit_exceeded);
    limits = {};
    limits.vertices = 2;
    CHECK(message_of(read).find("Limits::vertices") != std::string::npos);
    limits = {};
    limits.file_bytes = 100;
    CHECK(message_of(read).find("Limits::file_bytes") != std::string::npos);
    limits.file_bytes = triangle_json().size() + triangle_bytes().size() - 1;
    CHECK(message_of(read).find("Limits::file_bytes") != std::string::npos);
    limits.file_bytes += 1;
    CHECK(message_of(read) == "no error");
}

TEST_CASE("a missing file, a folder and a device are refused by name") {
    CHECK(message_of([] {
              mir::read_gltf("no/such.glb");
          }).find("no/such.glb: it cannot be read") == 0);
    CHECK(message_of([] { mir::read_gltf("."); }).find("not a regular file") != std::string::npos);
    if (std::filesystem::exists("/dev/zero"))
        CHECK(message_of([] { mir::read_gltf("/dev/zero"); }).find("not a regular file") !=
              std::string::npos);
}
