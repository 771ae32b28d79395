// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/luxel.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/packet_of_light.hpp"

#include <cstdint>

namespace mir {

/// f cos for light from the unit direction `wi`. Black when either side of the surface disagrees.
/// No branches: loops over lanes ask it.
template <Bsdf B>
[[gnu::always_inline]] MIR_HD inline Rgb reflected(const Hit& hit,
                                                   const Surface<typename B::Params>& s, Vec3 wi) {
    const float cosine = glm::dot(wi, s.normal);
    const bool is_front =
        (static_cast<int>(cosine > 0.0f) & static_cast<int>(glm::dot(wi, hit.normal) > 0.0f)) != 0;
    return kept_if(is_front, B::eval(s.bsdf, s.normal, wi, s.wo) * cosine);
}

/// Memory that lights lie in for a visibility to be asked about them.
template <Visibility V>
inline constexpr Space space_of_lights = V::space == Space::device ? Space::device : Space::host;

/// How the luxels of a pixel share one well-spread set of samples.
struct SharedSamples {
    std::uint32_t shares = 1;  ///< luxels of the pixel
    std::uint32_t share = 0;   ///< which of them asks
};

/// Mean light of `samples` > 0 samples at a luxel. `draw(k)` is the k-th one, WordCopyable, and
/// `shade(sample)` its LitPoint, by arithmetic without branches. Samples are added up in packets of
/// sixteen, whether the visibility is asked about packets or about one after the other; then light
/// first, which is up to four times as fast on a GPU (docs/decisions/034).
template <Visibility V, class Draw, class Shade>
MIR_HD Rgb mean_of_samples(Vec3 origin, const V& visibility, std::uint32_t samples,
                           const Draw& draw, const Shade& shade) {
    Rgb sum;
    for (std::uint32_t first = 0; first < samples; first += PointPacket::width) {
        const std::uint32_t rest = samples - first;
        const std::uint32_t count = rest < PointPacket::width ? rest : PointPacket::width;
        if constexpr (PacketVisibility<V>) {
            PacketOfLight<decltype(draw(0u))> packet;
            for (std::uint32_t k = 0; k < count; ++k) packet.set(k, draw(first + k));
            sum += packet.seen_from(origin, visibility, count, shade, best_instruction_set());
        } else {
            Rgb part;
            for (std::uint32_t k = 0; k < count; ++k) {
                const LitPoint p = shade(draw(first + k));
                if (!is_black(p.light) && visibility.visible(p.place, origin)) part += p.light;
            }
            sum += part;
        }
    }
    return sum * (1.0f / static_cast<float>(samples));
}

/// The fraction of a number in [0, 2). glm::fract() asks for its floor, which takes a call where
/// the instruction set has none.
MIR_HD inline float wrapped(float x) { return x >= 1.0f ? x - 1.0f : x; }

/// Point i of the Kronecker sequence of the plastic number in the unit square. It is shifted by
/// `shift`, which lies there. The products wrap around as integers, so that no point loses digits,
/// however late it comes. Source: Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018.
MIR_HD inline Vec2 kronecker_point(Vec2 shift, std::uint32_t i) {
    const std::uint32_t x = i * 3242174889u;  // 2^32 / 1.3247.., the plastic number
    const std::uint32_t y = i * 2447445414u;  // and / its square
    const Vec2 at =
        shift + Vec2(static_cast<float>(x >> 8u), static_cast<float>(y >> 8u)) * 0x1p-24f;
    return {wrapped(at.x), wrapped(at.y)};
}

}  // namespace mir
