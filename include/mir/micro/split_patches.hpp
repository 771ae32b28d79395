// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_radiance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace mir {

namespace detail {

/// Luminance that a patch reflects, and how much its halves differ, W sr^-1. It counts light on
/// both sides; the halves are those in which most of the difference shows.
struct PatchPower {
    double reflected = 0.0;
    double difference = 0.0;
};

/// Of one side, from its quarters in the order of the tree. Those lie left and right of one cut and
/// of another; which of the last two differences belongs to the second is not known.
inline PatchPower power_of(const std::array<Rgb, 4>& quarters, Rgb albedo, float area) {
    std::array<double, 4> q;
    for (std::size_t i = 0; i < 4; ++i)
        q[i] = 0.25 * static_cast<double>(luminance(quarters[i] * albedo) * area);
    return {q[0] + q[1] + q[2] + q[3], 2.0 * std::max({std::fabs(q[0] + q[1] - q[2] - q[3]),
                                                       std::fabs(q[0] + q[2] - q[1] - q[3]),
                                                       std::fabs(q[0] + q[3] - q[1] - q[2])})};
}

template <class Direct, Executor E>
std::vector<PatchPower> powers_of(const SurfelPatches& patches, const Direct& direct,
                                  float ray_offset, E& executor) {
    std::vector<PatchPower> powers(patches.size());
    const SurfelTreeView<Space::host> tree = patches.tree().view();
    for_each_reflecting_patch(patches, executor, [&](std::size_t i) {
        const std::uint32_t node = patches.nodes()[i];
        const std::uint64_t number = 2 * std::uint64_t{tree.nodes[node].first};
        for (const bool front : {true, false}) {
            const SurfelFace face{tree, node, front, ray_offset};
            const PatchPower side = power_of(direct.quarters(face, number + (front ? 0 : 1)),
                                             tree.albedo[node], tree.area[node]);
            powers[i].reflected += side.reflected;
            powers[i].difference += side.difference;
        }
    });
    return powers;
}

inline double mean_reflected(std::span<const PatchPower> powers) {
    double sum = 0.0;
    for (const PatchPower& p : powers) sum += p.reflected;
    return powers.empty() ? 0.0 : sum / static_cast<double>(powers.size());
}

}  // namespace detail

/// Splits patches on which the light of lamps varies, again and again. It stops when two halves of
/// one differ by less than a patch reflects in the mean: so patches are small where lamps are near
/// and bright, and where shadows end. `direct` (SurfelDirectLight) tells the light of their
/// quarters. Other random numbers than its must light the result, or what it found too bright is
/// lost. The same for any number of threads.
template <class Direct, Executor E>
SurfelPatches split_patches(const SurfelPatches& coarse, const Direct& direct, float ray_offset,
                            E& executor) {
    const SurfelTree& tree = coarse.tree();
    std::vector<std::uint32_t> done;
    std::vector<std::uint32_t> next(coarse.nodes().begin(), coarse.nodes().end());
    std::optional<double> most;
    while (!next.empty()) {
        const SurfelPatches patches(tree, std::exchange(next, {}));
        const auto powers = detail::powers_of(patches, direct, ray_offset, executor);
        if (!most) most = detail::mean_reflected(powers);
        for (std::size_t i = 0; i < patches.size(); ++i) {
            const std::uint32_t node = patches.nodes()[i];
            if (tree.nodes()[node].is_leaf() || powers[i].difference <= *most) {
                done.push_back(node);
                continue;
            }
            next.insert(next.end(), {node + 1, tree.nodes()[node].right});
        }
    }
    std::sort(done.begin(), done.end());
    return {tree, std::move(done)};
}

}  // namespace mir
