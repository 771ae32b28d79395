// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/cluster_shafts.hpp"

namespace mir {

/// Decides pairs of 32 luxels and a VPL by the leaves that their shafts meet: kernel for groups,
/// one pair after another. First a triangle per lane against the pyramid, then a luxel per lane
/// against the triangles that are partial. Pairs with too many triangles are queued.
template <Space S, VplSet P>
struct ClusterLists {
    static constexpr std::uint32_t most_triangles = 192;  ///< of a pair
    /// Partial triangles that are kept until luxels are asked; more are asked about in turns. Few,
    /// because what groups work in is taken from the cache of the nodes and triangles.
    static constexpr std::uint32_t most_forms = LaneGroup::width;
    /// Lists that a group takes together: neighbours, which share nodes and triangles.
    static constexpr std::uint32_t lists_at_once = 4;
    /// As BlockShafts::resident_blocks.
    static constexpr std::uint32_t resident_blocks = 10;

    /// What a group works in.
    struct Workspace {
        SegmentForms forms[most_forms];           ///< of triangles that are partial
        std::uint32_t triangles[most_triangles];  ///< of a pair, by place in the hierarchy
    };

    SoaView<const Hit> hits;                  ///< in cluster order
    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;                                   ///< those of the words
    WideBvhView<S> bvh;                       ///< of the scene
    float sigma = 0.0f;                       ///< of the scene, metres, as for the records
    std::uint32_t* words = nullptr;           ///< as VisibilityWords
    WorkQueue<ListedPair> listed;             ///< to decide
    const MetLeaves* pool = nullptr;          ///< leaves that `listed` refers to: LeafPool::leaves
    WorkQueue<OpenPair> open;                 ///< left to single segments; has room for all

    /// Takes pairs from `listed` until none is left: any number of groups does all the work.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t /*i*/, Workspace& space) const {
        const std::uint32_t count = listed.size();
        std::uint32_t next = listed.take(group, lists_at_once);
        while (next < count) {
            const std::uint32_t first = next;
            // Asked for before it is needed, because the answer takes its time.
            next = listed.take(group, lists_at_once);
            const std::uint32_t end = first + lists_at_once < count ? first + lists_at_once : count;
            for (std::uint32_t at = first; at < end; ++at) decide(group, listed.items[at], space);
        }
    }

 private:
    static constexpr std::uint32_t too_many = 0xFFFFFFFFu;

    /// The segments of a pair.
    struct Cone {
        const Pyramid& pyramid;
        const LaneGroup::PerLane<Vec3>& luxels;  ///< their ends, metres
    };

    MIR_HD void decide(const LaneGroup& group, ListedPair list, Workspace& space) const {
        // What is read here arrives while the list is unpacked.
        const OpenPair pair = list.pair;
        std::uint32_t& word = words[std::size_t{pair.cluster} * vpls.size() + pair.vpl];
        const std::uint32_t before = word;
        const ClusterRecord cluster = clusters[pair.cluster];
        const Vec3 apex = vpls[pair.vpl].position;
        LaneGroup::PerLane<Vec3> luxels;
        group.each([&](std::uint32_t lane) {
            luxels[lane] = hits.load(pair.cluster * cluster_luxels + lane).position;
        });
        const std::uint32_t count = unpack(group, list, space);
        if (count == too_many) {
            static_cast<void>(open.append(group, 1u, [&](std::uint32_t) { return pair; }));
            return;
        }
        const Pyramid pyramid = make_pyramid(cluster, apex, sigma);
        const std::uint32_t lit = lit_behind_all(group, {pyramid, luxels}, before, count, space);
        group.each([&](std::uint32_t lane) {
            if (lane == 0 && lit != before) word = lit;
        });
    }

    /// Writes the triangles of a pair's leaves to the workspace, a node per lane; returns how many
    /// there are.
    [[nodiscard]] MIR_HD std::uint32_t unpack(const LaneGroup& group, const ListedPair& list,
                                              Workspace& space) const {
        std::uint32_t written = 0;
        for (std::uint32_t first = 0; first < list.nodes; first += LaneGroup::width) {
            LaneGroup::PerLane<MetLeaves> met;
            LaneGroup::PerLane<std::uint32_t> place;
            group.each([&](std::uint32_t lane) {
                met[lane] =
                    first + lane < list.nodes ? pool[list.first + first + lane] : MetLeaves{};
                place[lane] = 0;
                for_each_leaf(met[lane], [&](Leaf leaf) { place[lane] += leaf.count; });
            });
            const std::uint32_t count = group.sums_before(place);
            if (written + count > most_triangles) return too_many;
            group.each([&](std::uint32_t lane) {
                std::uint32_t* out = space.triangles + written + place[lane];
                for_each_leaf(met[lane], [&](Leaf leaf) {
                    for (std::uint32_t i = 0; i < leaf.count; ++i) *out++ = leaf.first + i;
                });
            });
            written += count;
        }
        return written;
    }

