// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/gltf_reader.hpp"
#include "support/temporary_folder.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mirtest {

inline void write_file(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// Numbers as they lie in a buffer.
template <class T>
std::string bytes_of(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// `text` with the only occurrence of `from` replaced; the test stops when there is none.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the fixture has no " + from);
    return text.replace(at, from.size(), to);
}

/// Reads a .gltf of this text whose buffer is the file "data.bin" of these bytes.
inline mir::LoadedScene read_text(const std::string& json, const std::string& bytes,
                                  const mir::Limits& limits = {}) {
    const TemporaryFolder folder("gltf_reader");
    write_file(folder / "data.bin", bytes);
    write_file(folder / "scene.gltf", json);
    return mir::read_gltf(folder / "scene.gltf", limits);
}

/// One right triangle in the plane z = 0: 36 bytes of positions, then three 8-bit indices and a
/// byte of padding. Fragments of it are replaced by the tests.
inline std::string triangle_json() {
    return R"({"asset":{"version":"2.0"},
"scene":0,"scenes":[{"name":"test","nodes":[0]}],
"nodes":[{"name":"n","mesh":0}],
"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4}],
"buffers":[{"byteLength":40,"uri":"data.bin"}]})";
}

inline std::string triangle_bytes() {
    return bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytes_of<std::uint8_t>({0, 1, 2, 0});
}

/// The triangle file with other fields than a mesh in its only node, and more at the top level.
inline mir::LoadedScene read_node(const std::string& fields, const std::string& top = "") {
    auto text = with(triangle_json(), R"("name":"n","mesh":0)", R"("name":"n",)" + fields);
    return read_text(with(text, R"("scene":0)", top + R"("scene":0)"), triangle_bytes());
}

/// Message of the mir::Error that `action` throws, "no error" when it throws none.
template <class Action>
std::string message_of(Action&& action, mir::ErrorCode* code = nullptr) {
    try {
        action();
    } catch (const mir::Error& error) {
        if (code != nullptr) *code = error.code();
        return error.what();
    }
    return "no error";
}

/// Distance of two points or directions.
inline float distance(mir::Vec3 a, mir::Vec3 b) { return glm::length(a - b); }

}  // namespace mirtest
