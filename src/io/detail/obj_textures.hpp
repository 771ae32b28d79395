// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/image_decoder.hpp"
#include "io/detail/obj_texture_use.hpp"
#include "io/detail/outside.hpp"
#include "io/detail/read_file.hpp"
#include "mir/scene/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace mir::detail {

/// Reads the images that the materials of one OBJ file name, each once.
class ObjTextures {
 public:
    ObjTextures(std::filesystem::path folder, FileBudget& budget, const Limits& limits,
                Scene& scene, SceneReport& report)
        : folder_(std::move(folder)),
          budget_(budget),
          scene_(scene),
          report_(report),
          allow_outside_(limits.allow_outside),
          decoder_(limits, report) {}

    /// Images are looked for in the folder of this library from now on.
    void begin_library(const std::filesystem::path& library) { library_ = library.parent_path(); }

    /// The texture of a use. None, and its image counted once, when it cannot be had.
    /// @throws Error(invalid_input) when the image is broken; Error(limit_exceeded) before it is
    /// decoded.
    [[nodiscard]] Texture find(const ObjTextureUse& use);

    /// Gives `color` the alpha of an image, white where `color` is none. False when it has no holes
    /// then, counted when they cannot be had.
    [[nodiscard]] bool cut(Texture& color, const ObjTextureUse& use);

 private:
    using Index = std::optional<std::uint32_t>;

    [[nodiscard]] std::filesystem::path path_of(const ObjTextureUse& use) const {
        return (library_ / use.file).lexically_normal();
    }
    [[nodiscard]] std::optional<TextureImage> read(const ObjTextureUse& use);
    [[nodiscard]] Index image(const ObjTextureUse& use);
    Index add(TextureImage image) {
        scene_.images.push_back(std::move(image));
        return static_cast<std::uint32_t>(scene_.images.size() - 1);
    }

    std::filesystem::path folder_;   ///< of the OBJ file
    std::filesystem::path library_;  ///< folder of the library below it
    FileBudget& budget_;
    Scene& scene_;
    SceneReport& report_;
    bool allow_outside_;
    ImageDecoder decoder_;
    std::map<std::filesystem::path, Index> indices_;
};

inline std::optional<TextureImage> ObjTextures::read(const ObjTextureUse& use) {
    const std::filesystem::path inside = path_of(use);
    const auto count = [&](const char* why) {
        ++report_.ignored["image " + in_quotes(use.file) + " (" + why + ")"];
        return std::nullopt;
    };
    if (!allow_outside_ && (inside.is_absolute() || leads_outside(folder_, inside)))
        return count("outside of the folder of the OBJ file");
    std::error_code failure;
    if (!std::filesystem::is_regular_file(folder_ / inside, failure)) return count("not found");
    return decoder_.decode(read_whole_file(folder_ / inside, budget_), inside.generic_string(),
                           use.place + ", image " + in_quotes(use.file));
}

inline ObjTextures::Index ObjTextures::image(const ObjTextureUse& use) {
    const auto [at, is_new] = indices_.try_emplace(path_of(use));
    if (!is_new) return at->second;
    std::optional<TextureImage> image = read(use);
    return at->second = image ? add(std::move(*image)) : Index();
}

/// Meshes count v from the top, MTL from the bottom. Its 1 - (s (1 - v) + o) is s v + 1 - s - o.
inline Texture texture_laid(const ObjTextureUse& use, std::uint32_t image) {
    Texture to;
    to.image = image;
    to.wrap_u = to.wrap_v = use.clamp ? Wrap::clamp : Wrap::repeat;
    to.u_axis = {use.scale.x, 0.0f};
    to.v_axis = {0.0f, use.scale.y};
    to.offset = {use.offset.x, 1.0f - use.scale.y - use.offset.y};
    return to;
}

inline Texture ObjTextures::find(const ObjTextureUse& use) {
    const Index at = image(use);
    return at ? texture_laid(use, *at) : Texture{};
}

inline bool has_holes(const TextureImage& image) {
    return std::any_of(image.texels.begin(), image.texels.end(),
                       [](std::uint32_t texel) { return texel >> 24 != 0xff; });
}

/// 8 bits of the channel that -imfchan names. Without one alpha where the image has any, else how
/// bright it is.
inline std::uint32_t mask_value(std::uint32_t texel, char channel, bool has_alpha) {
    const auto byte = [&](std::uint32_t k) { return texel >> 8 * k & 0xff; };
    if (channel == 'r') return byte(0);
    if (channel == 'g') return byte(1);
    if (channel == 'b') return byte(2);
    if (channel == 'm' || (channel != 'l' && has_alpha)) return byte(3);
    return (2126 * byte(0) + 7152 * byte(1) + 722 * byte(2) + 5000) / 10000;
}

inline bool ObjTextures::cut(Texture& color, const ObjTextureUse& use) {
    const bool plain = use.channel == '\0' || use.channel == 'm';
    const auto known = indices_.find(path_of(use));
    const bool same_image =
        color.is_set() && known != indices_.end() && known->second == color.image;
    const auto count = [&](const char* why) {
        ++report_.ignored[std::string("map_d ") + why];
        return false;
    };
    const Texture laid = texture_laid(use, color.image);
    if (color.is_set() && (laid.u_axis != color.u_axis || laid.v_axis != color.v_axis ||
                           laid.offset != color.offset || laid.wrap_u != color.wrap_u))
        return count("with other options than map_Kd");
    if (same_image && plain) return has_holes(scene_.images[color.image]);
    const std::optional<TextureImage> mask = read(use);
    if (!mask) return false;
    TextureImage cut = color.is_set() ? scene_.images[color.image] : *mask;
    if (cut.width != mask->width || cut.height != mask->height)
        return count("of another size than map_Kd");
    decoder_.take(cut.texels.size());
    const bool has_alpha = has_holes(*mask);
    for (std::size_t i = 0; i < cut.texels.size(); ++i) {
        const std::uint32_t rgb = color.is_set() ? cut.texels[i] & 0xffffff : 0xffffff;
        cut.texels[i] = rgb | mask_value(mask->texels[i], use.channel, has_alpha) << 24;
    }
    cut.name += " cut by " + use.file;
    const Index at = add(std::move(cut));
    color = texture_laid(use, *at);
    return true;
}

}  // namespace mir::detail
