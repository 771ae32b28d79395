// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/scene/scene.hpp"
#include "mir/scene/texture_view.hpp"

#include <span>
#include <string>
#include <vector>

namespace mir {

/// The images of a scene, ready to be looked up. The texels stay in the scene, which must outlive
/// it. Immutable; const use from any thread.
class TextureTable {
 public:
    /// No images.
    TextureTable() = default;
    /// @throws Error(invalid_input) when an image has another number of texels than it says, or a
    ///         material uses one that does not exist.
    explicit TextureTable(const Scene& scene) {
        for (const TextureImage& image : scene.images) {
            if (image.width > 65536 || image.height > 65536 || image.texels.empty() ||
                image.texels.size() != std::size_t{image.width} * image.height)
                throw Error(ErrorCode::invalid_input,
                            "image " + detail::in_quotes(image.name) + " has " +
                                std::to_string(image.texels.size()) + " texels for " +
                                std::to_string(image.width) + " x " + std::to_string(image.height) +
                                " (1 to 65536 each way); give it as many");
            images_.push_back({image.texels.data(), image.width, image.height});
        }
        for (const Material& m : scene.materials)
            m.textures.for_each([&](const Texture& t) {
                if (t.is_set() && t.image >= images_.size())
                    throw Error(ErrorCode::invalid_input,
                                "material " + detail::in_quotes(m.name) + " uses image " +
                                    std::to_string(t.image) + ", but the scene has " +
                                    std::to_string(images_.size()) +
                                    "; add it or correct the index");
            });
    }

    /// What kernels on the host read; valid until the table is moved or ends.
    [[nodiscard]] TextureView<Space::host> view() const {
        return {images_.data(), texel_values().data()};
    }
    /// By Texture::image. Valid as long as view().
    [[nodiscard]] std::span<const TexelView> images() const { return images_; }

 private:
    std::vector<TexelView> images_;
};

}  // namespace mir
