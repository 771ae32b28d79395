// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/environment.hpp"
#include "mir/scene/environment_view.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace mir {

/// An Environment ready to be looked up and sampled. Owns what it needs. Immutable; const use from
/// any thread.
class EnvironmentTable {
 public:
    /// None: black, never sampled.
    EnvironmentTable() = default;

    /// @throws Error(invalid_input) when the image has no texels, or radiance, scale or rotation is
    /// negative (except for the rotation) or not finite, or the light of all directions together is
    /// no float.
    explicit EnvironmentTable(const Environment& environment);

    /// True when no light comes from it: there is none, or it is black.
    [[nodiscard]] bool empty() const { return by_luminance_.empty(); }
    /// What kernels on the host read; valid until the table is changed or ends.
    [[nodiscard]] EnvironmentView<Space::host> view() const {
        return {texels_.data(), extent_.width, extent_.height,
                turns_,         light_group_,  by_luminance_.view()};
    }
    /// The arrays of view().
    [[nodiscard]] std::span<const Rgb> texels() const { return texels_; }
    /// Weights of the texels: luminance times solid angle, W m^-2.
    [[nodiscard]] const DiscreteDistribution2d& by_luminance() const { return by_luminance_; }

 private:
    static void check(const Environment& environment);
    void keep_texels(const Environment& environment);

    Extent extent_;
    float turns_ = 0.0f;
    std::uint16_t light_group_ = 0;
    std::vector<Rgb> texels_;
    DiscreteDistribution2d by_luminance_;
};

namespace detail {

/// Solid angle of a texel in row `y` of an equirectangular image, sr.
inline double texel_solid_angle(Extent image, std::uint32_t y) {
    const double step = std::numbers::pi / image.height;
    // cos a - cos b of the edges, without cancellation.
    const double heights = 2.0 * std::sin((y + 0.5) * step) * std::sin(0.5 * step);
    return heights * 2.0 * std::numbers::pi / image.width;
}

}  // namespace detail

inline EnvironmentTable::EnvironmentTable(const Environment& environment)
    : extent_(environment.radiance.extent()), light_group_(environment.light_group) {
    check(environment);
    const double turns = static_cast<double>(environment.rotation) / 360.0;
    turns_ = static_cast<float>(turns - std::floor(turns));
    keep_texels(environment);
    std::vector<float> weights(texels_.size());
    double total = 0.0;
    for (std::uint32_t y = 0; y < extent_.height; ++y) {
        const double solid_angle = detail::texel_solid_angle(extent_, y);
        for (std::size_t i = std::size_t{y} * extent_.width, x = 0; x < extent_.width; ++x, ++i) {
            weights[i] =
                static_cast<float>(static_cast<double>(luminance(texels_[i])) * solid_angle);
            total += static_cast<double>(weights[i]);
        }
    }
    if (!is_finite(total) || !(total < 1e37))
        throw Error(ErrorCode::invalid_input,
                    "environment " + detail::in_quotes(environment.name) +
                        " is too bright to be summed up over all directions; lower its scale");
    by_luminance_ = DiscreteDistribution2d(weights, extent_.width);
}

inline void EnvironmentTable::check(const Environment& e) {
    const auto refuse = [&](const std::string& what) {
        throw Error(ErrorCode::invalid_input,
                    "environment " + detail::in_quotes(e.name) + " " + what);
    };
    if (e.radiance.pixels().empty()) refuse("has no texels (it shows no direction); give an image");
    if (!(e.scale >= 0.0f) || !std::isfinite(e.scale))
        refuse(
            "has a scale that is negative or not finite (light cannot be either); use 1 for the "
            "image as it is");
    if (!std::isfinite(e.rotation))
        refuse("is turned by an angle that is not finite; give degrees");
}

inline void EnvironmentTable::keep_texels(const Environment& e) {
    const auto pixels = e.radiance.pixels();
    texels_.reserve(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Rgb light = pixels[i] * e.scale;
        if (!is_finite(light) || light.r < 0.0f || light.g < 0.0f || light.b < 0.0f)
            throw Error(ErrorCode::invalid_input, "environment " + detail::in_quotes(e.name) +
                                                      " has negative or infinite light in column " +
                                                      std::to_string(i % extent_.width) + ", row " +
                                                      std::to_string(i / extent_.width) +
                                                      " (it cannot be sampled); repair the image");
        texels_.push_back(light);
    }
}

}  // namespace mir
