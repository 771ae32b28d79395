// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/glb_container.hpp"
#include "io/detail/gltf_parse.hpp"
#include "io/detail/read_file.hpp"
#include "mir/io/scene_report.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace mir::detail {

/// Version and required extensions: what breaks without one is the worse reason.
inline void parse_asset(const GltfDocument& document, tinygltf::Model& model) {
    const GltfValue asset = document.root().need("asset", "an object");
    model.asset.version = asset.need("version", "text").text();
    take(asset, "minVersion", model.asset.minVersion);
    if (const auto required = document.root().find("extensionsRequired"))
        for (std::size_t i = 0; i < required->size(); ++i)
            model.extensionsRequired.push_back(required->at(i).text());
    check_version_and_extensions(model);
}

/// The JSON of a file, and in `binary` its binary chunk. Its other bytes are let go.
inline Json read_gltf_json(const std::filesystem::path& path, const Limits& limits,
                           FileBudget& budget, SceneReport& report, std::optional<Bytes>& binary) {
    Bytes bytes = read_whole_file(path, budget);
    const GltfParts parts = gltf_parts(bytes);
    if (parts.behind > 0)
        report.notes.push_back("the file has " + std::to_string(parts.behind) +
                               " bytes behind the end that its header announces: they were not "
                               "read");
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    Json json = parse_gltf_json(all.substr(parts.json.first, parts.json.size), limits);
    if (!parts.binary) return json;
    // Moved within its own memory: a copy would need twice of it.
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(parts.binary->first);
    bytes.erase(first + static_cast<std::ptrdiff_t>(parts.binary->size), bytes.end());
    bytes.erase(bytes.begin(), first);
    binary = std::move(bytes);
    return json;
}

/// Reads a .gltf with those of its buffers that its scene needs, or a .glb. Ranges are not checked
/// yet.
/// @throws Error(invalid_input), Error(unsupported) or Error(limit_exceeded).
inline tinygltf::Model load_gltf_model(const std::filesystem::path& path, const Limits& limits,
                                       FileBudget& budget, SceneReport& report) {
    std::optional<Bytes> binary;
    const Json json = read_gltf_json(path, limits, budget, report, binary);
    const GltfDocument document(json);
    tinygltf::Model model;
    parse_asset(document, model);
    GltfBuffers buffers(path.parent_path(), std::move(binary), limits, budget);
    GltfParser(document, buffers, model).parse();
    return model;
}

}  // namespace mir::detail
