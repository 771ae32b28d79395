// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/detail/gltf_check.hpp"
#include "mir/io/detail/image_decoder.hpp"
#include "mir/io/detail/read_file.hpp"
#include "mir/io/detail/text_number.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_gltf.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace mir::detail {

/// A URI with its %20 and the like as the characters that they stand for.
inline std::string unescaped(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned int code = 0;
        const char* digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// Reads the images of one glTF file that its materials use.
class GltfImages {
 public:
    /// @pre the buffer views of the model are checked; images in data URIs keep their bytes.
    GltfImages(const tinygltf::Model& model, std::filesystem::path folder, FileBudget& budget,
               const Limits& limits, Scene& scene, SceneReport& report)
        : model_(model),
          folder_(std::move(folder)),
          budget_(budget),
          scene_(scene),
          report_(report),
          decoder_(limits, report) {}

    /// Index into Scene::images; nothing, and counted once, when the file is missing or neither PNG
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
        const tinygltf::BufferView& view = model_.bufferViews[index];
        const auto& bytes = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
        return decode({bytes.data() + view.byteOffset, view.byteLength}, from, place);
    }
    if (from.uri.empty()) return decode(from.image, from, place);
    const std::string name = unescaped(from.uri);
    std::error_code failure;
    if (!std::filesystem::is_regular_file(folder_ / name, failure)) {
        ++report_.ignored["image " + in_quotes(name) + " (not found)"];
        return std::nullopt;
    }
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
