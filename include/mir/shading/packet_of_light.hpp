// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/core/lanes.hpp"
#include "mir/core/math.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/soa.hpp"

#include <bit>
#include <cstdint>

namespace mir {

/// A point that light comes from, and what it brings to a luxel.
struct LitPoint {
    Vec3 place{0};  ///< metres; the other end of its shadow ray
    Rgb light;      ///< if nothing is in its way, W m^-2 sr^-1
};

/// Up to sixteen samples of light and what they bring to a luxel. A structure of arrays. On the
/// host; not shared by threads.
template <WordCopyable Sample>
class PacketOfLight {
 public:
    static constexpr std::uint32_t width = PointPacket::width;  ///< samples

    /// Sample `k` < width.
    void set(std::uint32_t k, const Sample& sample) {
        SoaView<Sample>{words_, width}.store(k, sample);
    }

    /// Sum of the samples among the first `count` that `origin` sees, W m^-2 sr^-1. In their order;
    /// `count` <= width. `shade(sample)` is a LitPoint, by arithmetic without branches, which
    /// `instructions` do for all samples at once; the sum does not depend on them.
    template <PacketVisibility V, class Shade>
    [[nodiscard]] Rgb seen_from(Vec3 origin, const V& visibility, std::uint32_t count,
                                const Shade& shade, InstructionSet instructions) {
        std::uint32_t seen = 0;
        run_with(instructions, [&](auto set) { seen = shade_all<set.value>(shade); });
        seen &= (1u << count) - 1u;
        if (seen != 0) seen = visibility.visible_packet(origin, points_, seen);
        Rgb sum;
        for (; seen != 0; seen &= seen - 1) {
            const auto k = static_cast<std::uint32_t>(std::countr_zero(seen));
            sum += {light_.r[k], light_.g[k], light_.b[k]};
        }
        return sum;
    }

 private:
    struct alignas(64) Light {
        float r[width];
        float g[width];
        float b[width];
    };

    /// All samples, set or not. Bits of those that bring any light.
    template <InstructionSet Set, class Shade>
    [[nodiscard]] std::uint32_t shade_all(const Shade& shade) {
        return shade_all<Set>(SoaView<const Sample>{words_, width}, shade, points_, light_);
    }
    /// Copies and promises, without which compilers take the samples one by one.
    template <InstructionSet Set, class Shade>
    [[nodiscard]] static std::uint32_t shade_all(SoaView<const Sample> samples, Shade shade,
                                                 PointPacket& __restrict points,
                                                 Light& __restrict light) {
        detail::LaneTruths lit;
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
        for (std::uint32_t k = 0; k < width; ++k) {
            const LitPoint p = shade(samples.load(k));
            points.x[k] = p.place.x;
            points.y[k] = p.place.y;
            points.z[k] = p.place.z;
            light.r[k] = p.light.r;
            light.g[k] = p.light.g;
            light.b[k] = p.light.b;
            lit.at[k] = is_black(p.light) ? 0 : -1;
        }
        return detail::bits_of<Set>(lit);
    }

    alignas(64) std::uint32_t words_[SoaView<Sample>::words * width] = {};
    PointPacket points_;
    Light light_;
};

}  // namespace mir
