// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/accept_box.hpp"
#include "mir/shaft/exact/occlusion.hpp"
#include "mir/shaft/exact/shaft_walk.hpp"

namespace mir {

/// What is known of all segments between a VPL and a cluster.
enum class PairState : std::uint8_t {
    clear,    ///< no triangle hits any of them
    covered,  ///< one single triangle hits them all
    listed,   ///< a list holds every triangle that hits some of them
    unknown   ///< the search gave up, or the proofs do not hold: not within reach
};

/// Triangles that may hit some segments of a pair, by their place in the hierarchy. A plain array,
/// because device code cannot index std::array; not cleared, because most pairs need little of it.
/// Source: Haines and Wallace, "Shaft culling for efficient ray-traced radiosity", Eurographics
/// Workshop on Rendering 1991.
struct CandidateList {
    static constexpr std::uint32_t capacity = 64;  ///< triangles at most

    std::uint32_t triangle[capacity];  ///< the first `size` have a value
    std::uint32_t size = 0;            ///< triangles listed

    /// Lists one more. There must be room: not checked.
    MIR_HD void add(std::uint32_t t) { triangle[size++] = t; }
};

/// What a search for a pair's triangles may cost. Any numbers are right: fewer make it give up more
/// often.
struct SearchLimits {
    std::uint32_t nodes;      ///< visited at most
    std::uint32_t triangles;  ///< listed at most; no more than CandidateList::capacity count
};

namespace detail {

/// Leaf visitor that lists what is partial. It stops at what covers all and when the list is full.
template <Space S>
struct ListPartial {
    const WideBvhView<S>& bvh;
    const Pyramid& pyramid;
    CandidateList& list;
    std::uint32_t most = 0;
    PairState stopped_by = PairState::unknown;

    MIR_HD bool operator()(std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t t = first; t < first + count; ++t) {
            const Occlusion found = occlusion(bvh.triangles[t], pyramid);
            if (found == Occlusion::none) continue;
            if (found == Occlusion::full) stopped_by = PairState::covered;
            if (found == Occlusion::full || list.size >= most) return true;
            list.add(t);
        }
        return false;
    }
};

}  // namespace detail

/// Whether the proofs of docs/shaft_proofs.md hold for a scene of that reach. Products overflow in
/// larger ones. Scenes too small for them have no triangles (WorldGeometry drops those without
/// area).
[[nodiscard]] MIR_HD inline bool is_proved_scale(float reach) { return reach <= reach_of(1e18f); }

/// Looks for the triangles that hit segments between a cluster and a VPL. The VPL is at `apex`,
/// metres; they are in the empty `list` if the state is `listed`. `sigma` as for the cluster, which
/// has luxels. A list is complete only if the walk ended by itself.
template <Space S>
[[nodiscard]] MIR_HD PairState search_pair(const WideBvhView<S>& bvh, const ClusterRecord& cluster,
                                           Vec3 apex, float sigma, SearchLimits limits,
                                           CandidateList& list) {
    if (!is_proved_scale(bvh.reach) || !within_reach(cluster, bvh.reach) ||
        !within_reach(apex, bvh.reach))
        return PairState::unknown;
    const Pyramid pyramid = make_pyramid(cluster, apex, sigma);
    const std::uint32_t most =
        limits.triangles < CandidateList::capacity ? limits.triangles : CandidateList::capacity;
    detail::ListPartial<S> leaf{bvh, pyramid, list, most};
    const WalkEnd end = walk_shaft(bvh, make_shaft(cluster, apex, sigma), limits.nodes, leaf);
    if (end != WalkEnd::complete) return leaf.stopped_by;
    return list.size == 0 ? PairState::clear : PairState::listed;
}

/// The same for a part of another cluster. Its complete list is `known`. Never unknown.
template <Space S>
[[nodiscard]] MIR_HD PairState narrow_pair(const WideBvhView<S>& bvh, const ClusterRecord& cluster,
                                           Vec3 apex, float sigma, const CandidateList& known,
                                           CandidateList& list) {
    const Pyramid pyramid = make_pyramid(cluster, apex, sigma);
    for (std::uint32_t i = 0; i < known.size; ++i) {
        const Occlusion found = occlusion(bvh.triangles[known.triangle[i]], pyramid);
        if (found == Occlusion::full) return PairState::covered;
        if (found == Occlusion::partial) list.add(known.triangle[i]);
    }
    return list.size == 0 ? PairState::clear : PairState::listed;
}

}  // namespace mir
