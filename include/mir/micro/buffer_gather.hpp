// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/micro/micro_buffer.hpp"
#include "mir/micro/surfel_radiance.hpp"

namespace mir {

/// Light that reaches a luxel from discs, by a MicroBuffer: f L pi summed over its texels, divided
/// by their number. What RayGather finds along the same directions, but for where nodes are met as
/// a whole. Allocates nothing; a kernel body for host and device.
template <Space S, Bsdf B>
struct BufferGather {
    static constexpr Space space = S;

    SurfelTreeView<S> tree;
    const SurfelRadiance* radiance = nullptr;  ///< of nodes
    BufferGatherOptions options;               ///< must have passed check()

    /// Radiance towards the viewer, W m^-2 sr^-1. The place of directions inside their texels is
    /// drawn from `random`.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                        Random random) const {
        Rgb sum;
        if (is_empty(hit) || B::is_black(s.bsdf)) return sum;
        MicroBuffer buffer(options.side, s.normal, random.next_2d());
        const float texel = pi / static_cast<float>(buffer.size());
        buffer.draw(tree, hit.position, hit.normal, options.threshold * texel);
        for (std::uint32_t i = 0; i < buffer.size(); ++i) {
            const SurfelHit& found = buffer.hit(i);
            const Vec3 wi = buffer.direction(i);
            if (found.node == SurfelHit::none || !(glm::dot(wi, hit.normal) > 0.0f) ||
                !(glm::dot(wi, s.normal) > 0.0f))
                continue;
            sum += B::eval(s.bsdf, s.normal, wi, s.wo) * radiance[found.node].of(found.front);
        }
        return sum * texel;
    }
};

}  // namespace mir
