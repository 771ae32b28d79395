// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace mir::detail {

/// Puts images, samplers and textures into a glTF model.
class GltfTextureBuilder {
 public:
    explicit GltfTextureBuilder(tinygltf::Model& model) : model_(model) {}

    /// The texels become a PNG in the JSON.
    void add(const TextureImage& from) {
        tinygltf::Image& to = model_.images.emplace_back();
        to.name = from.name;
        to.mimeType = "image/png";
        to.width = static_cast<int>(from.width);
        to.height = static_cast<int>(from.height);
        to.component = 4;
        to.bits = 8;
        to.pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
        to.image.reserve(4 * from.texels.size());
        for (const std::uint32_t texel : from.texels)
            for (std::uint32_t k = 0; k < 4; ++k)
                to.image.push_back(static_cast<unsigned char>(texel >> 8 * k));
    }

    /// Makes a part of material `user` use a texture. `Info` is one of tinygltf's.
    /// @throws Error(invalid_argument) when glTF has no word for how the image lies on the mesh.
    template <class Info>
    void use(const Texture& from, const std::string& user, Info& to) {
        if (!from.is_set()) return;
        to.index = texture_of(from);
        if (from.place({0, 0}) == Vec2(0, 0) && from.u_axis == Vec2(1, 0) &&
            from.v_axis == Vec2(0, 1))
            return;
        const double width = std::hypot(double{from.u_axis.x}, double{from.u_axis.y});
        const double angle = std::atan2(-double{from.u_axis.y}, double{from.u_axis.x});
        const double height =
            double{from.v_axis.x} * std::sin(angle) + double{from.v_axis.y} * std::cos(angle);
        if (std::fabs(double{glm::dot(from.u_axis, from.v_axis)}) >
            1e-5 * width * std::fabs(height))
            throw Error(ErrorCode::invalid_argument,
                        "material '" + user +
                            "': a texture is sheared (glTF can only shift, turn and scale); make "
                            "its axes orthogonal");
        using Value = tinygltf::Value;
        const auto pair = [](double x, double y) {
            return Value(Value::Array{Value(x), Value(y)});
        };
        constexpr const char* name = "KHR_texture_transform";
        to.extensions[name] = Value(Value::Object{{"offset", pair(from.offset.x, from.offset.y)},
                                                  {"rotation", Value(angle)},
                                                  {"scale", pair(width, height)}});
        auto& used = model_.extensionsUsed;
        if (std::find(used.begin(), used.end(), name) == used.end()) used.emplace_back(name);
    }

 private:
    static int wrap_mode(Wrap wrap) {
        if (wrap == Wrap::clamp) return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        return wrap == Wrap::mirror ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                    : TINYGLTF_TEXTURE_WRAP_REPEAT;
    }

    /// The texture of this image and sampler, made when there is none.
    int texture_of(const Texture& from) {
        const auto like = [&](const tinygltf::Texture& t) {
            const tinygltf::Sampler& s = model_.samplers[static_cast<std::size_t>(t.sampler)];
            return t.source == static_cast<int>(from.image) && s.wrapS == wrap_mode(from.wrap_u) &&
                   s.wrapT == wrap_mode(from.wrap_v) &&
                   (s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) == from.nearest;
        };
        auto& all = model_.textures;
        const auto known = std::find_if(all.begin(), all.end(), like);
        if (known != all.end()) return static_cast<int>(known - all.begin());
        tinygltf::Sampler& sampler = model_.samplers.emplace_back();
        sampler.wrapS = wrap_mode(from.wrap_u);
        sampler.wrapT = wrap_mode(from.wrap_v);
        sampler.magFilter =
            from.nearest ? TINYGLTF_TEXTURE_FILTER_NEAREST : TINYGLTF_TEXTURE_FILTER_LINEAR;
        tinygltf::Texture& to = all.emplace_back();
        to.source = static_cast<int>(from.image);
        to.sampler = static_cast<int>(model_.samplers.size() - 1);
        return static_cast<int>(all.size() - 1);
    }

    tinygltf::Model& model_;
};

}  // namespace mir::detail
