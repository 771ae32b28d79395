// SPDX-License-Identifier: MIT
//
// The renderer that was there before: it knows Embree and nothing of mir. Six wavelengths,
// reflection of its own, light paths of its own.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#if MIR_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace offline {

inline constexpr float pi = 3.14159265358979f;

/// Values at 420, 470, 520, 570, 620 and 670 nm.
using Spectrum = std::array<float, 6>;
inline constexpr std::array<float, 6> wavelengths{420, 470, 520, 570, 620, 670};  ///< nm

/// Reflection with a lobe that changes sign: f = reflectance / pi (1 + lobe (cos_i - 2/3)(cos_o -
/// 2/3)). The lobe adds nothing to the albedo, for the mean cosine of diffuse light is 2/3: every
/// direction reflects `reflectance`, so that furnaces have a closed form. `lobe` in -2.25 .. 4.5.
struct Material {
    Spectrum reflectance{};  ///< 0..1
    float lobe = 0.0f;
};

/// The factor of `reflectance` / pi.
inline float lobe_factor(float lobe, float cos_i, float cos_o) {
    constexpr float mean = 2.0f / 3.0f;
    return 1.0f + lobe * (cos_i - mean) * (cos_o - mean);
}

/// Parallelogram with corners p, p + a, p + a + b, p + b that shines to where a x b points.
struct Quad {
    glm::vec3 p{0};
    glm::vec3 a{0};
    glm::vec3 b{0};
    Material material;
    Spectrum radiance{};  ///< emitted, W m^-2 sr^-1 nm^-1
};

/// A point on a quad and the unit normal on the side it was seen from.
struct Point {
    glm::vec3 position{0};
    glm::vec3 normal{0};
    const Quad* quad = nullptr;
    bool front = true;
};

/// Something that reflects light, or sends it out, into the hemisphere of its normal.
struct Light {
    glm::vec3 position{0};
    glm::vec3 normal{0};
    Spectrum intensity{};  ///< along the normal, W sr^-1 nm^-1
};

/// Quads and their Embree scene, committed once and for all.
class World {
 public:
    explicit World(std::vector<Quad> quads);

    [[nodiscard]] RTCScene scene() const { return scene_.get(); }
    [[nodiscard]] const std::vector<Quad>& quads() const { return quads_; }
    /// True when the ray meets something, which is written to `out`.
    bool closest(glm::vec3 origin, glm::vec3 direction, Point& out) const;

 private:
    struct Release {
        void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
        void operator()(RTCScene s) const { rtcReleaseScene(s); }
    };

    std::vector<Quad> quads_;
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> scene_;
};

/// Distance by which points are lifted off surfaces, metres.
inline constexpr float offset = 1e-4f;

/// Where `paths` light paths leave lamps and meet surfaces: what an instant radiosity renderer
/// lights its picture with, in all wavelengths at once.
std::vector<Light> trace_lights(const World& world, std::uint32_t paths, std::uint32_t seed);

}  // namespace offline
