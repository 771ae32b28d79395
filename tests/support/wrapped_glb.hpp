// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace mirtest {

/// Puts all roots of a .glb file under one node, whose members are those of `root`: "scale",
/// "rotation", "translation" or "matrix".
inline void wrap_glb(const std::filesystem::path& file, nlohmann::json root) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    in.close();
    constexpr std::size_t head = 12;  // magic, version, length
    constexpr std::size_t chunk = 8;  // length, type
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + head, 4);
    auto model = nlohmann::json::parse(bytes.substr(head + chunk, length));
    root["children"] = model["scenes"][0]["nodes"];
    model["scenes"][0]["nodes"] = {model["nodes"].size()};
    model["nodes"].push_back(std::move(root));
    std::string text = model.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    const std::string rest = bytes.substr(head + chunk + length);
    const auto put = [](std::string& to, std::size_t at, std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        std::memcpy(to.data() + at, &word, 4);
    };
    std::string header = bytes.substr(0, head + chunk);
    put(header, 8, header.size() + text.size() + rest.size());
    put(header, head, text.size());
    std::ofstream(file, std::ios::binary) << header << text << rest;
}

}  // namespace mirtest
