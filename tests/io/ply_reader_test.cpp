// SPDX-License-Identifier: MIT
#include "mir/io/ply_reader.hpp"

#include "io/gltf_fixture.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

using namespace mirtest;
using mir::ErrorCode;
using mir::Vec3;

namespace {

mir::LoadedScene read(const std::string& bytes, const mir::Limits& limits = {}) {
    const TemporaryFolder folder("ply_reader");
    write_file(folder / "scene.ply", bytes);
    return mir::read_ply(folder / "scene.ply", limits);
}

std::string header(const std::string& format, const std::string& between = "") {
    return "ply\nformat " + format +
           " 1.0\ncomment made here\nelement vertex 4\nproperty float x\nproperty double y\n"
           "property short z\nproperty uchar q\nelement face 1\n"
           "property list uchar uint vertex_indices\n" +
           between + "end_header\n";
}

/// Bytes of a value, the most significant one first when `big`.
template <class T>
std::string bytes(T value, bool big) {
    std::string text = bytes_of<T>({value});
    // Tests run on little-endian machines.
    if (big) std::reverse(text.begin(), text.end());
    return text;
}

std::string binary(bool big) {
    std::string text = header(big ? "binary_big_endian" : "binary_little_endian");
    const std::vector<Vec3> square{{0, 0, -5}, {1, 0, -5}, {1, 1.5f, -5}, {0, 1, -5}};
    for (const Vec3& p : square)
        text += bytes<float>(p.x, big) + bytes<double>(p.y, big) +
                bytes<std::int16_t>(static_cast<std::int16_t>(p.z), big) + "\x07";
    text += bytes<std::uint8_t>(4, big);
    for (std::uint32_t i = 0; i < 4; ++i) text += bytes<std::uint32_t>(i, big);
    return text;
}

std::string ascii(const std::string& vertices = "0 0 -5 7\n1 0 -5 7\n1 1.5 -5 7\n0 1 -5 7\n",
                  const std::string& faces = "4 0 1 2 3\n") {
    return header("ascii") + vertices + faces;
}

}  // namespace

TEST_CASE("PLY in text and in both byte orders gives the same mesh") {
    for (const std::string& file : {ascii(), binary(false), binary(true)}) {
        const auto loaded = read(file);
        REQUIRE(loaded.scene.meshes.size() == 1);
        const mir::Mesh& mesh = loaded.scene.meshes[0];
        CHECK(mesh.name == "scene");
        CHECK(mesh.positions ==
              std::vector<Vec3>{{0, 0, -5}, {1, 0, -5}, {1, 1.5f, -5}, {0, 1, -5}});
        CHECK(mesh.triangles == std::vector<mir::TriangleIndices>{{0, 1, 2}, {0, 2, 3}});
        CHECK(mesh.normals.empty());
        CHECK(loaded.scene.materials.at(0).is_lambertian());
        CHECK(loaded.report.ignored ==
              std::map<std::string, std::uint64_t>{{"PLY vertex property 'q'", 1}});
        CHECK(loaded.report.is_dark());
    }
}

TEST_CASE("normals are read and other elements skipped") {
    const auto loaded = read(
        "ply\r\nformat ascii 1.0  \r\nobj_info x\r\nelement camera 2\r\n"
        "property list int float params\r\nproperty char c\r\nelement vertex 3\r\n"
        "property float nx\nproperty float ny\nproperty float nz\nproperty float x\n"
        "property float y\nproperty float z\nelement face 2\nproperty int material\n"
        "property list uchar int vertex_index\nend_header\n"
        "2 .5 1e1 3\r\n0 4\r\n0 0 2 0 0 0\n0 0 2 1 0 0\n0 0 2 0 1 0\n9 3 0 1 2\n9 2 0 1");
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    CHECK(mesh.normals == std::vector<Vec3>(3, Vec3(0, 0, 1)));
    CHECK(mesh.triangles.size() == 1);
    CHECK(loaded.report.ignored ==
          std::map<std::string, std::uint64_t>{{"PLY element 'camera'", 1},
                                               {"PLY face property 'material'", 1},
                                               {"face of fewer than three corners", 1}});
}

