// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_traverse.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/shaft/exact/pair_search.hpp"

namespace mir {

/// What the searches of the cascade may cost.
struct ShaftLimits {
    SearchLimits block{48, 48};    ///< for 256 luxels and a VPL
    SearchLimits cluster{96, 24};  ///< for 32 luxels and a VPL
};

/// Nobody is told what became of pairs.
struct UnwatchedPairs {
    /// Of 256 luxels and a VPL.
    MIR_HD void block(PairState) const {}
    /// Of 32 luxels and a VPL.
    MIR_HD void cluster(PairState) const {}
};

/// Which luxels face and see which VPL, by shafts: kernel over blocks times VPLs; index i is VPL
/// i % vpls.size() and the 256 luxels of block i / vpls.size(), so that blocks times VPLs must fit
/// into 32 bits. Each call writes the eight words of its pair as VisibilityWords lays them out,
/// with the bits of VisibilityPass over the same hierarchy: no order of luxels and no limit changes
/// one. `watch` is told what became of each pair with a luxel to decide, block(state) and
/// cluster(state), from whatever thread.
///
/// First the 256 luxels at once; then, unless that settles it, each 32 of them, by the triangles
/// that were found if they are all that there are; then the luxels one by one, by the triangles
/// that are left or through the hierarchy.
template <Space S, VplSet P, class Watch = UnwatchedPairs>
struct ShaftPass {
    /// Words of visibility of a block and a VPL.
    static constexpr std::uint32_t block_words = block_luxels / cluster_luxels;

    SoaView<const Hit> hits;  ///< in cluster order, padded to whole blocks with empty luxels
    const ClusterRecord* blocks = nullptr;    ///< of 256 luxels
    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;                                   ///< all of the set
    WideBvhView<S> bvh;                       ///< of the scene
    float sigma = 0.0f;                       ///< of the scene, metres, as for the records
    ShaftLimits limits;              ///< of the searches; change how long they take and no bit
    std::uint32_t* words = nullptr;  ///< as VisibilityWords; all are written
    Watch watch;                     ///< told what became of pairs; called through const

    /// Pair `i`: block i / vpls.size() and VPL i % vpls.size().
    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t block = i / vpls.size();
        const VplIndex j = i % vpls.size();
        const Vpl vpl = vpls[j];
        BlockWords mask = facing(block, vpl);
        if (mask.any()) decide_block(block, vpl.position, mask);
        for (std::uint32_t k = 0; k < block_words; ++k)
            words[(std::size_t{block} * block_words + k) * vpls.size() + j] = mask.word[k];
    }

 private:
    struct BlockWords {
        std::uint32_t word[block_words] = {};

        [[nodiscard]] MIR_HD bool any() const {
            std::uint32_t bits = 0;
            for (const std::uint32_t w : word) bits |= w;
            return bits != 0;
        }
    };

    /// Bits of the luxels of a word for which `keep` is true, among those set in `word`.
    template <class Keep>
    [[nodiscard]] MIR_HD std::uint32_t filter(std::uint32_t word, std::uint32_t cluster,
                                              const Keep& keep) const {
        std::uint32_t kept = 0;
        for (std::uint32_t k = 0; k < cluster_luxels; ++k)
            if ((word >> k & 1u) != 0 && keep(hits.load(cluster * cluster_luxels + k)))
                kept |= 1u << k;
        return kept;
    }

    [[nodiscard]] MIR_HD BlockWords facing(std::uint32_t block, const Vpl& vpl) const {
        BlockWords mask;
        for (std::uint32_t k = 0; k < block_words; ++k)
            mask.word[k] = filter(~0u, block * block_words + k,
                                  [&](const Hit& hit) { return faces(hit, vpl); });
        return mask;
    }

    MIR_HD void decide_block(std::uint32_t block, Vec3 apex, BlockWords& mask) const {
        CandidateList list;
        const PairState state = search_pair(bvh, blocks[block], apex, sigma, limits.block, list);
        watch.block(state);
        if (state == PairState::clear) return;
        for (std::uint32_t k = 0; k < block_words; ++k) {
            if (state == PairState::covered) mask.word[k] = 0;
            if (mask.word[k] == 0) continue;
            const std::uint32_t cluster = block * block_words + k;
            mask.word[k] = state == PairState::listed
                               ? decide_listed(cluster, apex, mask.word[k], list)
                               : decide_unknown(cluster, apex, mask.word[k]);
        }
    }

    [[nodiscard]] MIR_HD std::uint32_t decide_listed(std::uint32_t cluster, Vec3 apex,
                                                     std::uint32_t word,
                                                     const CandidateList& known) const {
        CandidateList list;
        return decide(narrow_pair(bvh, clusters[cluster], apex, sigma, known, list), cluster, apex,
                      word, list);
    }

    [[nodiscard]] MIR_HD std::uint32_t decide_unknown(std::uint32_t cluster, Vec3 apex,
                                                      std::uint32_t word) const {
        CandidateList list;
        return decide(search_pair(bvh, clusters[cluster], apex, sigma, limits.cluster, list),
                      cluster, apex, word, list);
    }

    [[nodiscard]] MIR_HD std::uint32_t decide(PairState state, std::uint32_t cluster, Vec3 apex,
                                              std::uint32_t word, const CandidateList& list) const {
        watch.cluster(state);
        if (state == PairState::clear) return word;
        if (state == PairState::covered) return 0;
        if (state == PairState::listed)
            return filter(word, cluster,
                          [&](const Hit& hit) { return !is_hit_by(list, apex, hit.position); });
        return filter(word, cluster,
                      [&](const Hit& hit) { return !is_hidden(bvh, apex, hit.position); });
    }

    [[nodiscard]] MIR_HD bool is_hit_by(const CandidateList& list, Vec3 apex, Vec3 luxel) const {
        for (std::uint32_t i = 0; i < list.size; ++i)
            if (hits_segment(bvh.triangles[list.triangle[i]], apex, luxel)) return true;
        return false;
    }
};

}  // namespace mir
