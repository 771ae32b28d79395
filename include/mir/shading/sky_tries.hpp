// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/scene/light_table_view.hpp"
#include "mir/shading/sampled_light.hpp"
#include "mir/shading/sky_guide.hpp"

#include <cstdint>

namespace mir {

/// Rays that tell where luxels see the environment. Host and device.
template <Visibility V>
class SkyTries {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the environment lies in

    /// What the views read must outlive it.
    SkyTries(const LightTableView<space>& lights, V visibility)
        : environment_(lights.environment), sphere_(lights.sphere), visibility_(visibility) {}

    /// The cells that luxel `k` of a SkyTried sees: element k of SkyTried::seen. Each is tried at a
    /// random place in it; each set of tries and each k has other numbers of `random`.
    [[nodiscard]] MIR_HD std::uint16_t operator()(const Hit& hit, std::uint32_t k,
                                                  std::uint32_t set, const Random& random) const {
        const std::uint32_t first = (set * SkyTried::side + k) * SkyTried::side;
        constexpr std::uint32_t side = SkyTried::side;
        std::uint32_t seen = 0;
        if constexpr (PacketVisibility<V>) {
            PointPacket ends{};
            for (std::uint32_t c = 0; c < side; ++c) {
                const Vec3 w = direction(k, c, random.block(first + c));
                const Vec3 end = sphere_.outside(hit.position, w);
                ends.x[c] = end.x;
                ends.y[c] = end.y;
                ends.z[c] = end.z;
                if (glm::dot(w, hit.normal) > 0.0f) seen |= 1u << c;
            }
            if (seen != 0) seen = visibility_.visible_packet(hit.position, ends, seen);
        } else {
            for (std::uint32_t c = 0; c < side; ++c) {
                const Vec3 w = direction(k, c, random.block(first + c));
                if (glm::dot(w, hit.normal) > 0.0f &&
                    visibility_.visible(sphere_.outside(hit.position, w), hit.position))
                    seen |= 1u << c;
            }
        }
        return static_cast<std::uint16_t>(seen);
    }

 private:
    [[nodiscard]] MIR_HD Vec3 direction(std::uint32_t k, std::uint32_t c,
                                        const Bits128& bits) const {
        const Vec2 cell(static_cast<float>(c), static_cast<float>(SkyTried::row(k, c)));
        const Vec2 inside(to_unit_float(bits.word[0]), to_unit_float(bits.word[1]));
        return environment_.sample((cell + inside) * (1.0f / SkyTried::side)).direction;
    }

    EnvironmentView<space> environment_;
    BoundingSphere sphere_;
    V visibility_;
};

}  // namespace mir
