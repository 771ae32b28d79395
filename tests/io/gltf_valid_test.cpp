// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "support/catch.hpp"

#include <cstdint>
#include <string>
#include <vector>

using namespace mirtest;
using mir::ErrorCode;
using mir::Vec3;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The triangle with its bytes in this URI.
mir::LoadedScene read_uri(const std::string& uri) {
    return read_text(with(triangle_json(), "data.bin", uri), "unused");
}

const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAECAA==";

std::string percent_encoded(const std::string& bytes) {
    static const char* digits = "0123456789ABCDEF";
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        text += std::string("%") + digits[byte >> 4] + digits[byte & 15];
    }
    return text;
}

std::string chunk(std::uint32_t type, const std::string& data) {
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(data.size()), type}) + data;
}

constexpr std::uint32_t json_type = 0x4e4f534a;
constexpr std::uint32_t binary_type = 0x004e4942;

std::string glb(const std::string& body, std::uint32_t version = 2, int longer = 0) {
    return "glTF" +
           bytes_of<std::uint32_t>({version, static_cast<std::uint32_t>(12 + body.size()) +
                                                 static_cast<std::uint32_t>(longer)}) +
           body;
}

/// The triangle's JSON for a buffer in the file.
std::string json_of_glb() { return with(triangle_json(), R"(,"uri":"data.bin")", ""); }

std::string triangle_glb() {
    return glb(chunk(json_type, json_of_glb()) + chunk(binary_type, triangle_bytes()));
}

}  // namespace

TEST_CASE("data URIs are read with and without type, in any case, as base64 and percent-encoded") {
    const auto uri =
        GENERATE_COPY("data:application/octet-stream;base64," + base64, "data:;base64," + base64,
                      "data:application/gltf-buffer;base64," + base64,
                      "data:text/plain;charset=US-ASCII;base64," + base64,
                      "DATA:application/octet-stream;BASE64," + base64,
                      "data:;base64," + base64.substr(0, base64.size() - 2),
                      "data:;base64," + with(base64, "==", "%3D%3D"),
                      "data:," + percent_encoded(triangle_bytes()),
                      "data:application/octet-stream," + percent_encoded(triangle_bytes()),
                      // Longer than byteLength.
                      "data:;base64," + with(base64, "AA==", "AAAAAAAA"));
    CAPTURE(uri);
    CHECK(read_uri(uri).scene.meshes.at(0).positions.at(2) == Vec3(0, 1, 0));
}

TEST_CASE("data URIs that are broken or too short are refused with their buffer") {
    CHECK(has(message_of([] { read_uri("data:;base64"); }), "buffer 0: its data URI has no comma"));
    CHECK(has(message_of([] { read_uri("data:;base64,AA!A"); }), "character 2 is none of base64"));
    CHECK(has(message_of([] { read_uri("data:;base64,AAAAA"); }), "ends inside of a byte"));
    CHECK(has(message_of([] { read_uri("data:;base64,AAAA"); }),
              "buffer 0: it announces 40 bytes, of which 3 are there"));
    CHECK(has(message_of([] { read_uri("data:;base64," + base64.substr(0, 40)); }),
              "announces 40 bytes"));
}

TEST_CASE("a file of a buffer may be longer than the buffer") {
    const auto loaded = read_text(triangle_json(), triangle_bytes() + std::string(100, 'x'));
    CHECK(loaded.report.triangles == 1);
    // What lies behind the buffer is none of its bytes.
    const std::string far = with(triangle_json(), R"("byteOffset":36)", R"("byteOffset":37)");
    CHECK(has(message_of([&] { (void)read_text(far, triangle_bytes() + "xxxx"); }),
              "reach past its buffer of 40 bytes"));
}

