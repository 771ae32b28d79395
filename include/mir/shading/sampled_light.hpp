// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/data/luxel.hpp"
#include "mir/scene/light_table.hpp"

namespace mir {

/// f cos for light from the unit direction `wi`; black when either side of the surface disagrees.
template <Bsdf B>
MIR_HD Rgb reflected(const Hit& hit, const Surface<typename B::Params>& s, Vec3 wi) {
    const float cosine = glm::dot(wi, s.normal);
    if (cosine <= 0.0f || glm::dot(wi, hit.normal) <= 0.0f) return {};
    return B::eval(s.bsdf, s.normal, wi, s.wo) * cosine;
}

/// Memory that lights lie in for a visibility to be asked about them.
template <Visibility V>
inline constexpr Space space_of_lights = V::space == Space::device ? Space::device : Space::host;

/// How the luxels of a pixel share one well-spread set of samples.
struct SharedSamples {
    std::uint32_t shares = 1;  ///< luxels of the pixel
    std::uint32_t share = 0;   ///< which of them asks
};

/// Light that up to a packet of points would bring to a luxel. A small value; not shared by
/// threads.
struct PacketOfLight {
    PointPacket points{};           ///< where light comes from, metres; shadow rays end there
    Rgb light[PointPacket::width];  ///< if nothing is in its way, W m^-2 sr^-1; read where active
    std::uint32_t active = 0;       ///< bits of the points that bring any

    /// Sets point `k`, which may bring nothing.
    MIR_HD void set(std::uint32_t k, Vec3 target, Rgb from_target) {
        light[k] = from_target;
        if (is_black(from_target)) return;
        points.x[k] = target.x;
        points.y[k] = target.y;
        points.z[k] = target.z;
        active |= 1u << k;
    }

    /// Sum of what the points bring that `origin` sees.
    template <Visibility V>
    [[nodiscard]] MIR_HD Rgb seen_from(Vec3 origin, const V& visibility) const {
        std::uint32_t seen = active;
        if constexpr (PacketVisibility<V>) {
            if (active != 0) seen = visibility.visible_packet(origin, points, active);
        } else {
            for (std::uint32_t k = 0; k < PointPacket::width; ++k)
                if ((active >> k & 1u) != 0 &&
                    !visibility.visible(origin, {points.x[k], points.y[k], points.z[k]}))
                    seen &= ~(1u << k);
        }
        Rgb sum;
        for (std::uint32_t k = 0; k < PointPacket::width; ++k)
            if ((seen >> k & 1u) != 0) sum += light[k];
        return sum;
    }
};

/// Mean light of `samples` points at a luxel, by packets: `set_sample(k, packet, place)` sets point
/// `place` of the packet to sample k.
template <Visibility V, class SetSample>
MIR_HD Rgb mean_of_samples(Vec3 origin, const V& visibility, std::uint32_t samples,
                           const SetSample& set_sample) {
    Rgb sum;
    for (std::uint32_t first = 0; first < samples; first += PointPacket::width) {
        PacketOfLight packet;
        const std::uint32_t rest = samples - first;
        const std::uint32_t count = rest < PointPacket::width ? rest : PointPacket::width;
        for (std::uint32_t k = 0; k < count; ++k) set_sample(first + k, packet, k);
        sum += packet.seen_from(origin, visibility);
    }
    return sum * (1.0f / static_cast<float>(samples));
}

/// Place in the unit square of the i-th point of the Kronecker sequence of the plastic number,
/// shifted by `shift`. The products wrap around as integers, so that no point loses digits, however
/// late it comes. Source: Roberts, "The unreasonable effectiveness of quasirandom sequences",
/// 2018.
MIR_HD inline Vec2 kronecker_point(Vec2 shift, std::uint32_t i) {
    const std::uint32_t x = i * 3242174889u;  // 2^32 / 1.3247.., the plastic number
    const std::uint32_t y = i * 2447445414u;  // and / its square
    return glm::fract(shift +
                      Vec2(static_cast<float>(x >> 8u), static_cast<float>(y >> 8u)) * 0x1p-24f);
}

}  // namespace mir
