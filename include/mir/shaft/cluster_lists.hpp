// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/kept_forms.hpp"
#include "mir/shaft/list_batch.hpp"
#include "mir/shaft/occlusion.hpp"

namespace mir {

/// Decides pairs of 32 luxels and a VPL by the leaves that their shafts meet: kernel for groups, a
/// few pairs at a time. First a triangle per lane against the pyramid of its pair, then, pair by
/// pair, a luxel per lane against the triangles that are partial. Pairs with too many triangles are
/// queued.
template <Space S, VplSet P>
struct ClusterLists {
    /// As BlockShafts::resident_blocks.
    static constexpr std::uint32_t resident_blocks = 9;

    /// What a group works in: little, because it is taken from the cache of nodes and triangles.
    struct Workspace {
        KeptForms forms;                                     ///< of triangles that are partial
        std::uint32_t partial[KeptForms::capacity];          ///< the same, by place
        std::uint32_t triangles[ListBatch::most_triangles];  ///< of all pairs, by place
        Pyramid pyramids[ListBatch::most_lists];             ///< of the pairs
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
        constexpr std::uint32_t at_once = ListBatch::most_lists;
        const std::uint32_t count = listed.size();
        std::uint32_t next = listed.take(group, at_once);
        while (next < count) {
            std::uint32_t at = next;
            // Asked for before it is needed, because the answer takes its time.
            next = listed.take(group, at_once);
            const std::uint32_t end = at + at_once < count ? at + at_once : count;
            while (at < end) at += decide(group, listed.items + at, end - at, space);
        }
    }

 private:
    /// What is known of a batch.
    struct Progress {
        LaneGroup::PerLane<std::uint32_t> lit;  ///< lane k: luxels of pair k that no triangle hides
        std::uint32_t dark = 0;                 ///< bit k: no luxel of pair k is lit
        std::uint32_t list = 0;                 ///< the pair whose triangles come next
        std::uint32_t first_form = 0;           ///< of that pair
        std::uint32_t end_form = 0;             ///< behind the last one; 0: there are none
    };

    /// Decides the first of `count` pairs and as many of the others as a batch holds; returns how
    /// many.
    MIR_HD std::uint32_t decide(const LaneGroup& group, const ListedPair* lists,
                                std::uint32_t count, Workspace& space) const {
        ListBatch batch;
        unpack_lists(group, bvh, pool, lists, count, batch, space.triangles);
        if (batch.lists == 0) {
            static_cast<void>(open.append(group, 1u, [&](std::uint32_t lane) {
                return OpenPair{batch.clusters[lane], batch.vpls[lane]};
            }));
            return 1;
        }
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
        return batch.lists;
    }

    [[nodiscard]] MIR_HD std::uint32_t& word_of(const ListBatch& batch, std::uint32_t lane) const {
        return words[std::size_t{batch.clusters[lane]} * vpls.size() + batch.vpls[lane]];
    }

    /// Tests the triangles from `first` on, one per lane, and ends the pairs whose last one is
    /// among them. Returns which one is next.
    MIR_HD std::uint32_t test(const LaneGroup& group, const ListBatch& batch, std::uint32_t first,
                              Progress& progress, Workspace& space) const {
        const LaneGroup::PerLane<std::uint32_t> list = batch.lists_from(group, first);
        LaneGroup::PerLane<Occlusion> found;
        LaneGroup::PerLane<SegmentForms> forms;
        LaneGroup::PerLane<std::uint32_t> triangle;
        group.each([&](std::uint32_t lane) {
            // Lanes without a triangle test another's, so that all have forms.
            const bool is_own = first + lane < batch.triangles;
            triangle[lane] = space.triangles[is_own ? first + lane : first];
            Pyramid pyramid = space.pyramids[is_own ? list[lane] : progress.list];
            pyramid.sigma = sigma;  // which all lanes know
            found[lane] = occlusion(bvh.exact.triangles[triangle[lane]], pyramid, forms[lane]);
            if (!is_own) found[lane] = Occlusion::none;
        });
        const std::uint32_t full =
            group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::full; });
        const std::uint32_t partial =
            group.ballot([&](std::uint32_t lane) { return found[lane] == Occlusion::partial; });
        if (progress.end_form + LaneGroup::count(partial) > KeptForms::capacity) {
            ask(group, batch, progress, space);
            progress.first_form = progress.end_form = 0;
        }
        const std::uint32_t first_kept = progress.end_form;
        group.each([&](std::uint32_t lane) {
            if ((partial >> lane & 1u) == 0) return;
            const std::uint32_t at = first_kept + LaneGroup::count_before(partial, lane);
            space.forms.put(at, in_margins(forms[lane], OcclusionMargins::plane * sigma));
            space.partial[at] = triangle[lane];
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
            progress.end_form += LaneGroup::count(partial & its);
            if ((full & its) != 0) progress.dark |= 1u << progress.list;
            const bool is_dark = (progress.dark >> progress.list & 1u) != 0;
            if (end > first + LaneGroup::width && !is_dark) return first + LaneGroup::width;
            if (!is_dark) ask(group, batch, progress, space);
            progress.first_form = progress.end_form;
            if (++progress.list == batch.lists) return batch.triangles;
            if (end >= first + LaneGroup::width) {
                progress.first_form = progress.end_form = 0;
                return end;
            }
            full &= ~its;
            partial &= ~its;
        }
    }

