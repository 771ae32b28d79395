// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/micro/ray_gather.hpp"

namespace mir {

/// What discs see of each other: for both sides of every disc the nodes that rays meet, with
/// density cos / pi, traced once for all bounces from random places of the disc. 8 bytes for each
/// disc and ray.
class SurfelLinks {
 public:
    /// Traces `options.rays` rays from each side that is not black, by `rays` (TreeRays,
    /// TriangleRays); `seed` gives their directions. `ray_offset` is WorldGeometry::ray_offset(),
    /// metres. The same for any number of threads.
    /// @throws Error(invalid_argument) on options out of range, or directions that are not
    ///     GatherDirections::cosine; Error(limit_exceeded) by Limits::surfel_link_bytes.
    template <class Rays, Executor E>
    SurfelLinks(const SurfelTree& tree, const Rays& rays, const GatherOptions& options,
                float ray_offset, std::uint64_t seed, const Limits& limits, E& executor);

    /// Radiance that a side reflects of the light that nodes send out, W m^-2 sr^-1: `number` is
    /// that of light_surfels().
    [[nodiscard]] Rgb operator()(const SurfelFace& face, std::uint64_t number,
                                 std::span<const SurfelRadiance> radiance) const {
        Rgb sum;
        for (const std::uint32_t link : std::span(links_).subspan(number * rays_, rays_))
            if (link != none) sum += radiance[link >> 1].of((link & 1) != 0);
        return sum * face.surface.bsdf.reflectance * (1.0f / static_cast<float>(rays_));
    }

    /// Memory held, bytes.
    [[nodiscard]] std::size_t bytes() const { return links_.size() * sizeof(std::uint32_t); }

 private:
    static constexpr std::uint32_t none = 0xffffffffu;

    std::vector<std::uint32_t> links_;  ///< twice the node, plus 1 where it shows its front
    std::size_t rays_ = 0;
};

template <class Rays, Executor E>
SurfelLinks::SurfelLinks(const SurfelTree& tree, const Rays& rays, const GatherOptions& options,
                         float ray_offset, std::uint64_t seed, const Limits& limits, E& executor)
    : rays_(options.rays) {
    check(options);
    expects(options.directions == GatherDirections::cosine,
            "the rays from disc to disc are spread by the cosine, so that all weigh the same; ask "
            "for GatherDirections::cosine");
    const std::size_t links = 2 * tree.surfels().size() * rays_;
    check_limit(links * sizeof(std::uint32_t), limits.surfel_link_bytes, "surfel_link_bytes");
    links_.assign(links, none);
    const detail::GatherRays<Rays> gather{rays, options};
    const auto trace = [&](std::uint32_t index, bool front) {
        const SurfelFace face = surfel_face(tree.view(), index, front, ray_offset);
        const std::uint64_t number = 2 * std::uint64_t{tree.nodes()[index].first} + (front ? 0 : 1);
        std::uint32_t* const seen = links_.data() + number * rays_;
        Random places(seed, Stream::surfel_place, number);
        gather.each(
            face.hit, face.surface.normal, {seed, Stream::surfel_gather, number},
            [&](std::uint32_t) { return face.place(places.next_2d()); },
            [&](std::uint32_t k, Vec3, const detail::LocalDirection&, const SurfelHit& met) {
                seen[k] = 2 * met.node + (met.front ? 1u : 0u);
            });
    };
    for_each_reflecting_leaf(tree, executor, [&](std::uint32_t index) {
        trace(index, true);
        trace(index, false);
    });
}

}  // namespace mir
