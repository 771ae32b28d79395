// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/micro/check_gather.hpp"
#include "mir/micro/ray_gather.hpp"

namespace mir {

/// What patches see of each other. For both sides of every patch the nodes that rays meet, with
/// density cos / pi, traced once for all bounces from random places of its discs. 8 bytes for each
/// patch and ray.
class SurfelLinks {
 public:
    /// Traces `options.rays` rays from each side that is not black, by `rays` (TreeRays,
    /// TriangleRays). `seed` gives their directions. `ray_offset` is WorldGeometry::ray_offset(),
    /// metres. The same for any number of threads.
    /// @throws Error(invalid_argument) on options out of range, or directions that are not
    ///     GatherDirections::cosine; Error(limit_exceeded) by Limits::surfel_link_bytes.
    template <class Rays, Executor E>
    SurfelLinks(const SurfelPatches& patches, const Rays& rays, const GatherOptions& options,
                float ray_offset, std::uint64_t seed, const Limits& limits, E& executor);

    /// What light_surfels() asks for, of the light that nodes send out. W m^-2 sr^-1, of the face
    /// of this number.
    [[nodiscard]] Rgb operator()(std::uint64_t number,
                                 std::span<const SurfelRadiance> radiance) const {
        Rgb sum;
        for (const std::uint32_t link : std::span(links_).subspan(number * rays_, rays_))
            if (link != none) sum += radiance[link >> 1].of((link & 1) != 0);
        return sum * (1.0f / static_cast<float>(rays_));
    }

    /// Memory held, bytes.
    [[nodiscard]] std::size_t bytes() const { return links_.size() * sizeof(std::uint32_t); }

 private:
    static constexpr std::uint32_t none = 0xffffffffu;

    std::vector<std::uint32_t> links_;  ///< twice the node, plus 1 where it shows its front
    std::size_t rays_ = 0;
};

template <class Rays, Executor E>
SurfelLinks::SurfelLinks(const SurfelPatches& patches, const Rays& rays,
                         const GatherOptions& options, float ray_offset, std::uint64_t seed,
                         const Limits& limits, E& executor)
    : rays_(options.rays) {
    check(options);
    expects(options.directions == GatherDirections::cosine,
            "the rays from disc to disc are spread by the cosine, so that all weigh the same; ask "
            "for GatherDirections::cosine");
    const std::size_t links = 2 * patches.size() * rays_;
    check_limit(links * sizeof(std::uint32_t), limits.surfel_link_bytes, "surfel_link_bytes");
    links_.assign(links, none);
    const detail::GatherRays<Rays> gather{rays, options};
    const auto trace = [&](const SurfelFace& face, std::uint64_t number) {
        std::uint32_t* const seen = links_.data() + number * rays_;
        Random places(seed, Stream::surfel_place, number);
        const detail::ShiftedPoints directions({seed, Stream::surfel_gather, number});
        for (std::uint32_t k = 0; k < options.rays; ++k) {
            const SurfelHit met = gather.along(face.place(places.next_2d()), directions[k]);
            if (met.node != SurfelHit::none) seen[k] = 2 * met.node + (met.front ? 1u : 0u);
        }
    };
    for_each_reflecting_patch(patches, executor, [&](std::size_t patch) {
        const SurfelTreeView<Space::host> tree = patches.tree().view();
        for (const bool front : {true, false})
            trace({tree, patches.nodes()[patch], front, ray_offset}, 2 * patch + (front ? 0 : 1));
    });
}

}  // namespace mir
