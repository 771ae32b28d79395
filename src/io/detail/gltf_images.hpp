// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/data_uri.hpp"
#include "io/detail/gltf_accessor.hpp"
#include "io/detail/image_decoder.hpp"
#include "io/detail/outside.hpp"
#include "io/detail/read_file.hpp"
#include "io/detail/text_number.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace mir::detail {

/// Reads the images of one glTF file that its materials use.
class GltfImages {
 public:
    /// @pre images in data URIs keep their bytes.
    GltfImages(const tinygltf::Model& model, std::filesystem::path folder, FileBudget& budget,
               const Limits& limits, Scene& scene, SceneReport& report)
        : model_(model),
          folder_(std::move(folder)),
          budget_(budget),
          allow_outside_(limits.allow_outside),
          scene_(scene),
          report_(report),
          decoder_(limits, report) {}

    /// Index into Scene::images. Nothing, and counted once, when the file is missing or neither PNG
    /// nor JPEG.
    /// @throws Error(invalid_input) when it is broken; Error(limit_exceeded) before it is decoded.
    [[nodiscard]] std::optional<std::uint32_t> find(int index, const std::string& user) {
        const auto at = checked_index(index, model_.images.size(), "image", user);
        const auto known = indices_.find(at);
        if (known != indices_.end()) return known->second;
        return indices_[at] = read(at);
    }

 private:
    [[nodiscard]] std::optional<std::uint32_t> read(std::size_t at);
    [[nodiscard]] std::optional<std::uint32_t> decode(std::span<const unsigned char> bytes,
                                                      const tinygltf::Image& from,
                                                      const std::string& place);

    const tinygltf::Model& model_;
    std::filesystem::path folder_;
    FileBudget& budget_;
    bool allow_outside_;
    Scene& scene_;
    SceneReport& report_;
    ImageDecoder decoder_;
    std::map<std::size_t, std::optional<std::uint32_t>> indices_;
};

inline std::optional<std::uint32_t> GltfImages::read(std::size_t at) {
    const tinygltf::Image& from = model_.images[at];
    const std::string place = gltf_place("image", at, from.name);
    if (from.bufferView >= 0) {
        const auto index =
            checked_index(from.bufferView, model_.bufferViews.size(), "bufferView", place);
        check_buffer_view(model_, index);
        const tinygltf::BufferView& view = model_.bufferViews[index];
        const auto& bytes = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
        return decode({bytes.data() + view.byteOffset, view.byteLength}, from, place);
    }
    if (from.uri.empty()) return decode(from.image, from, place);
    const auto count = [&](const std::string& what) {
        ++report_.ignored[what];
        return std::nullopt;
    };
    const std::string name = unescaped(from.uri);
    if (!uri_scheme(from.uri).empty())
        return count("image " + in_quotes(name) + " (only files beside the scene are read)");
    if (!allow_outside_ && leads_outside(folder_, name))
        return count("image outside of the scene's folder");
    std::error_code failure;
    if (!std::filesystem::is_regular_file(folder_ / name, failure))
        return count("image " + in_quotes(name) + " (not found)");
    return decode(read_whole_file(folder_ / name, budget_), from, place);
}

inline std::optional<std::uint32_t> GltfImages::decode(std::span<const unsigned char> bytes,
                                                       const tinygltf::Image& from,
                                                       const std::string& place) {
    std::optional<TextureImage> image =
        decoder_.decode(bytes, from.name.empty() ? from.uri : from.name, place);
    if (!image) return std::nullopt;
    scene_.images.push_back(std::move(*image));
    return static_cast<std::uint32_t>(scene_.images.size() - 1);
}

}  // namespace mir::detail