TEST_CASE("colours of PLY vertices are sRGB codes") {
    const auto loaded = read(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty float blue\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 255 0 0.5\n1 0 0 0 188 0\n0 1 0 0 0 1\n3 0 1 2\n");
    const mir::Mesh& mesh = loaded.scene.meshes.at(0);
    REQUIRE(mesh.colors.size() == 3);
    CHECK(mesh.colors[0].r == 1.0f);
    CHECK(mesh.colors[0].b == Approx(0.2140411405));
    CHECK(mesh.colors[1].g == Approx(0.5028864580));
    CHECK(loaded.scene.materials.at(0).base_color == mir::Rgb{1, 1, 1});
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("a cloud of points has nothing to see and is no error") {
    const auto loaded = read(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n1 2 3\n");
    CHECK(loaded.scene.instances.empty());
    CHECK(loaded.report.notes.at(0).find("no triangles") == 0);
}

TEST_CASE("damage in a PLY file is refused with its place and a remedy") {
    struct Damage {
        std::string file;
        const char* says;
    };
    const std::string quad = "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n";
    const auto damage = GENERATE_COPY(values<Damage>({
        {"", "header: it has no end"},
        {"plx\n", "header, line 1: it is not 'ply'"},
        {"ply\nend_header\n", "header: it has no format"},
        {"ply\nformat ascii 2.0\n", "header, line 2: it is of format 'ascii', version '2.0'"},
        {"ply\nformat text 1.0\n", "header, line 2: it is of format 'text'"},
        {"ply\nformat ascii 1.0\nend_header\n", "no element 'vertex'"},
        {"ply\nproperty float x\n", "header, line 2: a property comes before"},
        {"ply\nelement vertex\n", "header, line 2: it is no statement"},
        {"ply\nelement vertex -1\n", "header, line 2: the number of elements is none ('-1')"},
        {"ply\nelement vertex 4\nproperty half x\n", "line 3: there is no type 'half'"},
        {"ply\nelement v 4\nproperty list float int x\n", "lists are counted in 'float'"},
        {with(ascii(), "element face", "element vertex 0\nelement face"), "lacks one of"},
        {with(ascii(), "property uchar q", "property uchar x"), "property 'x' twice"},
        {with(ascii(), "vertex 4", "vertex 1000000000"),
         "line 4: it announces 1000000000 of 'vertex', at least 8000000000 bytes, but "},
        {with(binary(false), "face 1", "face 18446744073709551615"),
         "line 9: it announces 18446744073709551615 of 'face'"},
        {with(ascii(), "face 1", "face 0\nelement void 18446744073709551615"), "line 10"},
        {"ply\nformat ascii 1.0\nelement e 3\nend_header\n", "element 'e' has no properties"},
        {binary(false).substr(0, binary(false).size() - 1),
         "element 'face', number 0: its list is of 4 numbers"},
        {ascii(quad, "4 0 1 2\n"), "element 'face', number 0: the file ends there"},
        {ascii(quad, "4000000000 0 1 2\n"), "number 0: its list is of"},
        {ascii(quad, "1e300 0 1 2\n"), "element 'face', number 0: its list is of 1e+300 numbers"},
        {ascii(quad, "-3 0 1 2\n"), "element 'face', number 0: its list is of -3"},
        {ascii(quad, "3 0 1 4\n"), "element 'face', number 0: it names vertex 4, but there are 4"},
        {ascii(quad, "3 0 1 -1\n"), "it names vertex -1"},
        {ascii(quad, "3 0 1 618446744073709551615\n"), "it names vertex 618446744073709551616"},
        {ascii(quad, "3 0 1 1.5\n"), "a whole number was expected ('1.5' is none)"},
        {ascii("0 0 0 0\n1 nan 0 0\n1 1 0 0\n0 1 0 0\n"),
         "element 'vertex', number 1: y is not a finite number"},
        {ascii("0 0 0 0\n1 0 0 0\n1e39 1 0 0\n0 1 0 0\n"),
         "element 'vertex', number 2: x is not a finite number"},
        {ascii("0 0 0 0\n1 zero 0 0\n1 1 0 0\n0 1 0 0\n"),
         "element 'vertex', number 1: a number was expected ('zero' is none)"},
    }));
    ErrorCode code = ErrorCode::internal;
    const std::string message = message_of([&] { read(damage.file); }, &code);
    INFO(message);
    CHECK(message.find("scene.ply: ") != std::string::npos);
    CHECK(message.find(damage.says) != std::string::npos);
    CHECK(message.find("; ") != std::string::npos);
    CHECK(code == ErrorCode::invalid_input);
}

TEST_CASE("a PLY file keeps to the limits") {
    for (const char* which : {"triangles", "vertices", "file_bytes"}) {
        mir::Limits limits;
        (which[0] == 't'   ? limits.triangles
         : which[0] == 'v' ? limits.vertices
                           : limits.file_bytes) = 1;
        ErrorCode code = ErrorCode::internal;
        const std::string message = message_of([&] { read(ascii(), limits); }, &code);
        INFO(message);
        CHECK(message.find(which) != std::string::npos);
        CHECK(code == ErrorCode::limit_exceeded);
    }
}

TEST_CASE("any byte of a PLY file may be wrong without harm") {
    const std::string good = binary(true);
    for (std::size_t i = 0; i < good.size(); ++i)
        for (const char byte : {'\0', '\x7f', '\xff', ' '}) {
            std::string bad = good;
            bad[i] = byte;
            // Either it is read or an Error says why not; anything else ends the test.
            (void)message_of([&] { read(bad); });
        }
    CHECK(read(good).report.triangles == 2);
}
