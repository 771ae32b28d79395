// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/device/list_batch.hpp"
#include "mir/shaft/device/pair_segments.hpp"

namespace mir {

/// Decides pairs of 32 luxels and a VPL by the leaves met. They are those of their shafts, or of
/// their blocks': kernel for groups, a few pairs at a time. First a triangle per lane against the
/// pyramid of its pair, then, pair by pair, a luxel per lane against the triangles that are
/// partial. Pairs with too many triangles are queued.
template <Space S, VplSet P>
struct ClusterLists {
    /// As BlockShafts::resident_blocks.
    static constexpr std::uint32_t resident_blocks = 9;

    /// Workspace of a group: little, since it shares the cache of nodes and triangles.
    struct Workspace {
        KeptPlanes planes;                                   ///< of triangles that are partial
        std::uint32_t triangles[ListBatch::most_triangles];  ///< of all pairs, by place
        Pyramid pyramids[ListBatch::most_lists];             ///< of the pairs
    };

    SoaView<const Hit> hits;                  ///< in cluster order
    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;                                   ///< those of the words
    QuantisedBvhView<S> bvh;                  ///< of the scene
    float sigma = 0.0f;                       ///< of the scene, metres, as for the records
    std::uint32_t* words = nullptr;           ///< as VisibilityWords
    WorkQueue<ListedPair> blocks;             ///< to decide, with up to 32 triangles
    WorkQueue<ListedPair> listed;             ///< clusters to decide
    const std::uint32_t* pool = nullptr;      ///< that both refer to: LeafPool::words
    WorkQueue<OpenPair> open;                 ///< left to single segments; has room for all

    /// Takes pairs until none is left: any number of groups does all the work.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t /*i*/, Workspace& space) const {
        bool has_blocks = true;
        std::uint32_t next = blocks.take(group, 1);
        for (;;) {
            if (has_blocks && next >= blocks.size()) {
                has_blocks = false;
                next = listed.take(group, at_once);
            }
            if (!has_blocks && next >= listed.size()) return;
            const Taken taken{has_blocks, next};
            // Asked for before it is needed, because the answer takes its time.
            next = has_blocks ? blocks.take(group, 1) : listed.take(group, at_once);
            decide(group, taken, space);
        }
    }

 private:
    /// Lists of clusters that are taken together.
    static constexpr std::uint32_t at_once = 4;

    /// A block, or some clusters, by their place in the queue.
    struct Taken {
        bool is_block;
        std::uint32_t at;
    };

    /// What is known of a batch.
    struct Progress {
        LaneGroup::PerLane<std::uint32_t> lit;  ///< lane k: luxels of pair k that no triangle hides
        std::uint32_t dark = 0;                 ///< bit k: no luxel of pair k is lit
        std::uint32_t list = 0;                 ///< the pair whose triangles come next
        PlaneRange planes;                      ///< of its triangles that are partial
    };

    /// Decides what was taken, as many clusters at a time as a batch holds. Clusters of a block may
    /// have no luxel: none is lit, whatever triangles do to their pyramids.
    MIR_HD void decide(const LaneGroup& group, Taken taken, Workspace& space) const {
        const std::uint32_t end = taken.at + at_once;
        const std::uint32_t count = taken.is_block        ? block_luxels / cluster_luxels
                                    : end < listed.size() ? at_once
                                                          : listed.size() - taken.at;
        for (std::uint32_t k = 0; k < count;) {
            ListBatch batch;
            if (taken.is_block)
                share_list(group, pool, blocks.items[taken.at], k, batch, space.triangles);
            else
                unpack_lists(group, bvh, pool, listed.items + taken.at + k, count - k, batch,
                             space.triangles);
            k += batch.lists > 0 ? batch.lists : 1;
            if (batch.lists > 0)
                decide(group, batch, space);
            else
                static_cast<void>(open.append(group, 1u, [&](std::uint32_t lane) {
                    return OpenPair{batch.clusters[lane], batch.vpls[lane]};
                }));
        }
    }

    /// Decides the pairs of a batch.
    MIR_HD void decide(const LaneGroup& group, const ListBatch& batch, Workspace& space) const {
        Progress progress;
        LaneGroup::PerLane<std::uint32_t> before;
        group.each([&](std::uint32_t lane) {
            if (lane >= batch.lists) return;
            before[lane] = word_of(batch, lane);
            progress.lit[lane] = before[lane];
            space.pyramids[lane] = make_pyramid(clusters[batch.clusters[lane]],
                                                vpls[batch.vpls[lane]].position, sigma);
        });
        for (std::uint32_t first = 0; first < batch.triangles;)
            first = test(group, batch, first, progress, space);
        group.each([&](std::uint32_t lane) {
            if (lane >= batch.lists) return;
            const bool is_dark = (progress.dark >> lane & 1u) != 0;
            const std::uint32_t lit = is_dark ? 0 : progress.lit[lane];
            if (lit != before[lane]) word_of(batch, lane) = lit;
        });
    }

