// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/luxel_grid.hpp"
#include "mir/shading/direct_samples.hpp"
#include "mir/shading/environment_light.hpp"
#include "mir/shading/scene_light.hpp"

namespace mir {

/// Where the rows of a G-buffer lie in the whole luxel image. Random numbers are keyed by it.
struct LuxelBand {
    std::uint32_t first_row = 0;  ///< of the band, in luxels of the whole image
    LuxelGrid grid;               ///< of the whole image
    std::uint64_t seed = 0;       ///< of the rendering

    /// Random numbers of the pixel of luxel (x, y) of the band. They are the same for all its
    /// luxels.
    [[nodiscard]] MIR_HD Random pixel_numbers(std::uint32_t x, std::uint32_t y) const {
        const std::uint64_t pixel_row = (first_row + y) / grid.per_pixel_y;
        return {seed, Stream::direct_light, pixel_row * grid.pixels.width + x / grid.per_pixel_x};
    }

    /// Numbers of luxel (x, y) of the band alone, for what luxels do not share.
    [[nodiscard]] MIR_HD Random luxel_numbers(std::uint32_t x, std::uint32_t y,
                                              Stream stream) const {
        return {seed, stream, std::uint64_t{first_row + y} * grid.luxels().width + x};
    }

    /// Numbers that all luxels of the image share.
    [[nodiscard]] MIR_HD Random image_numbers() const { return {seed, Stream::distant_vpls, 0}; }

    /// Number of the luxel inside its pixel.
    [[nodiscard]] MIR_HD std::uint32_t cell(std::uint32_t x, std::uint32_t y) const {
        return (first_row + y) % grid.per_pixel_y * grid.per_pixel_x + x % grid.per_pixel_x;
    }
};

/// Direct light of the luxels of a band, host and device.
template <Bsdf B, Visibility V>
class LuxelLight {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the lights lie in

    /// What the views read must outlive it. The band says where the luxels lie.
    LuxelLight(const LightTableView<space>& lights, const GeometryView<space>& geometry,
               V visibility, DirectSamples samples, const LuxelBand& band)
        : emitters_(lights, geometry, visibility, samples.emitters),
          listed_(lights, visibility, part_beside(lights, samples.emitters)),
          environment_(lights, visibility, samples.environment),
          band_(band),
          distant_vpls_(samples.distant_vpls) {}
    /// The lights of the host and their geometry, which must outlive it.
    LuxelLight(const LightTable& lights, V visibility, DirectSamples samples,
               const LuxelBand& band) requires(space == Space::host)
        : LuxelLight(lights.view(), lights.geometry().view(), visibility, samples, band) {}

    /// Radiance towards the viewer of the luxel at (x, y), W m^-2 sr^-1. The luxel is one of the
    /// band and not empty. `sky` is null, or where its block sees the environment.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& surface,
                                        std::uint32_t x, std::uint32_t y,
                                        const SkyGuide* sky = nullptr) const {
        const SharedSamples shared{band_.grid.per_pixel(), band_.cell(x, y)};
        const Random numbers = band_.pixel_numbers(x, y);
        // Numbers behind those of emitters and environment.
        const auto place = [&](std::uint32_t light) {
            return kronecker_point({numbers.at(5 + 2 * light), numbers.at(6 + 2 * light)},
                                   shared.share);
        };
        return emitters_(hit, surface, shared, numbers) + listed_(hit, surface, place) +
               (distant_vpls_ ? environment_.from_vpls(hit, surface, band_.image_numbers())
                              : environment_(hit, surface, shared, numbers, sky));
    }

 private:
    EmitterLight<B, V> emitters_;         ///< light of lamps
    ListedLight<B, V> listed_;            ///< light of what the scene lists
    EnvironmentLight<B, V> environment_;  ///< light from outside the scene
    LuxelBand band_;
    bool distant_vpls_;  ///< DirectSamples::distant_vpls
};

}  // namespace mir
