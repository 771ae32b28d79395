// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/gbuffer.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scene/check_rooms.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/validation/brute_force.hpp"
#include "mir/validation/worlds.hpp"

#include <numbers>

namespace mir::validation {

/// Bounces that a sampler brings to the image, both ends included. 1 is direct light by VPLs on the
/// lamps, 2 has been reflected once before.
struct Bounces {
    std::uint8_t first = 2;  ///< at least 1
    std::uint8_t last = 32;  ///< at least `first`
};

/// A scene whose light is known. The VPLs of bounce b bring radiance(b) to each quarter of the
/// image of its only camera, and to all of it. No two points of what shines or is seen are hidden
/// from each other. Immutable; const use from any thread. Stays where it was made, since samplers
/// refer to its geometry.
class KnownLight {
 public:
    using Luxels = BlockedGBuffer<Lambert::Params>;  ///< what the camera sees

    /// `direct` is radiance(1), `reflectance` the factor of each further bounce. `emitted_power` is
    /// that of the scene's lamps, luminance, W.
    KnownLight(Scene scene, Rgb direct, Rgb reflectance, double emitted_power)
        : world_(std::move(scene)),
          direct_(direct),
          reflectance_(reflectance),
          emitted_power_(emitted_power),
          luxels_({16, 16}, {16, 16}) {
        const CameraRays rays{world_.scene.cameras.front(), {luxels_.extent()}};
        InlineExecutor executor;
        fill_gbuffer<Lambert>(luxels_, 0, rays, BruteForceScene(world_.geometry).ray_caster(),
                              SurfaceTable<Lambert>(world_.scene), executor);
    }
    KnownLight(const KnownLight&) = delete;
    KnownLight& operator=(const KnownLight&) = delete;
    ~KnownLight() = default;

    /// What samplers are made for; all materials are Lambertian.
    [[nodiscard]] const Scene& scene() const { return world_.scene; }
    /// The same as triangles in world space.
    [[nodiscard]] const WorldGeometry& geometry() const { return world_.geometry; }
    /// 16 x 16 that the camera sees, in the middle of their pixels.
    [[nodiscard]] const Luxels& luxels() const { return luxels_; }
    /// Of the scene's lamps, luminance, W.
    [[nodiscard]] double emitted_power() const { return emitted_power_; }

    /// Mean radiance that bounce `b`, at least 1, sends to the camera, W m^-2 sr^-1.
    [[nodiscard]] Rgb radiance(std::uint8_t b) const {
        Rgb sent = direct_;
        for (std::uint8_t i = 1; i < b; ++i) sent = sent * reflectance_;
        return sent;
    }
    /// Of all these bounces together.
    [[nodiscard]] Rgb radiance(Bounces bounces) const {
        Rgb sum;
        for (std::uint32_t b = bounces.first; b <= bounces.last; ++b)
            sum += radiance(static_cast<std::uint8_t>(b));
        return sum;
    }

 private:
    World world_;
    Rgb direct_;
    Rgb reflectance_;
    double emitted_power_;
    Luxels luxels_;
};

/// The furnace: a closed box of 2 m, seen from its centre. Its coloured walls reflect rho and emit
/// L, so bounce b has the radiance rho^b L everywhere.
inline KnownLight known_furnace() {
    const Rgb reflectance{0.6f, 0.5f, 0.4f};
    const Rgb emission{0.25f, 0.5f, 1.0f};
    Scene scene = builtin::furnace_box();
    scene.materials.front().base_color = reflectance;
    scene.materials.front().emission = emission;
    constexpr double area = 24.0;
    return {std::move(scene), reflectance * emission, reflectance,
            std::numbers::pi * area * static_cast<double>(luminance(emission))};
}

/// A square lamp of radiance 1, 1 m above a white square. Seen from above, direct light has the
/// mean radiance of the form factor, in each quarter by symmetry, and there is no other. Both have
/// an edge of 1 m. For samplers that bring direct light. Source of the form factor: Howell, "A
/// catalog of radiation heat transfer configuration factors", C-11.
inline KnownLight known_squares() {
    constexpr float form_factor = 0.199824896f;
    constexpr float height = 0.9f;  // below the lamp
    Scene scene = builtin::parallel_squares();
    scene.cameras = {
        Camera::look_at({0, height, 0}, {0, 0, 0}, {0, 0, -1}, 2.0f * std::atan(0.5f / height))};
    return {std::move(scene), {form_factor, form_factor, form_factor}, {}, std::numbers::pi};
}

}  // namespace mir::validation