    [[nodiscard]] MIR_HD std::uint32_t& word_of(const ListBatch& batch, std::uint32_t lane) const {
        return words[std::size_t{batch.clusters[lane]} * vpls.size() + batch.vpls[lane]];
    }

    /// Tests the triangles from `first` on, one per lane. Ends the pairs whose last one is among
    /// them. Returns which one is next.
    MIR_HD std::uint32_t test(const LaneGroup& group, const ListBatch& batch, std::uint32_t first,
                              Progress& progress, Workspace& space) const {
        const LaneGroup::PerLane<std::uint32_t> list = batch.lists_from(group, first);
        LaneGroup::PerLane<Occlusion> found;
        LaneGroup::PerLane<ShadowPlanes> planes;
        LaneGroup::PerLane<std::uint32_t> triangle;
        group.each([&](std::uint32_t lane) {
            // Lanes without a triangle test another's, so that all have planes.
            const bool is_own = first + lane < batch.triangles;
            triangle[lane] = space.triangles[is_own ? first + lane : first];
            Pyramid pyramid = space.pyramids[is_own ? list[lane] : progress.list];
            pyramid.sigma = sigma;  // which all lanes know
            found[lane] = occlusion(bvh.exact.triangles[triangle[lane]], pyramid, planes[lane]);
            if (!is_own) found[lane] = Occlusion::none;
        });
        const std::uint32_t full =
            group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::full; });
        const std::uint32_t partial =
            group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::partial; });
        if (progress.planes.end + LaneGroup::count(partial) > KeptPlanes::capacity) {
            ask(group, batch, progress, space);
            progress.planes = {};
        }
        const std::uint32_t first_kept = progress.planes.end;
        group.each([&](std::uint32_t lane) {
            if ((partial >> lane & 1u) == 0) return;
            const std::uint32_t at = first_kept + LaneGroup::count_before(partial, lane);
            space.planes.put(at,
                             in_margins(planes[lane], OcclusionMargins::plane * sigma,
                                        OcclusionMargins::hit_share),
                             triangle[lane]);
        });
        return end_lists(group, batch, first, full, partial, progress, space);
    }

    /// Ends the pairs whose last triangle is among the 32 from `first` on. Bits of `full` and
    /// `partial` tell what those do. Returns the first triangle that is left.
    MIR_HD std::uint32_t end_lists(const LaneGroup& group, const ListBatch& batch,
                                   std::uint32_t first, std::uint32_t full, std::uint32_t partial,
                                   Progress& progress, Workspace& space) const {
        for (;;) {
            const std::uint32_t end = group.broadcast(batch.ends, progress.list);
            const std::uint32_t its = LaneGroup::bits(0, end - first);
            progress.planes.end += LaneGroup::count(partial & its);
            if ((full & its) != 0) progress.dark |= 1u << progress.list;
            const bool is_dark = (progress.dark >> progress.list & 1u) != 0;
            if (end > first + LaneGroup::width && !is_dark) return first + LaneGroup::width;
            if (!is_dark) ask(group, batch, progress, space);
            progress.planes.first = progress.planes.end;
            if (++progress.list == batch.lists) return batch.triangles;
            if (end >= first + LaneGroup::width) {
                progress.planes = {};
                return end;
            }
            full &= ~its;
            partial &= ~its;
        }
    }

    /// Which luxels of the pair that comes next its planes leave lit.
    MIR_HD void ask(const LaneGroup& group, const ListBatch& batch, Progress& progress,
                    const Workspace& space) const {
        if (progress.planes.empty()) return;
        const std::uint32_t cluster = group.broadcast(batch.clusters, progress.list);
        PairSegments segments(group, hits, cluster * cluster_luxels, space.pyramids[progress.list]);
        const std::uint32_t lit =
            segments.lit_behind(space.planes, progress.planes, bvh.exact.triangles,
                                group.broadcast(progress.lit, progress.list));
        group.each([&](std::uint32_t lane) {
            if (lane == progress.list) progress.lit[lane] = lit;
        });
        if (lit == 0) progress.dark |= 1u << progress.list;
    }
};

}  // namespace mir
