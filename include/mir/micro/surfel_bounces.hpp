// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_links.hpp"

namespace mir {

/// How light is sent on from disc to disc.
struct SurfelBounceOptions {
    std::uint8_t last = 1;   ///< most reflections of the light that discs send out, 1 to 254
    float least = 1e-3f;     ///< a bounce that adds less than this share of the power is the last
    GatherOptions gather;    ///< at each side of a disc; cosine directions alone
    std::uint64_t seed = 0;  ///< of all random numbers
    Limits limits;           ///< surfel_link_bytes counts
};

namespace detail {

/// Luminance of what all discs send out, W.
inline double sent_power(const SurfelTree& tree, std::span<const SurfelRadiance> radiance) {
    if (radiance.empty()) return 0.0;
    const float both = luminance(radiance[0].front) + luminance(radiance[0].back);
    return static_cast<double>(pi) * static_cast<double>(tree.area()[0]) *
           static_cast<double>(both);
}

}  // namespace detail

/// Light that discs send out, bounce by bounce. Element b is that of b + 1 reflections, the first
/// what they reflect of the lamps, as `direct` (SurfelDirectLight) tells light_surfels(). Its
/// length is options.last, or less where light runs out. Rays from disc to disc are traced once, by
/// `rays` (SurfelLinks): every bounce goes along the same ones. 24 bytes for each node and bounce,
/// and SurfelLinks::bytes() meanwhile.
/// @throws Error(invalid_argument) on options out of range, Error(limit_exceeded) by
///     Limits::surfel_link_bytes.
template <class Direct, class Rays, Executor E>
std::vector<std::vector<SurfelRadiance>> surfel_bounces(const SurfelPatches& patches,
                                                        const Direct& direct, const Rays& rays,
                                                        float ray_offset,
                                                        const SurfelBounceOptions& options,
                                                        E& executor) {
    expects(options.last >= 1, "discs that reflect nothing send out nothing; ask for one bounce");
    std::vector<std::vector<SurfelRadiance>> bounces;
    bounces.push_back(light_surfels(patches, direct, ray_offset, executor));
    if (options.last == 1) return bounces;
    const SurfelLinks links(patches, rays, options.gather, ray_offset, options.seed, options.limits,
                            executor);
    const SurfelTree& tree = patches.tree();
    double power = detail::sent_power(tree, bounces[0]);
    double added = power;
    while (bounces.size() < options.last && added > options.least * power) {
        const auto reflected = [&](const SurfelFace&, std::uint64_t number) {
            return links(number, bounces.back());
        };
        bounces.push_back(light_surfels(patches, reflected, ray_offset, executor));
        added = detail::sent_power(tree, bounces.back());
        power += added;
    }
    return bounces;
}

/// Sum of the light of all bounces, node by node.
inline std::vector<SurfelRadiance> sum_of(std::span<const std::vector<SurfelRadiance>> bounces) {
    std::vector<SurfelRadiance> sum = bounces.front();
    for (const auto& bounce : bounces.subspan(1))
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i].front += bounce[i].front;
            sum[i].back += bounce[i].back;
        }
    return sum;
}

}  // namespace mir
