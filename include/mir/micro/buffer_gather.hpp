// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/core/random.hpp"
#include "mir/data/luxel.hpp"
#include "mir/micro/cosine_texels.hpp"
#include "mir/micro/lobe_texels.hpp"
#include "mir/micro/micro_buffer.hpp"
#include "mir/micro/surfel_radiance.hpp"

#include <type_traits>

namespace mir {

/// Light that reaches a luxel from discs, by micro-buffers of up to `Side` texels a side: the mean
/// of f L cos / p over the texels of a buffer of CosineTexels; where BufferWarp::importance is
/// asked for and the surface has a lobe, over those of a buffer of LobeTexels too, by the balance
/// heuristic. Made by 32 lanes together; allocates nothing; a kernel body for host and device, the
/// same bits.
template <Space S, Bsdf B, std::uint32_t Side = BufferGatherOptions::largest_side>
struct BufferGather {
    static constexpr Space space = S;  ///< memory that the tree lies in
    /// What a group works in, undefined before and after.
    using Workspace = MicroBufferSpace<Side>;

    SurfelTreeView<S> tree;                    ///< what is seen
    const SurfelRadiance* radiance = nullptr;  ///< of nodes
    BufferGatherOptions options;               ///< must have passed check(); at most `Side` texels

    /// Radiance towards the viewer, W m^-2 sr^-1, the same for all lanes. The places of directions
    /// inside their texels are drawn from `random`.
    [[nodiscard]] MIR_HD Rgb operator()(const LaneGroup& group, const Hit& hit,
                                        const Surface<typename B::Params>& s, Random random,
                                        Workspace& work) const {
        if (is_empty(hit) || B::is_black(s.bsdf)) return {};
        const Luxel at{hit, s};
        const CosineTexels even(s.normal);
        const Vec2 jitter = random.next_2d();
        const ReflectionLobe lobe = options.warp == BufferWarp::importance
                                        ? reflection_lobe<B>(s.bsdf, s.normal, s.wo)
                                        : ReflectionLobe{};
        if (!(lobe.sharpness > 0.0f))
            return light(group, work, even, jitter, at, [](Vec3) { return pi; });
        const LobeTexels sharp(lobe);
        const auto balance = [&](Vec3 wi) {
            return larger(0.0f, glm::dot(wi, s.normal)) / (even.density(wi) + sharp.density(wi));
        };
        const Rgb sum = light(group, work, even, jitter, at, balance);
        return sum + light(group, work, sharp, random.next_2d(), at, balance);
    }

    /// The same by one thread of the host.
    [[nodiscard]] Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                 Random random) const {
        Workspace work;
        return (*this)(LaneGroup{}, hit, s, random, work);
    }

 private:
    struct Luxel {
        const Hit& hit;
        const Surface<typename B::Params>& surface;
    };

    /// Mean of f L weight(wi) over the texels of a buffer.
    template <class Texels, class Weight>
    [[nodiscard]] MIR_HD Rgb light(const LaneGroup& group, Workspace& work, const Texels& texels,
                                   Vec2 jitter, const Luxel& at, const Weight& weight) const {
        MicroBuffer<Side, Texels> buffer(group, work, texels, options.side, jitter);
        buffer.draw(tree, at.hit.position, at.hit.normal, options.threshold);
        LaneGroup::PerLane<float> red;
        LaneGroup::PerLane<float> green;
        LaneGroup::PerLane<float> blue;
        group.each([&](std::uint32_t lane) {
            Rgb sum;
            for (std::uint32_t i = lane; i < buffer.size(); i += LaneGroup::width)
                sum += from_texel(buffer.node(i), buffer.direction(i), at) *
                       weight(buffer.direction(i));
            red[lane] = sum.r;
            green[lane] = sum.g;
            blue[lane] = sum.b;
        });
        const auto add = [](float a, float b) { return a + b; };
        const float share = 1.0f / static_cast<float>(buffer.size());
        return Rgb{group.combined(red, add), group.combined(green, add),
                   group.combined(blue, add)} *
               share;
    }

    /// f L of what is seen along a direction.
    [[nodiscard]] MIR_HD Rgb from_texel(std::uint32_t node, Vec3 wi, const Luxel& at) const {
        const auto& s = at.surface;
        if (node == SurfelHit::none || !(glm::dot(wi, at.hit.normal) > 0.0f) ||
            !(glm::dot(wi, s.normal) > 0.0f))
            return {};
        const bool front = glm::dot(tree.nodes[node].axis, wi) < 0.0f;
        return B::eval(s.bsdf, s.normal, wi, s.wo) * radiance[node].of(front);
    }
};

/// Calls f with the least `Side`, as a std::integral_constant, that has room for buffers of `side`
/// texels: small ones leave a GPU room for more groups.
template <class F>
decltype(auto) with_buffer_side(std::uint32_t side, const F& f) {
    if (side <= 8) return f(std::integral_constant<std::uint32_t, 8>{});
    if (side <= 16) return f(std::integral_constant<std::uint32_t, 16>{});
    return f(std::integral_constant<std::uint32_t, BufferGatherOptions::largest_side>{});
}

}  // namespace mir