    /// Triangles of a leaf.
    struct Leaf {
        std::uint32_t first;
        std::uint32_t count;
    };

    template <class F>
    MIR_HD void for_each_leaf(MetLeaves met, const F& f) const {
        const WideNode& node = bvh.nodes[met.node()];
        for (std::uint32_t slots = met.slots(); slots != 0; slots &= slots - 1) {
            const std::uint32_t slot = LaneGroup::lowest(slots);
            f(Leaf{node.ref[slot], triangles_of_slot(node, slot)});
        }
    }

    /// Luxels of `lit` whose segments none of the first `count` triangles hits.
    [[nodiscard]] MIR_HD std::uint32_t lit_behind_all(const LaneGroup& group, const Cone& cone,
                                                      std::uint32_t lit, std::uint32_t count,
                                                      Workspace& space) const {
        std::uint32_t kept = 0;
        for (std::uint32_t first = 0; first < count; first += LaneGroup::width) {
            LaneGroup::PerLane<Occlusion> found;
            LaneGroup::PerLane<SegmentForms> forms;
            group.each([&](std::uint32_t lane) {
                // Lanes without a triangle test another's, so that all have forms.
                const bool is_own = first + lane < count;
                const std::uint32_t triangle = space.triangles[is_own ? first + lane : first];
                found[lane] = occlusion(bvh.triangles[triangle], cone.pyramid, forms[lane]);
                if (!is_own) found[lane] = Occlusion::none;
                forms[lane].triangle = triangle;
            });
            if (group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::full; }) !=
                0)
                return 0;
            const std::uint32_t partial =
                group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::partial; });
            if (kept + LaneGroup::count(partial) > most_forms) {
                lit = lit_behind(group, cone, lit, kept, space);
                kept = 0;
                if (lit == 0) return 0;
            }
            group.each([&](std::uint32_t lane) {
                if ((partial >> lane & 1u) != 0)
                    space.forms[kept + LaneGroup::count_before(partial, lane)] = forms[lane];
            });
            kept += LaneGroup::count(partial);
        }
        return lit_behind(group, cone, lit, kept, space);
    }

    /// The same by the first `count` of the triangles that are partial, a luxel per lane.
    [[nodiscard]] MIR_HD std::uint32_t lit_behind(const LaneGroup& group, const Cone& cone,
                                                  std::uint32_t lit, std::uint32_t count,
                                                  const Workspace& space) const {
        LaneGroup::PerLane<Vec3> ends;
        group.each(
            [&](std::uint32_t lane) { ends[lane] = cone.luxels[lane] - cone.pyramid.centre; });
        const float plane = OcclusionMargins::plane * sigma;
        for (std::uint32_t k = 0; k < count && lit != 0; ++k) {
            const SegmentForms forms = space.forms[k];
            LaneGroup::PerLane<SegmentValues> at;
            group.each([&](std::uint32_t lane) { at[lane] = values_at(forms, ends[lane]); });
            std::uint32_t hit = group.ballot(
                [&](std::uint32_t lane) { return surely_hit(at[lane], forms, plane); });
            const std::uint32_t missed = group.ballot(
                [&](std::uint32_t lane) { return surely_missed(at[lane], forms, plane); });
            if ((lit & ~hit & ~missed) != 0) hit |= hit_exactly(group, cone, forms.triangle);
            lit &= ~hit;
        }
        return lit;
    }

    [[nodiscard]] MIR_HD std::uint32_t hit_exactly(const LaneGroup& group, const Cone& cone,
                                                   std::uint32_t triangle) const {
        return group.ballot([&](std::uint32_t lane) {
            return hits_segment(bvh.triangles[triangle], cone.pyramid.apex, cone.luxels[lane]);
        });
    }
};

}  // namespace mir
