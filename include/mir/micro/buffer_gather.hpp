// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/micro/gather_point.hpp"
#include "mir/micro/micro_buffer.hpp"
#include "mir/micro/surfel_radiance.hpp"

#include <type_traits>

namespace mir {

/// Light that reaches luxels from discs, by micro-buffers of up to `Side` texels a side. The mean
/// of f L cos / p over the texels of a buffer of CosineTexels; where BufferWarp::importance is
/// asked for and the surface has a lobe, over those of a buffer of LobeTexels too, by the balance
/// heuristic. Made by 32 lanes together, for some luxels at once; allocates nothing; a kernel body
/// for host and device, the same bits, which do not depend on the luxels beside one.
template <Space S, Bsdf B, std::uint32_t Side = BufferGatherOptions::largest_side>
struct BufferGather {
    static constexpr Space space = S;  ///< memory that the tree lies in
    /// What a group works in, undefined before and after.
    using Workspace = MicroBufferSpace<Side, has_lobe<B>>;
    /// A luxel, and where its random numbers come from.
    using Point = GatherPoint<Surface<typename B::Params>>;

    SurfelTreeView<S> tree;                    ///< what is seen
    const SurfelRadiance* radiance = nullptr;  ///< of nodes
    BufferGatherOptions options;               ///< must have passed check(); at most `Side` texels

    /// Calls write(k, light) for every k below Workspace::pictures, from all lanes. The radiance
    /// towards the viewer of the luxel point_of(k), a Point, W m^-2 sr^-1. Black where its hit is
    /// empty. Luxels next to each other are faster.
    template <class PointOf, class Write>
    MIR_HD void operator()(const LaneGroup& group, const PointOf& point_of, Workspace& work,
                           const Write& write) const {
        Even even(group, work, work.even, options.side);
        Sharp sharp(group, work, work.sharp, options.side);
        std::uint32_t seen = 0;
        std::uint32_t shiny = 0;
        for (std::uint32_t k = 0; k < Workspace::pictures; ++k) {
            const Point point = point_of(k);
            if (is_empty(point.hit) || B::is_black(point.surface.bsdf)) continue;
            seen |= 1u << k;
            even.place(k, micro_point(point, CosineTexels(point.surface.normal), 0));
            shiny |= lobe(point).sharpness > 0.0f ? 1u << k : 0;
        }
        even.draw(tree, options.threshold);
        add_light(group, even, seen, shiny, point_of, work, Add::first);
        // The same memory, once more.
        for (std::uint32_t k = 0; k < Workspace::pictures; ++k)
            if ((shiny >> k & 1u) != 0) {
                const Point point = point_of(k);
                sharp.place(k, micro_point(point, LobeTexels(lobe(point)), 1));
            }
        sharp.draw(tree, options.threshold);
        add_light(group, sharp, shiny, shiny, point_of, work, Add::second);
        for (std::uint32_t k = 0; k < Workspace::pictures; ++k)
            write(k, (seen >> k & 1u) != 0 ? work.light[k] : Rgb{});
    }

    /// Of one luxel, by one thread of the host.
    [[nodiscard]] Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                 Random random) const {
        Workspace work;
        Rgb light;
        (*this)(
            LaneGroup{},
            [&](std::uint32_t k) {
                return Point{k == 0 ? hit : Hit{}, s, random};
            },
            work, [&](std::uint32_t k, Rgb found) { light = k == 0 ? found : light; });
        return light;
    }

 private:
    using Even = MicroBuffers<Workspace, CosineTexels>;
    using Sharp = MicroBuffers<Workspace, LobeTexels>;
    enum class Add { first, second };

    /// Buffer number `buffer` of a luxel has the pair of random numbers of that number.
    template <class Texels>
    [[nodiscard]] MIR_HD static MicroPoint<Texels> micro_point(const Point& p, const Texels& texels,
                                                               std::uint32_t buffer) {
        Random random = p.random;
        Vec2 jitter = random.next_2d();
        if (buffer == 1) jitter = random.next_2d();
        return {p.hit.position, p.hit.normal, texels, jitter};
    }

    [[nodiscard]] MIR_HD ReflectionLobe lobe(const Point& p) const {
        if (options.warp != BufferWarp::importance) return {};
        return reflection_lobe<B>(p.surface.bsdf, p.surface.normal, p.surface.wo);
    }

    /// Adds what the buffers of `seen` bring to the light of their luxels. By the balance heuristic
    /// where a luxel is one of the `shiny` ones, which have both buffers.
    template <class Buffers, class PointOf>
    MIR_HD void add_light(const LaneGroup& group, const Buffers& buffers, std::uint32_t seen,
                          std::uint32_t shiny, const PointOf& point_of, Workspace& work,
                          Add add) const {
        for (std::uint32_t k = 0; seen >> k != 0; ++k) {
            if ((seen >> k & 1u) == 0) continue;
            const Point point = point_of(k);
            const CosineTexels even(point.surface.normal);
            const LobeTexels sharp(lobe(point));
            const bool has_both = (shiny >> k & 1u) != 0;
            const auto weight = [&](Vec3 wi) {
                if (!has_both) return pi;
                return larger(0.0f, glm::dot(wi, point.surface.normal)) /
                       (even.density(wi) + sharp.density(wi));
            };
            const Rgb found = mean(group, buffers, k, point, weight);
            group.each([&](std::uint32_t lane) {
                if (lane == 0) work.light[k] = add == Add::first ? found : work.light[k] + found;
            });
        }
    }

    /// Mean of f L weight(wi) over the texels of buffer k.
    template <class Buffers, class Weight>
    [[nodiscard]] MIR_HD Rgb mean(const LaneGroup& group, const Buffers& buffers, std::uint32_t k,
                                  const Point& point, const Weight& weight) const {
        LaneGroup::PerLane<float> red;
        LaneGroup::PerLane<float> green;
        LaneGroup::PerLane<float> blue;
        group.each([&](std::uint32_t lane) {
            Rgb sum;
            for (std::uint32_t i = lane; i < buffers.size(); i += LaneGroup::width) {
                const Vec3 wi = buffers.direction(k, i);
                sum += from_texel(buffers.node(k, i), wi, point) * weight(wi);
            }
            red[lane] = sum.r;
            green[lane] = sum.g;
            blue[lane] = sum.b;
        });
        const auto add = [](float a, float b) { return a + b; };
        const float share = 1.0f / static_cast<float>(buffers.size());
        return Rgb{group.combined(red, add), group.combined(green, add),
                   group.combined(blue, add)} *
               share;
    }

    /// f L of what is seen along a direction.
    [[nodiscard]] MIR_HD Rgb from_texel(std::uint32_t node, Vec3 wi, const Point& at) const {
        const auto& s = at.surface;
        if (node == SurfelHit::none || !(glm::dot(wi, at.hit.normal) > 0.0f) ||
            !(glm::dot(wi, s.normal) > 0.0f))
            return {};
        const bool front = glm::dot(tree.nodes[node].axis, wi) < 0.0f;
        return B::eval(s.bsdf, s.normal, wi, s.wo) * radiance[node].of(front);
    }
};

/// Calls f with the least `Side` that has room for buffers of `side` texels. It is a
/// std::integral_constant; small ones leave a GPU room for more groups.
template <class F>
decltype(auto) with_buffer_side(std::uint32_t side, const F& f) {
    if (side <= 8) return f(std::integral_constant<std::uint32_t, 8>{});
    if (side <= 16) return f(std::integral_constant<std::uint32_t, 16>{});
    return f(std::integral_constant<std::uint32_t, BufferGatherOptions::largest_side>{});
}

}  // namespace mir