    /// What a lane knows of two luxels, lane % 16 and the one 16 behind it. Lanes 0 to 15 ask the
    /// first half of the forms and the others the second, so that a form is read for two luxels.
    struct Segments {
        Vec3 luxel[2];         ///< metres
        Vec3 end[2];           ///< in the pyramid's local coordinates, metres
        bool is_hit[2];        ///< surely
        std::uint32_t unsure;  ///< bit k: the k-th form from the half's last one leaves one open
    };
    static constexpr std::uint32_t half_width = LaneGroup::width / 2;

    /// The forms of a pair in two halves of the same size: a form in the middle is in both.
    struct Halves {
        std::uint32_t first[2];  ///< place of the first form
        std::uint32_t size;      ///< forms, at least 1

        [[nodiscard]] MIR_HD static Halves of(const Progress& progress) {
            const std::uint32_t size = (progress.end_form - progress.first_form + 1) / 2;
            return {{progress.first_form, progress.end_form - size}, size};
        }
    };

    /// Which luxels of the pair that comes next the forms leave lit. Triangles that are not sure are
    /// asked exactly, and last: by then most of the segments are hidden.
    MIR_HD void ask(const LaneGroup& group, const ListBatch& batch, Progress& progress,
                    const Workspace& space) const {
        if (progress.first_form == progress.end_form) return;
        const Halves halves = Halves::of(progress);
        const std::uint32_t first_luxel =
            cluster_luxels * group.broadcast(batch.clusters, progress.list);
        const Pyramid& pyramid = space.pyramids[progress.list];
        LaneGroup::PerLane<Segments> segments;
        group.each([&](std::uint32_t lane) {
            Segments& s = segments[lane];
            for (std::uint32_t j = 0; j < 2; ++j) {
                s.luxel[j] = hits.load(first_luxel + lane % half_width + j * half_width).position;
                s.end[j] = pyramid.local(s.luxel[j]);
                s.is_hit[j] = false;
            }
            s.unsure = 0;
        });
        group.each([&](std::uint32_t lane) {
            const std::uint32_t first = lane < half_width ? halves.first[0] : halves.first[1];
            for (std::uint32_t k = 0; k < halves.size; ++k)
                ask(space.forms.get(first + k), segments[lane]);
        });
        std::uint32_t lit = group.broadcast(progress.lit, progress.list);
        for (std::uint32_t j = 0; j < 2; ++j) {
            const std::uint32_t hit =
                group.ballot([&](std::uint32_t lane) { return segments[lane].is_hit[j]; });
            lit &= ~(((hit | hit >> half_width) & 0xFFFFu) << j * half_width);
        }
        if (lit != 0) lit = ask_exactly(group, pyramid.apex, halves, segments, lit, space);
        group.each([&](std::uint32_t lane) {
            if (lane == progress.list) progress.lit[lane] = lit;
        });
        if (lit == 0) progress.dark |= 1u << progress.list;
    }

    MIR_HD static void ask(const SureForms& forms, Segments& s) {
        const float first = forms.at(s.end[0]);
        const float second = forms.at(s.end[1]);
        s.is_hit[0] = s.is_hit[0] | (first > 1.0f);
        s.is_hit[1] = s.is_hit[1] | (second > 1.0f);
        const bool is_sure = fminf(fabsf(first), fabsf(second)) > 1.0f;
        s.unsure = 2 * s.unsure + (is_sure ? 0u : 1u);
    }

    /// Luxels of `lit` that are not hit by the triangles that leave segments open either.
    [[nodiscard]] MIR_HD std::uint32_t ask_exactly(const LaneGroup& group, Vec3 apex,
                                                   const Halves& halves,
                                                   const LaneGroup::PerLane<Segments>& segments,
                                                   std::uint32_t lit, const Workspace& space) const {
        for (std::uint32_t h = 0; h < 2; ++h) {
            std::uint32_t asked = group.any_bits([&](std::uint32_t lane) {
                const bool is_asked =
                    lane / half_width == h && (lit >> lane % half_width & 0x10001u) != 0;
                return is_asked ? segments[lane].unsure : 0u;
            });
            for (; asked != 0 && lit != 0; asked &= asked - 1) {
                const std::uint32_t form =
                    halves.first[h] + halves.size - 1 - LaneGroup::lowest(asked);
                const TriangleRows& rows = bvh.exact.triangles[space.partial[form]];
                lit &= group.ballot([&](std::uint32_t lane) {
                    const Segments& s = segments[lane];
                    return (lit >> lane & 1u) != 0 &&
                           !hits_segment(rows, apex, lane < half_width ? s.luxel[0] : s.luxel[1]);
                });
            }
        }
        return lit;
    }
};

}  // namespace mir
