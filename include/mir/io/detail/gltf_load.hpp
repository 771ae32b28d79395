// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/detail/gltf_check.hpp"
#include "mir/io/detail/read_file.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <utility>

namespace mir::detail {

inline bool is_image_name(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 11> image_endings = {
        ".png", ".jpg", ".jpeg", ".webp", ".ktx", ".ktx2", ".dds", ".bmp", ".gif", ".hdr", ".exr"};
    const std::string ending = lower_case_extension(path);
    for (std::string_view known : image_endings)
        if (ending == known) return true;
    return false;
}

/// tinygltf also looks in the working folder and reads images: neither is wanted.
inline bool gltf_file_exists(const std::string& name, void*) {
    const std::filesystem::path path = name;
    std::error_code ignored;
    return path.is_absolute() && !is_image_name(path) &&
           std::filesystem::is_regular_file(path, ignored);
}

inline bool gltf_read_file(Bytes* out, std::string*, const std::string& name, void* budget) {
    *out = read_whole_file(name, *static_cast<FileBudget*>(budget));
    return true;
}

/// Decodes nothing: most images may not be needed. What stands in the JSON is kept as it is.
inline bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                       const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// tinygltf walks JSON values recursively: deep nesting would overflow the stack.
inline void check_json_depth(std::string_view json) {
    constexpr int deepest = 200;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string && c == '\\') ++i;
        if (c == '"') in_string = !in_string;
        if (in_string) continue;
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (depth > deepest)
            throw Error(ErrorCode::invalid_input,
                        "its JSON: nested more than " + std::to_string(deepest) +
                            " levels deep (no scene needs that); repair the file");
    }
}

inline bool is_binary_gltf(const Bytes& bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// The JSON text of either form of the file.
inline std::string_view json_text(const Bytes& bytes) {
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr std::size_t header = 20;
    if (!is_binary_gltf(bytes)) return all;
    if (bytes.size() < header) return {};
    std::size_t length = 0;  // little endian, whatever this machine is
    for (std::size_t i = 0; i < 4; ++i) length |= static_cast<std::size_t>(bytes[12 + i]) << 8 * i;
    return all.substr(header, length);
}

/// tinygltf's complaint as part of a sentence.
inline std::string first_line(const std::string& text) {
    std::string line = printable(text.substr(0, text.find('\n')), 300);
    while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
    return line.empty() ? "no reason is known" : line;
}

/// The bytes of the file itself and how many there are; zeros follow them, because tinygltf may
/// look eight bytes past a binary chunk.
inline std::pair<Bytes, unsigned int> read_gltf_bytes(const std::filesystem::path& path,
                                                      FileBudget& budget) {
    Bytes bytes = read_whole_file(path, budget);
    // tinygltf takes the length as 32 bits.
    if (bytes.size() > 0xffff'ff00u)
        throw Error(ErrorCode::limit_exceeded,
                    "it has 4 GiB or more (binary glTF cannot hold that); keep the geometry in "
                    ".bin files beside a .gltf file");
    const auto size = static_cast<unsigned int>(bytes.size());
    bytes.resize(bytes.size() + 16);
    check_json_depth(json_text(bytes));
    return {std::move(bytes), size};
}

/// Parses a .gltf with its buffers or a .glb. Ranges and indices are not checked yet.
/// @throws Error(invalid_input), Error(unsupported) or Error(limit_exceeded).
inline tinygltf::Model load_gltf_model(const std::filesystem::path& path, FileBudget& budget) {
    const auto [bytes, size] = read_gltf_bytes(path, budget);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&keep_image, nullptr);
    loader.SetFsCallbacks({&gltf_file_exists, &tinygltf::ExpandFilePath, &gltf_read_file,
                           &tinygltf::WriteWholeFile, &budget});
    const std::string folder = std::filesystem::absolute(path).parent_path().string();
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool loaded =
        is_binary_gltf(bytes)
            ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, folder)
            : loader.LoadASCIIFromString(&model, &error, &warning,
                                         reinterpret_cast<const char*>(bytes.data()), size, folder);
    // tinygltf makes text of every exception of its parser, and of names in the file.
    if (error == std::bad_alloc().what()) throw std::bad_alloc();
    // An extension that is asked for and unknown is the better reason than what breaks without it.
    check_version_and_extensions(model);
    // Some errors are reported together with success.
    if (!loaded || !error.empty())
        throw Error(ErrorCode::invalid_input, "it is no valid glTF 2.0 file (" + first_line(error) +
                                                  "); repair or export it again");
    return model;
}

}  // namespace mir::detail