TEST_CASE("names of buffers are percent-decoded, and a plus is a plus") {
    const TemporaryFolder folder("gltf_names");
    for (const auto& [uri, name] :
         std::vector<std::pair<std::string, std::string>>{{"a+b.bin", "a+b.bin"},
                                                          {"a%20b.bin", "a b.bin"},
                                                          {"a b c.bin", "a b c.bin"},
                                                          {"a%2Bb%2b.bin", "a+b+.bin"},
                                                          {"%41.bin", "A.bin"},
                                                          {"50%.bin", "50%.bin"},
                                                          {"%zz.bin", "%zz.bin"},
                                                          {"./sub/../x.bin", "x.bin"},
                                                          {"\xc3\xa4.bin", "\xc3\xa4.bin"},
                                                          {"%C3%B6.bin", "\xc3\xb6.bin"}}) {
        CAPTURE(uri);
        std::filesystem::create_directory(folder / "sub");
        write_file(folder / name, triangle_bytes());
        write_file(folder / "scene.gltf", with(triangle_json(), "data.bin", uri));
        CHECK(mir::read_gltf(folder / "scene.gltf").report.triangles == 1);
    }
}

TEST_CASE("animations are counted whatever is in them") {
    const char* pointer = R"({"channels":[{"sampler":0,"target":{"path":"pointer","extensions":
{"KHR_animation_pointer":{"pointer":"/nodes/0"}}}}],"samplers":[]})";
    for (const char* animation :
         {pointer, "{}", "null", "7", R"({"channels":[{"sampler":9,"target":null}]})"}) {
        CAPTURE(animation);
        const auto loaded =
            read_text(with(triangle_json(), R"("scene":0)",
                           std::string(R"("animations":[)") + animation + R"(,{}],"scene":0)"),
                      triangle_bytes());
        CHECK(loaded.report.triangles == 1);
        CHECK(loaded.report.ignored.at("animation") == 2);
    }
}

TEST_CASE("buffers, views and accessors that no picture needs may be missing or broken") {
    auto text = with(triangle_json(), R"("type":"SCALAR"})",
                     R"("type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":900,)"
                     R"("type":"MAT4"},{"componentType":1,"count":0,"type":"SCALAR"})");
    text = with(text, R"("byteOffset":36,"byteLength":4})",
                R"("byteOffset":36,"byteLength":4},{"buffer":1,"byteLength":4})");
    text = with(text, R"("uri":"data.bin"})",
                R"("uri":"data.bin"},{"byteLength":4,"uri":"animation.bin"})");
    CHECK(read_text(text, triangle_bytes()).report.triangles == 1);
}

TEST_CASE("a material that nothing is made of loses nothing") {
    const std::string lossy = R"({"alphaMode":"BLEND","extensions":{"KHR_materials_transmission":)"
                              R"({"transmissionFactor":7}},"pbrMetallicRoughness":)"
                              R"({"roughnessFactor":7}})";
    const auto unused = read_text(
        with(triangle_json(), R"("scene":0)", R"("materials":[)" + lossy + R"(],"scene":0)"),
        triangle_bytes());
    CHECK(unused.report.ignored.empty());
    CHECK(unused.scene.materials.size() == 2);
    const auto used = read_text(
        with(with(triangle_json(), R"("scene":0)", R"("materials":[)" + lossy + R"(],"scene":0)"),
             R"("indices":1)", R"("indices":1,"material":0)"),
        triangle_bytes());
    CHECK(used.report.ignored.size() == 2);
}

TEST_CASE("a material that nothing is made of may have values that mean nothing") {
    const std::string wrong =
        GENERATE(R"({"name":"m","emissiveFactor":[-1,0,0]})",
                 R"({"name":"m","extensions":{"KHR_materials_ior":{"ior":0.5}}})",
                 R"({"name":"m","alphaMode":"MASK","alphaCutoff":-1})");
    const std::string text =
        with(triangle_json(), R"("scene":0)", R"("materials":[)" + wrong + R"(],"scene":0)");
    const auto unused = read_text(text, triangle_bytes());
    CHECK(unused.scene.materials.at(0).name == "m");
    CHECK_FALSE(unused.scene.materials.at(0).emits());
    const std::string used = with(text, R"("indices":1)", R"("indices":1,"material":0)");
    CHECK_THROWS_AS(read_text(used, triangle_bytes()), mir::Error);
}

