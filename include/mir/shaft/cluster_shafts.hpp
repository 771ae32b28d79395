// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/block_shafts.hpp"

namespace mir {

/// Decides pairs of 32 luxels and a VPL that a block's shaft left open: kernel for groups, each of
/// which takes four blocks at a time, a cluster per lane. Lists of triangles are resolved by all
/// lanes together, a triangle per lane against the pyramid and then a luxel per lane against the
/// triangles that are partial. Pairs whose search gave up are queued.
template <Space S, VplSet P>
struct ClusterShafts {
    static constexpr std::uint32_t block_words = block_luxels / cluster_luxels;
    static constexpr std::uint32_t blocks_at_once = LaneGroup::width / block_words;
    static constexpr std::uint32_t most_triangles = 192;  ///< of a list

    /// What a group works in.
    struct Workspace {
        LeafColumns<LaneGroup::width> leaves;
        std::uint32_t triangles[most_triangles];    ///< of one lane
        detail::RowValues of_apex[most_triangles];  ///< theirs at the VPL, of those kept
    };

    SoaView<const Hit> hits;
    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;
    QuantisedBvhView<S> bvh;
    float sigma = 0.0f;            ///< of the scene, metres, as for the records
    std::uint32_t most_nodes = 0;  ///< visited by a shaft
    std::uint32_t group_count = 0;
    std::uint32_t* words = nullptr;  ///< as VisibilityWords
    PairQueue blocks;                ///< to decide
    PairQueue open;                  ///< clusters, left to single segments

    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const std::uint32_t count = blocks.size();
        for (std::uint32_t first = i * blocks_at_once; first < count;
             first += group_count * blocks_at_once)
            decide(group, first, count, space);
    }

 private:
    /// What a lane works on.
    struct Task {
        bool is_alive;
        std::uint32_t cluster;
        VplIndex vpl;
    };

    MIR_HD void decide(const LaneGroup& group, std::uint32_t first, std::uint32_t count,
                       Workspace& space) const {
        LaneGroup::PerLane<Task> tasks;
        LaneGroup::PerLane<LeafSearch> searches;
        LaneGroup::PerLane<ShaftSlabs> slabs;
        group.each([&](std::uint32_t lane) {
            const Task task = task_of(first, count, lane);
            tasks[lane] = task;
            bool on = task.is_alive && is_proved_scale(bvh.exact.reach);
            if (on) {
                const Vec3 apex = vpls[task.vpl].position;
                const ClusterRecord& cluster = clusters[task.cluster];
                on = within_reach(apex, bvh.exact.reach) && within_reach(cluster, bvh.exact.reach);
                if (on) slabs[lane] = make_shaft_slabs(cluster, apex, sigma, bvh.exact.reach);
            }
            searches[lane].begin(on);
        });
        search_leaves(group, bvh, slabs, most_nodes, searches, space.leaves);
        std::uint32_t undecided = group.ballot([&](std::uint32_t lane) {
            return tasks[lane].is_alive && searches[lane].state != LeafSearchState::complete;
        });
        undecided |= resolve_lists(group, tasks, searches, space);
        open.append(group, undecided, [&](std::uint32_t lane) {
            return OpenPair{tasks[lane].cluster, tasks[lane].vpl};
        });
    }

    [[nodiscard]] MIR_HD std::uint32_t& word(std::uint32_t cluster, VplIndex j) const {
        return words[std::size_t{cluster} * vpls.size() + j];
    }

    [[nodiscard]] MIR_HD Task task_of(std::uint32_t first, std::uint32_t count,
                                      std::uint32_t lane) const {
        const std::uint32_t at = first + lane / block_words;
        if (at >= count) return {false, 0, 0};
        const OpenPair pair = blocks.pairs[at];
        const std::uint32_t cluster = pair.cluster * block_words + lane % block_words;
        return {word(cluster, pair.vpl) != 0, cluster, pair.vpl};
    }

    /// The lists of all lanes that have a complete one, one list after the other. Returns the lanes
    /// whose lists are too long.
    MIR_HD std::uint32_t resolve_lists(const LaneGroup& group,
                                       const LaneGroup::PerLane<Task>& tasks,
                                       const LaneGroup::PerLane<LeafSearch>& searches,
                                       Workspace& space) const {
        LaneGroup::PerLane<std::uint32_t> cluster;
        LaneGroup::PerLane<std::uint32_t> vpl;
        LaneGroup::PerLane<std::uint32_t> sizes;
        group.each([&](std::uint32_t lane) {
            cluster[lane] = tasks[lane].cluster;
            vpl[lane] = tasks[lane].vpl;
            sizes[lane] = searches[lane].listed;
        });
        std::uint32_t listed = group.ballot([&](std::uint32_t lane) {
            return searches[lane].state == LeafSearchState::complete && searches[lane].listed > 0;
        });
        std::uint32_t too_long = 0;
        for (; listed != 0; listed &= listed - 1) {
            const std::uint32_t owner = LaneGroup::lowest(listed);
            const std::uint32_t count = unpack(group, owner, group.broadcast(sizes, owner), space);
            if (count == too_many)
                too_long |= 1u << owner;
            else
                resolve(group, group.broadcast(cluster, owner), group.broadcast(vpl, owner), count,
                        space);
        }
        return too_long;
    }

    /// Writes the triangles of a lane's leaves to the workspace, a slot of a node per lane; returns
    /// how many there are. Those that are too many are not written.
    [[nodiscard]] MIR_HD std::uint32_t unpack(const LaneGroup& group, std::uint32_t owner,
                                              std::uint32_t listed, Workspace& space) const {
        constexpr std::uint32_t nodes_at_once = LaneGroup::width / WideNode::width;
        std::uint32_t written = 0;
        for (std::uint32_t first = 0; first < listed; first += nodes_at_once) {
            LaneGroup::PerLane<std::uint32_t> place;
            LaneGroup::PerLane<Leaf> leaves;
            group.each([&](std::uint32_t lane) {
                const std::uint32_t at = first + lane / WideNode::width;
                leaves[lane] = at < listed
                                   ? leaf_in(space.leaves.met[at][owner], lane % WideNode::width)
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
        const WideNode& node = bvh.exact.nodes[met.node()];
        return {node.ref[slot], triangles_of_slot(node, slot)};
    }

    /// Decides a pair by `count` triangles, which are all that matter.
    MIR_HD void resolve(const LaneGroup& group, std::uint32_t cluster, VplIndex j,
                        std::uint32_t count, Workspace& space) const {
        const Vec3 apex = vpls[j].position;
        const std::uint32_t partial = keep_partial(group, cluster, apex, count, space);
        const std::uint32_t before = word(cluster, j);
        const std::uint32_t lit =
            partial == covered ? 0u : lit_behind(group, cluster, before, partial, space);
        group.each([&](std::uint32_t lane) {
            if (lane == 0 && lit != before) word(cluster, j) = lit;
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
                const TriangleRows rows = bvh.exact.triangles[triangle[lane]];
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
            const TriangleRows rows = bvh.exact.triangles[space.triangles[k]];
            const detail::RowValues from = space.of_apex[k];
            lit &= ~group.ballot([&](std::uint32_t lane) {
                return detail::hits_segment(from, detail::row_values(rows, luxels[lane]));
            });
        }
        return lit;
    }
};

}  // namespace mir
