// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/cluster_shafts.hpp"

namespace mir {

/// Decides pairs of 32 luxels and a VPL by the leaves that their shafts meet: kernel for groups, a
/// pair at a time. First a triangle per lane against the pyramid, then a luxel per lane against the
/// triangles that are partial. Pairs with too many triangles are queued.
template <Space S, VplSet P>
struct ClusterLists {
    static constexpr std::uint32_t most_triangles = 192;  ///< of a pair

    /// What a group works in.
    struct Workspace {
        std::uint32_t triangles[most_triangles];
        detail::RowValues of_apex[most_triangles];  ///< theirs at the VPL, of those kept
    };

    SoaView<const Hit> hits;
    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;
    WideBvhView<S> bvh;
    float sigma = 0.0f;              ///< of the scene, metres, as for the records
    std::uint32_t* words = nullptr;  ///< as VisibilityWords
    WorkQueue<ListedPair> listed;    ///< to decide
    const MetLeaves* pool = nullptr;
    WorkQueue<OpenPair> open;  ///< left to single segments; has room for all

    MIR_HD void operator()(const LaneGroup& group, std::uint32_t /*i*/, Workspace& space) const {
        const std::uint32_t count = listed.size();
        for (std::uint32_t at = listed.take(group, 1); at < count; at = listed.take(group, 1))
            decide(group, listed.items[at], space);
    }

 private:
    MIR_HD void decide(const LaneGroup& group, const ListedPair& list, Workspace& space) const {
        const std::uint32_t count = unpack(group, list, space);
        if (count != too_many) return resolve(group, list.pair, count, space);
        static_cast<void>(open.append(group, 1u, [&](std::uint32_t) { return list.pair; }));
    }

    /// Writes the triangles of a pair's leaves to the workspace, a slot of a node per lane; returns
    /// how many there are.
    [[nodiscard]] MIR_HD std::uint32_t unpack(const LaneGroup& group, const ListedPair& list,
                                              Workspace& space) const {
        constexpr std::uint32_t nodes_at_once = LaneGroup::width / WideNode::width;
        std::uint32_t written = 0;
        for (std::uint32_t first = 0; first < list.nodes; first += nodes_at_once) {
            LaneGroup::PerLane<std::uint32_t> place;
            LaneGroup::PerLane<Leaf> leaves;
            group.each([&](std::uint32_t lane) {
                const std::uint32_t at = first + lane / WideNode::width;
                leaves[lane] = at < list.nodes
                                   ? leaf_in(pool[list.first + at], lane % WideNode::width)
                                   : Leaf{0, 0};
                place[lane] = leaves[lane].count;
            });
            const std::uint32_t count = group.sums_before(place);
            if (written + count > most_triangles) return too_many;
            group.each([&](std::uint32_t lane) {
                std::uint32_t* const out = space.triangles + written + place[lane];
                for (std::uint32_t i = 0; i < leaves[lane].count; ++i)
                    out[i] = leaves[lane].first + i;
            });
            written += count;
        }
        return written;
    }

    static constexpr std::uint32_t too_many = 0xFFFFFFFFu;

    /// Triangles of a leaf.
    struct Leaf {
        std::uint32_t first;
        std::uint32_t count;
    };

    [[nodiscard]] MIR_HD Leaf leaf_in(MetLeaves met, std::uint32_t slot) const {
        if ((met.slots() >> slot & 1u) == 0) return {0, 0};
        const WideNode& node = bvh.nodes[met.node()];
        return {node.ref[slot], triangles_of_slot(node, slot)};
    }

    /// Decides a pair by `count` triangles, which are all that matter.
    MIR_HD void resolve(const LaneGroup& group, OpenPair pair, std::uint32_t count,
                        Workspace& space) const {
        const std::uint32_t partial =
            keep_partial(group, pair.cluster, vpls[pair.vpl].position, count, space);
        std::uint32_t& word = words[std::size_t{pair.cluster} * vpls.size() + pair.vpl];
        const std::uint32_t before = word;
        const std::uint32_t lit =
            partial == covered ? 0u : lit_behind(group, pair.cluster, before, partial, space);
        group.each([&](std::uint32_t lane) {
            if (lane == 0 && lit != before) word = lit;
        });
    }

    static constexpr std::uint32_t covered = 0xFFFFFFFFu;

    /// Moves those of `count` triangles that are partial to the front of the workspace and returns
    /// their number, or `covered` when one covers the whole cluster.
    [[nodiscard]] MIR_HD std::uint32_t keep_partial(const LaneGroup& group, std::uint32_t cluster,
                                                    Vec3 apex, std::uint32_t count,
                                                    Workspace& space) const {
        const Pyramid pyramid = make_pyramid(clusters[cluster], apex, sigma);
        std::uint32_t kept = 0;
        for (std::uint32_t first = 0; first < count; first += LaneGroup::width) {
            LaneGroup::PerLane<std::uint32_t> triangle;
            LaneGroup::PerLane<Occlusion> found;
            LaneGroup::PerLane<detail::RowValues> of_apex;
            group.each([&](std::uint32_t lane) {
                found[lane] = Occlusion::none;
                if (first + lane >= count) return;
                triangle[lane] = space.triangles[first + lane];
                const TriangleRows rows = bvh.triangles[triangle[lane]];
                found[lane] = occlusion(rows, pyramid);
                of_apex[lane] = detail::row_values(rows, apex);
            });
            if (group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::full; }) !=
                0)
                return covered;
            const std::uint32_t partial =
                group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::partial; });
            group.each([&](std::uint32_t lane) {
                if ((partial >> lane & 1u) == 0) return;
                const std::uint32_t at = kept + LaneGroup::count(partial & ((1u << lane) - 1u));
                space.triangles[at] = triangle[lane];
                space.of_apex[at] = of_apex[lane];
            });
            kept += LaneGroup::count(partial);
        }
        return kept;
    }

    /// Luxels of `lit` whose segments none of the first `count` triangles hits.
    [[nodiscard]] MIR_HD std::uint32_t lit_behind(const LaneGroup& group, std::uint32_t cluster,
                                                  std::uint32_t lit, std::uint32_t count,
                                                  const Workspace& space) const {
        LaneGroup::PerLane<Vec3> luxels;
        group.each([&](std::uint32_t lane) {
            luxels[lane] = hits.load(cluster * cluster_luxels + lane).position;
        });
        for (std::uint32_t k = 0; k < count && lit != 0; ++k) {
            const TriangleRows rows = bvh.triangles[space.triangles[k]];
            const detail::RowValues from = space.of_apex[k];
            lit &= ~group.ballot([&](std::uint32_t lane) {
                return detail::hits_segment(from, detail::row_values(rows, luxels[lane]));
            });
        }
        return lit;
    }
};

}  // namespace mir
