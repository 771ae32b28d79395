// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_images.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_gltf.h>

#include <cmath>
#include <optional>
#include <string>

namespace mir::detail {

/// Converts uses of textures and reads the images that they need, each once.
class GltfTextures {
 public:
    GltfTextures(const tinygltf::Model& model, GltfImages& images, SceneReport& report)
        : model_(model), images_(images), report_(report) {}

    /// The texture `index`, its extensions, and its set of coordinates. Extensions are those of its
    /// use. No texture, and counted, when its image cannot be had.
    /// @throws Error(invalid_input) on an index or a number that means nothing.
    [[nodiscard]] Texture convert(const std::string& name, int index, int set,
                                  const tinygltf::ExtensionMap& extensions,
                                  const std::string& place, int& wanted_set);

 private:
    void transform(const tinygltf::Value& from, const std::string& place, Texture& to, int& set);
    void sampler(int index, const std::string& place, Texture& to);
    [[nodiscard]] Wrap wrap(int mode, const std::string& place) const;

    const tinygltf::Model& model_;
    GltfImages& images_;
    SceneReport& report_;
};

inline Texture GltfTextures::convert(const std::string& name, int index, int set,
                                     const tinygltf::ExtensionMap& extensions,
                                     const std::string& place, int& wanted_set) {
    const std::string where = place + ", " + name;
    const auto at = checked_index(index, model_.textures.size(), "texture", where);
    const tinygltf::Texture& from = model_.textures[at];
    const std::string texture_place = gltf_place("texture", at, from.name);
    Texture to;
    if (from.sampler >= 0) sampler(from.sampler, texture_place, to);
    for (const auto& [extension, value] : extensions)
        if (extension == "KHR_texture_transform")
            transform(value, where, to, set);
        else
            count_extension(extension, report_);
    if (set < 0) gltf_fail(where, "its set of coordinates is negative; repair texCoord");
    if (from.source < 0) {
        // The image is in an extension, of a format that nothing here decodes.
        ++report_.ignored["texture " + name + " without a PNG or JPEG image"];
        return {};
    }
    const std::optional<std::uint32_t> image = images_.find(from.source, texture_place);
    if (!image) {
        ++report_.ignored["texture " + name + " without a PNG or JPEG image"];
        return {};
    }
    to.image = *image;
    wanted_set = set;
    return to;
}

/// Source: Khronos, KHR_texture_transform. Scaled, then turned counter-clockwise as the image is
/// seen (its v runs downwards), then shifted.
inline void GltfTextures::transform(const tinygltf::Value& from, const std::string& place,
                                    Texture& to, int& set) {
    const auto pair = [&](const char* key, double otherwise) {
        const tinygltf::Value& value = from.Get(key);
        if (!from.Has(key)) return Vec2(static_cast<float>(otherwise));
        if (value.ArrayLen() != 2 || !value.Get(0).IsNumber() || !value.Get(1).IsNumber())
            gltf_fail(place, std::string(key) +
                                 " of KHR_texture_transform is no pair of numbers; "
                                 "repair it");
        return Vec2(checked_float(value.Get(0).GetNumberAsDouble(), key, place),
                    checked_float(value.Get(1).GetNumberAsDouble(), key, place));
    };
    const double angle = checked_float(number_or(from, "rotation", 0.0, place), "rotation", place);
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    const Vec2 scale = pair("scale", 1.0);
    to.u_axis = scale.x * Vec2(c, -s);
    to.v_axis = scale.y * Vec2(s, c);
    to.offset = pair("offset", 0.0);
    if (from.Has("texCoord")) set = index_under(from, "texCoord");
}

inline void GltfTextures::sampler(int index, const std::string& place, Texture& to) {
    const auto at = checked_index(index, model_.samplers.size(), "sampler", place);
    const tinygltf::Sampler& from = model_.samplers[at];
    const std::string sampler_place = gltf_place("sampler", at, from.name);
    to.wrap_u = wrap(from.wrapS, sampler_place);
    to.wrap_v = wrap(from.wrapT, sampler_place);
    to.nearest = from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

inline Wrap GltfTextures::wrap(int mode, const std::string& place) const {
    if (mode == TINYGLTF_TEXTURE_WRAP_REPEAT) return Wrap::repeat;
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Wrap::mirror;
    gltf_fail(place, "wrap mode " + std::to_string(mode) +
                         " is none of glTF 2.0 (33071, 33648, 10497); repair it");
}

}  // namespace mir::detail
