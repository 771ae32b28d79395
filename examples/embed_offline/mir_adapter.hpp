// SPDX-License-Identifier: MIT
//
// All that mir needs to be told about the renderer: three small types.
#pragma once

#include "spectral_renderer.hpp"

#include <mir/concepts/shading.hpp>
#include <mir/concepts/vpl_set.hpp>
#include <mir/data/gbuffer.hpp>
#include <mir/shading/vpl_shading.hpp>

namespace offline {

/// What the G-buffer holds of a surface.
struct Reflection {
    Spectrum reflectance;
    float lobe;
};

// region: lights
/// mir adds up three numbers that have nothing to do with one another. That they are red, green and
/// blue is a habit: here they are the wavelengths `first` to `first` + 2, for lights and surfaces
/// alike.
struct SpectralLights {
    static constexpr mir::Space space = mir::Space::host;

    const Light* lights;
    std::uint32_t count;
    std::uint32_t first;

    [[nodiscard]] std::uint32_t size() const { return count; }
    [[nodiscard]] mir::Vpl operator[](mir::VplIndex j) const {
        const Light& l = lights[j];
        const float* i = l.intensity.data() + first;
        return {l.position, l.normal, {i[0], i[1], i[2]}};
    }
};
static_assert(mir::VplSet<SpectralLights>);
// endregion: lights

// region: shading
/// Radiance of three wavelengths that an unoccluded light adds, W m^-2 sr^-1 nm^-1.
struct SpectralShading {
    using Surface = mir::Surface<Reflection>;

    std::uint32_t first;

    mir::Rgb operator()(const mir::Hit& hit, const Surface& s, const mir::Vpl& light) const {
        const mir::Vec3 d = light.position - hit.position;
        const float inverse = 1.0f / std::sqrt(mir::length_squared(d));
        const mir::Vec3 wi = d * inverse;
        const float g = mir::geometry_term(wi, inverse, s.normal, light.normal);
        const float lobe =
            lobe_factor(s.bsdf.lobe, glm::dot(wi, s.normal), glm::dot(s.wo, s.normal));
        const float* r = s.bsdf.reflectance.data() + first;
        return mir::Rgb{r[0], r[1], r[2]} * light.intensity * (g * lobe * mir::inv_pi);
    }
};
static_assert(mir::Shading<SpectralShading>);
// endregion: shading

}  // namespace offline
