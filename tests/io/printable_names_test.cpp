// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/core/printable.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/scene_reader.hpp"
#include "support/catch.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace mirtest;

namespace {

/// What JSON writes for a colour of a terminal, and a turn of the direction of writing.
const std::string json_red = R"(\u001b[31mred\u202e)";
const std::string raw_red = "\x1b[31mred\xe2\x80\xae";
const std::string shown_red = "\\x1b[31mred\\u202e";

bool is_printable(const std::string& text) { return mir::printable(text, text.size()) == text; }

void check_says(const std::string& message, const std::string& part) {
    INFO(message);
    CHECK(is_printable(message));
    CHECK(message.find(part) != std::string::npos);
}

template <class Read>
std::string refusal(const Read& read) {
    return message_of([&] { read(); });
}

}  // namespace

TEST_CASE("names of a glTF file can be printed, in errors and in its report") {
    const std::string node = R"("nodes":[{"name":"n","mesh":0})";
    const std::string named = R"("nodes":[{"name":")" + json_red + R"(","mesh":)";
    check_says(
        refusal([&] { read_text(with(triangle_json(), node, named + "7}"), triangle_bytes()); }),
        "node 0 '" + shown_red + "'");
    const std::string more =
        R"(0,"camera":0,"extensions":{")" + json_red + R"(":{}}}],"cameras":[{"name":")" +
        json_red +
        R"(","type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":9,"znear":1}})";
    const auto loaded = read_text(with(triangle_json(), node, named + more), triangle_bytes());
    CHECK(loaded.report.ignored.contains(shown_red));
    for (const auto& [what, times] : loaded.report.ignored) CHECK(is_printable(what));
    REQUIRE(loaded.report.cameras.size() == 1);
    CHECK(loaded.report.cameras[0].name == shown_red);
}

TEST_CASE("names of a PLY file and of files themselves can be printed") {
    const TemporaryFolder folder("printable_names");
    const std::filesystem::path file = folder / (raw_red + ".ply");
    const std::string start = "ply\nformat ascii 1.0\n";
    write_file(file, start + "element " + raw_red + " 1\nend_header\n");
    check_says(refusal([&] { mir::read_scene(file); }), shown_red + ".ply: ");
    check_says(refusal([&] { mir::read_scene(file); }), "element '" + shown_red + "'");
    write_file(file, start +
                         "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                         "property float " +
                         raw_red +
                         "\nelement face 1\n"
                         "property list uchar int vertex_indices\nend_header\n"
                         "0 0 0 0\n1 0 0 0\n0 1 0 0\n3 0 1 2\n");
    for (const auto& [what, times] : mir::read_scene(file).report.ignored)
        check_says(what, shown_red);
    for (const std::string ending : {".obj", ".glb", ".ply"})
        check_says(refusal([&] {
                       mir::read_scene(folder / std::string("none").append(raw_red).append(ending));
                   }),
                   std::string("none").append(shown_red).append(ending).append(
                       ": it cannot be read (no such file)"));
}

TEST_CASE("names in an OpenEXR file can be printed") {
    const TemporaryFolder folder("printable_names");
    const std::string name = raw_red + std::string(150, 'x');
    const mir::Image<mir::Rgb> image({2, 2});
    mir::write_exr(folder / "a.exr", image.extent(), {{"", &image}}, {{name, 1.0f}});
    std::string bytes;
    {
        std::ifstream stream(folder / "a.exr", std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(stream), {});
    }
    // The size of the attribute's value stands behind the name of its type.
    const std::size_t at = bytes.find(name);
    REQUIRE(at != std::string::npos);
    bytes[at + name.size() + 1 + 6] = 5;
    write_file(folder / "a.exr", bytes);
    check_says(refusal([&] { mir::read_exr(folder / "a.exr"); }), "attribute '" + shown_red);
    mir::write_exr(folder / "a.exr", image.extent(), {{"", &image}});
    check_says(refusal([&] { mir::read_exr(folder / "a.exr", raw_red); }),
               "layer '" + shown_red + "' is not in it");
}