TEST_CASE("a binary file is read with its chunks, others skipped") {
    CHECK(read_text(triangle_glb(), "").report.triangles == 1);
    const std::string other = chunk(0x12345678, "abcd");
    const std::string json = chunk(json_type, json_of_glb() + "  ");
    const std::string binary = chunk(binary_type, triangle_bytes() + std::string(3, '\0'));
    CHECK(read_text(glb(json + binary + other), "").report.triangles == 1);
    CHECK(read_text(glb(json + other + binary), "").report.triangles == 1);
    CHECK(read_text(glb(chunk(json_type, triangle_json())), triangle_bytes()).report.triangles ==
          1);
    // A mark of UTF-8, zeros in place of blanks.
    CHECK(read_text(
              glb(chunk(json_type, "\xef\xbb\xbf" + json_of_glb() + std::string(2, '\0')) + binary),
              "")
              .report.triangles == 1);
    const auto longer = read_text(triangle_glb() + "12345", "");
    CHECK(longer.report.triangles == 1);
    CHECK(longer.report.notes.at(0).find("5 bytes behind the end") != std::string::npos);
}

TEST_CASE("a binary file whose container is wrong is refused with what is wrong") {
    const auto message = [](const std::string& bytes, ErrorCode* code = nullptr) {
        return message_of([&] { (void)read_text(bytes, ""); }, code);
    };
    const std::string json = chunk(json_type, json_of_glb());
    const std::string whole = triangle_glb();
    ErrorCode code = ErrorCode::internal;
    CHECK(has(message(glb(json, 1), &code), "header: it is binary glTF of version 1"));
    CHECK(code == ErrorCode::unsupported);
    CHECK(has(message(whole.substr(0, 9)), "header: it is cut short"));
    CHECK(has(message(whole.substr(0, whole.size() - 1)),
              "header: the file is cut short (it "
              "announces "));
    CHECK(has(message(glb(json, 2, -4)), "chunk 0: it reaches past the end of the file"));
    CHECK(has(message("glTF" + bytes_of<std::uint32_t>({2, 3}) + json), "announces 3 bytes"));
    CHECK(has(message(glb("")), "no chunk follows it"));
    CHECK(has(message(glb(json + "1234")), "chunk 1: it is cut short"));
    CHECK(has(message(glb(chunk(binary_type, "abcd") + json)), "chunk 0: it holds no JSON"));
    CHECK(has(message(glb(json)), "buffer 0: it has no bytes"));
    CHECK(has(message(glb(json + chunk(binary_type, "abcd"))),
              "buffer 0: it announces 40 bytes, of which 4 are there"));
    CHECK(has(message(json_of_glb()), "buffer 0: it has no bytes"));
}

TEST_CASE("required extensions that compress are refused by name with what to do") {
    const auto [name, remedy] = GENERATE(table<std::string, std::string>(
        {{"KHR_draco_mesh_compression", "without compression of meshes"},
         {"EXT_meshopt_compression", "without compression of meshes"},
         {"KHR_texture_basisu", "with PNG or JPEG images"},
         {"VENDOR_thing", "export it without"}}));
    ErrorCode code = ErrorCode::internal;
    const std::string text =
        with(triangle_json(), R"("scene":0)",
             R"("extensionsRequired":[")" + name + R"("],"accessors":7,"scene":0)");
    const std::string message =
        message_of([&] { (void)read_text(with(text, R"("accessors":[)", R"("x":[)"), ""); }, &code);
    INFO(message);
    CHECK(has(message, "'" + name + "'"));
    CHECK(has(message, remedy));
    CHECK(code == ErrorCode::unsupported);
}
