// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/core/space.hpp"
#include "mir/scene/texture.hpp"
#include "mir/scene/texture_image.hpp"

namespace mir {

/// What kernels read of a TextureImage.
struct TexelView {
    const std::uint32_t* texels = nullptr;  ///< as in TextureImage
    std::uint32_t width = 0;                ///< columns
    std::uint32_t height = 0;               ///< rows
};

/// What kernels read of a scene's images. Lookups with the same bits on host and device. A view;
/// thread-safe. Without mip maps: one lookup is a mean of the four texels around a point.
template <Space S>
struct TextureView {
    static constexpr Space space = S;  ///< where the arrays lie

    const TexelView* images = nullptr;  ///< by Texture::image
    const float* values = nullptr;      ///< texel_values()

    /// Colour and alpha of a texture at coordinates of a mesh, 0..1.
    /// @pre texture.is_set() and its image has texels.
    [[nodiscard]] MIR_HD Vec4 look_up(const Texture& texture, Vec2 uv,
                                      TexelEncoding encoding) const {
        const TexelView& image = images[texture.image];
        const Vec2 at = texture.place(uv);
        const float x = wrapped(at.x, texture.wrap_u) * static_cast<float>(image.width);
        const float y = wrapped(at.y, texture.wrap_v) * static_cast<float>(image.height);
        if (texture.nearest)
            return texel(image, texture, static_cast<int>(x), static_cast<int>(y), encoding);
        const float left = floorf(x - 0.5f);
        const float top = floorf(y - 0.5f);
        const float u = x - 0.5f - left;
        const float v = y - 0.5f - top;
        const int i = static_cast<int>(left);
        const int j = static_cast<int>(top);
        const Vec4 upper = (1.0f - u) * texel(image, texture, i, j, encoding) +
                           u * texel(image, texture, i + 1, j, encoding);
        const Vec4 lower = (1.0f - u) * texel(image, texture, i, j + 1, encoding) +
                           u * texel(image, texture, i + 1, j + 1, encoding);
        return (1.0f - v) * upper + v * lower;
    }

    /// The colour of look_up() alone.
    [[nodiscard]] MIR_HD Rgb color(const Texture& texture, Vec2 uv, TexelEncoding encoding) const {
        const Vec4 c = look_up(texture, uv, encoding);
        return {c.x, c.y, c.z};
    }

 private:
    /// A coordinate in [0, 1]. 0 when it is no number or too large to have a fraction.
    [[nodiscard]] MIR_HD static float wrapped(float u, Wrap wrap) {
        float t = u;
        if (wrap == Wrap::repeat) t = u - floorf(u);
        if (wrap == Wrap::mirror) {
            t = u - 2.0f * floorf(0.5f * u);
            t = t > 1.0f ? 2.0f - t : t;
        }
        return smaller(larger(t, 0.0f), 1.0f);
    }

    /// Index of a texel, at most one beyond an end.
    [[nodiscard]] MIR_HD static std::uint32_t inside(int i, std::uint32_t size, Wrap wrap) {
        const int n = static_cast<int>(size);
        if (wrap == Wrap::repeat) return static_cast<std::uint32_t>(i < 0 ? n - 1 : i >= n ? 0 : i);
        // A mirror shows the texel at the end once more, as a clamped image does.
        return static_cast<std::uint32_t>(i < 0 ? 0 : i >= n ? n - 1 : i);
    }

    [[nodiscard]] MIR_HD Vec4 texel(const TexelView& image, const Texture& texture, int i, int j,
                                    TexelEncoding encoding) const {
        const std::uint32_t x = inside(i, image.width, texture.wrap_u);
        const std::uint32_t y = inside(j, image.height, texture.wrap_v);
        const std::uint32_t code = image.texels[std::size_t{y} * image.width + x];
        const float* colors = values + (encoding == TexelEncoding::srgb ? 256 : 0);
        return {colors[code & 0xff], colors[code >> 8 & 0xff], colors[code >> 16 & 0xff],
                values[code >> 24]};
    }
};

}  // namespace mir
