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

    /// Numbers of a SegmentForms that are no row. Aligned so that the device moves it as one word.
    struct alignas(8) FormScalars {
        float depth;   ///< metres
        float margin;  ///< metres
    };

    /// What a group works in. Rows stand in arrays of their own: 32 lanes that write whole forms,
    /// 64 bytes apart, meet in few banks of the device's memory and take four times as long.
    struct Workspace {
        PlainRow beyond[most_forms];              ///< of triangles that are partial
        PlainRow u[most_forms];                   ///< of the same
        PlainRow v[most_forms];                   ///< of the same
        FormScalars scalars[most_forms];          ///< of the same
        std::uint32_t partial[most_forms];        ///< the same, by place in the hierarchy
        std::uint32_t triangles[most_triangles];  ///< of a pair, by place in the hierarchy
    };

    SoaView<const Hit> hits;                  ///< in cluster order
    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;                                   ///< those of the words
    QuantisedBvhView<S> bvh;                  ///< of the scene
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
            LaneGroup::PerLane<LeafTriangles> triangles;
            LaneGroup::PerLane<std::uint32_t> place;
            group.each([&](std::uint32_t lane) {
                const MetLeaves met =
                    first + lane < list.nodes ? pool[list.first + first + lane] : MetLeaves{};
                triangles[lane] = bvh.links[met.node()].leaves(met.slots());
                place[lane] = triangles[lane].count();
            });
            const std::uint32_t count = group.sums_before(place);
            if (written + count > most_triangles) return too_many;
            group.each([&](std::uint32_t lane) {
                std::uint32_t* out = space.triangles + written + place[lane];
                triangles[lane].for_each([&](std::uint32_t triangle) { *out++ = triangle; });
            });
            written += count;
        }
        return written;
    }

    /// Luxels of `lit` whose segments none of the first `count` triangles hits.
    [[nodiscard]] MIR_HD std::uint32_t lit_behind_all(const LaneGroup& group, const Cone& cone,
                                                      std::uint32_t lit, std::uint32_t count,
                                                      Workspace& space) const {
        std::uint32_t kept = 0;
        for (std::uint32_t first = 0; first < count; first += LaneGroup::width) {
            LaneGroup::PerLane<Occlusion> found;
            LaneGroup::PerLane<SegmentForms> forms;
            LaneGroup::PerLane<std::uint32_t> triangles;
            group.each([&](std::uint32_t lane) {
                // Lanes without a triangle test another's, so that all have forms.
                const bool is_own = first + lane < count;
                triangles[lane] = space.triangles[is_own ? first + lane : first];
                const TriangleRows& rows = bvh.exact.triangles[triangles[lane]];
                found[lane] = occlusion(rows, cone.pyramid, forms[lane]);
                if (!is_own) found[lane] = Occlusion::none;
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
                    keep(forms[lane], triangles[lane],
                         kept + LaneGroup::count_before(partial, lane), space);
            });
            kept += LaneGroup::count(partial);
        }
        return lit_behind(group, cone, lit, kept, space);
    }

    MIR_HD static void keep(const SegmentForms& forms, std::uint32_t triangle, std::uint32_t at,
                            Workspace& space) {
        space.beyond[at] = forms.beyond;
        space.u[at] = forms.u;
        space.v[at] = forms.v;
        space.scalars[at] = {forms.depth, forms.margin};
        space.partial[at] = triangle;
    }
    [[nodiscard]] MIR_HD static SegmentForms kept_forms(std::uint32_t at, const Workspace& space) {
        const FormScalars scalars = space.scalars[at];
        return {space.beyond[at], space.u[at], space.v[at], scalars.depth, scalars.margin};
    }

    /// What a lane knows of its luxel's segment.
    struct Segment {
        Vec3 end;              ///< from the centre of the pyramid's base, metres
        std::uint32_t lit;     ///< 1: no triangle is known to hit it
        std::uint32_t unsure;  ///< bit k: the margins of triangle k leave it open
    };

    /// The same by the first `count` of the triangles that are partial, a luxel per lane. Those
    /// that are left open are asked exactly, and last: by then most of the segments are hidden.
    [[nodiscard]] MIR_HD std::uint32_t lit_behind(const LaneGroup& group, const Cone& cone,
                                                  std::uint32_t lit, std::uint32_t count,
                                                  const Workspace& space) const {
        LaneGroup::PerLane<Segment> segments;
        group.each([&](std::uint32_t lane) {
            segments[lane] = {cone.luxels[lane] - cone.pyramid.centre, lit >> lane & 1u, 0};
        });
        for (std::uint32_t k = 0; k < count; k += 2) {
            group.each([&](std::uint32_t lane) {
                ask(kept_forms(k, space), k, segments[lane]);
                if (k + 1 < count) ask(kept_forms(k + 1, space), k + 1, segments[lane]);
            });
            if (lit_of(group, segments) == 0) return 0;
        }
        ask_exactly(group, cone, space, segments);
        return lit_of(group, segments);
    }

    /// Asks triangle `k`.
    MIR_HD void ask(const SegmentForms& forms, std::uint32_t k, Segment& segment) const {
        const float plane = OcclusionMargins::plane * sigma;
        const SegmentValues at = values_at(forms, segment.end);
        const bool is_hit = surely_hit(at, forms, plane);
        const bool is_decided = is_hit | surely_missed(at, forms, plane);
        segment.unsure |= is_decided ? 0u : 1u << k;
        segment.lit = is_hit ? 0u : segment.lit;
    }

    /// Asks the triangles that leave segments open.
    MIR_HD void ask_exactly(const LaneGroup& group, const Cone& cone, const Workspace& space,
                            LaneGroup::PerLane<Segment>& segments) const {
        for (;;) {
            const std::uint32_t asked = group.any_bits(
                [&](std::uint32_t lane) { return segments[lane].lit * segments[lane].unsure; });
            if (asked == 0) return;
            const std::uint32_t k = LaneGroup::lowest(asked);
            const TriangleRows& rows = bvh.exact.triangles[space.partial[k]];
            group.each([&](std::uint32_t lane) {
                segments[lane].unsure &= ~(1u << k);
                if (hits_segment(rows, cone.pyramid.apex, cone.luxels[lane]))
                    segments[lane].lit = 0;
            });
        }
    }

    [[nodiscard]] MIR_HD static std::uint32_t lit_of(const LaneGroup& group,
                                                     const LaneGroup::PerLane<Segment>& segments) {
        return group.ballot([&](std::uint32_t lane) { return segments[lane].lit != 0; });
    }
};

}  // namespace mir
