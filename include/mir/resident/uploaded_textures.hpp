// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/uploaded_array.hpp"
#include "mir/scene/texture_table.hpp"

#include <vector>

namespace mir {

/// The images of a TextureTable in a backend's memory.
template <Backend B>
class UploadedTextures {
 public:
    /// Starts the copies on `queue`; the table and its scene must live until they are done.
    UploadedTextures(const B& backend, typename B::Queue& queue, const TextureTable& textures)
        : values_(backend, queue, std::span<const float>(texel_values())),
          texels_(upload_texels(backend, queue, textures)),
          places_(places_of(textures)),
          images_(backend, queue, std::span<const TexelView>(places_)) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] TextureView<B::space> view() const { return {images_.data(), values_.data()}; }

 private:
    using Texels = UploadedArray<B, std::uint32_t>;

    static std::vector<Texels> upload_texels(const B& backend, typename B::Queue& queue,
                                             const TextureTable& textures) {
        std::vector<Texels> all;
        for (const TexelView& image : textures.images())
            all.emplace_back(backend, queue,
                             std::span(image.texels, std::size_t{image.width} * image.height));
        return all;
    }
    [[nodiscard]] std::vector<TexelView> places_of(const TextureTable& textures) const {
        std::vector<TexelView> places(textures.images().begin(), textures.images().end());
        for (std::size_t i = 0; i < places.size(); ++i) places[i].texels = texels_[i].data();
        return places;
    }

    UploadedArray<B, float> values_;
    std::vector<Texels> texels_;
    std::vector<TexelView> places_;  ///< stays until its copy is done
    UploadedArray<B, TexelView> images_;
};

}  // namespace mir
