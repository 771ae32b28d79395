// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/image_size.hpp"
#include "mir/core/limits.hpp"
#include "mir/io/scene_report.hpp"
#include "mir/scene/texture_image.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace mir::detail {

/// Decodes the images of one scene file, whose pixels keep to one limit together.
class ImageDecoder {
 public:
    ImageDecoder(const Limits& limits, SceneReport& report) : limits_(limits), report_(report) {}

    /// Adds to the pixels that the scene has.
    /// @throws Error(limit_exceeded)
    void take(std::uint64_t texels) { check_limit(texels_ += texels, limits_.pixels, "pixels"); }

    /// A PNG or JPEG image; nothing, and counted, when the bytes are of another format.
    /// @throws Error(invalid_input) when it is broken; Error(limit_exceeded) before it is decoded.
    [[nodiscard]] std::optional<TextureImage> decode(ByteSpan bytes, std::string name,
                                                     const std::string& place);

 private:
    const Limits& limits_;
    SceneReport& report_;
    std::uint64_t texels_ = 0;
};

inline std::optional<TextureImage> ImageDecoder::decode(ByteSpan bytes, std::string name,
                                                        const std::string& place) {
    if (!is_png(bytes) && !is_jpeg(bytes)) {
        ++report_.ignored["image that is neither PNG nor JPEG"];
        return std::nullopt;
    }
    take(checked_texels(bytes, place));
    tinygltf::Image decoded;
    std::string error;
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
        !tinygltf::LoadImageData(&decoded, 0, &error, nullptr, 0, 0, bytes.data(),
                                 static_cast<int>(bytes.size()), nullptr) ||
        decoded.component != 4 || (decoded.bits != 8 && decoded.bits != 16))
        fail_at(place, "it cannot be decoded (" +
                           (error.empty() ? std::string("unknown reason") : "broken data") +
                           "); repair or export the image again");
    TextureImage to;
    to.name = std::move(name);
    to.width = static_cast<std::uint32_t>(decoded.width);
    to.height = static_cast<std::uint32_t>(decoded.height);
    to.texels = texels_of(decoded.image, decoded.bits == 16 ? 2 : 1);
    return to;
}

}  // namespace mir::detail
