// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/number_text.hpp"
#include "mir/scene/alpha_mask.hpp"
#include "mir/scene/texture_table.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace mir {

/// The mask of a material.
[[nodiscard]] inline AlphaMask alpha_mask_of(const Material& m) {
    return {m.alpha, m.alpha_cutoff, m.textures.base_color};
}

/// True when some material may have holes.
[[nodiscard]] inline bool is_masked(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.is_masked(); });
}

/// The masks of a scene's materials, with the images that they read. Needs the scene no more when
/// it is made. Immutable, and neither copied nor moved, because views point into it; const use from
/// any thread.
class AlphaMaskTable {
 public:
    /// @throws Error(invalid_input) when an alpha lies outside 0..1 or a cutoff is negative or not
    ///         finite; where materials are masked, what TextureTable throws.
    explicit AlphaMaskTable(const Scene& scene) {
        for (const Material& m : scene.materials) check(m);
        if (!is_masked(scene)) return;
        const TextureTable given(scene);
        images_.assign(given.images().begin(), given.images().end());
        texels_.resize(images_.size());
        for (const Material& m : scene.materials) {
            masks_.push_back(alpha_mask_of(m));
            if (m.is_masked() && m.textures.base_color.is_set())
                keep(scene.images, m.textures.base_color.image);
        }
    }
    AlphaMaskTable(const AlphaMaskTable&) = delete;
    AlphaMaskTable& operator=(const AlphaMaskTable&) = delete;
    ~AlphaMaskTable() = default;

    /// True when no material is masked.
    [[nodiscard]] bool empty() const { return masks_.empty(); }
    /// By material; none when no material is masked.
    [[nodiscard]] std::span<const AlphaMask> masks() const { return masks_; }
    /// Of masked materials alone; others must not be looked up.
    [[nodiscard]] TextureView<Space::host> textures() const {
        return {images_.data(), texel_values().data()};
    }

 private:
    static void check(const Material& m) {
        const auto fail = [&](const std::string& what) {
            throw Error(ErrorCode::invalid_input,
                        "material " + detail::in_quotes(m.name) + ": " + what);
        };
        if (!(m.alpha >= 0.0f && m.alpha <= 1.0f))
            fail("its alpha is " + number_text(m.alpha) +
                 " (it is a share of the surface); use a number from 0 to 1");
        if (!(m.alpha_cutoff >= 0.0f) || !std::isfinite(m.alpha_cutoff))
            fail("its alpha cutoff is " + number_text(m.alpha_cutoff) +
                 " (no alpha can be compared with it); use a number from 0, which cuts nothing "
                 "away, to 1");
    }

    void keep(const std::vector<TextureImage>& images, std::uint32_t image) {
        texels_[image] = images[image].texels;
        images_[image].texels = texels_[image].data();
    }

    std::vector<AlphaMask> masks_;
    std::vector<std::vector<std::uint32_t>> texels_;
    std::vector<TexelView> images_;
};

}  // namespace mir
