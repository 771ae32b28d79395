// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/quantised_bvh.hpp"
#include "mir/shaft/device/leaf_search.hpp"
#include "shaft/queued_work.hpp"
#include "shaft/shaft_stage.hpp"

#include <algorithm>

namespace mirtest {

/// A stage as the kernels of a backend find it, with the truth about its pairs: which triangles
/// hide which luxels.
class SearchedStage {
 public:
    using Vpls = mir::VplSpan<mir::Space::host>;

    /// The stage must outlive this.
    explicit SearchedStage(const ShaftStage& stage)
        : stage_(stage),
          boxes_(stage.bvh().nodes().size()),
          links_(boxes_.size()),
          blocks_(stage.hits().stride / mir::block_luxels),
          facing_(stage.one_by_one([](mir::Vec3, mir::Vec3) { return false; })) {
        const mir::QuantiseNodes<mir::Space::host> quantise{stage.bvh().view(), boxes_.data(),
                                                            links_.data()};
        for (std::uint32_t i = 0; i < boxes_.size(); ++i) quantise(i);
        const mir::ClusterRecords records{stage.hits(), mir::block_luxels, stage.sigma(),
                                          blocks_.data()};
        for (std::uint32_t i = 0; i < blocks_.size(); ++i) records(i);
    }

    [[nodiscard]] const ShaftStage& stage() const { return stage_; }
    [[nodiscard]] mir::QuantisedBvhView<mir::Space::host> bvh() const {
        return {stage_.bvh().view(), boxes_.data(), links_.data()};
    }
    [[nodiscard]] const std::vector<mir::ClusterRecord>& blocks() const { return blocks_; }
    [[nodiscard]] Vpls vpls() const { return mir::span_of(stage_.lit().vpls); }
    [[nodiscard]] std::uint32_t block_count() const {
        return static_cast<std::uint32_t>(blocks_.size());
    }
    [[nodiscard]] std::uint32_t triangles() const {
        return static_cast<std::uint32_t>(stage_.bvh().triangles().size());
    }

    /// Words of the luxels that face a VPL.
    [[nodiscard]] const std::vector<std::uint32_t>& facing() const { return facing_; }
    [[nodiscard]] std::uint32_t facing(mir::OpenPair pair) const { return facing_[place(pair)]; }
    /// Where the word of 32 luxels and a VPL is.
    [[nodiscard]] std::size_t place(mir::OpenPair pair) const {
        return std::size_t{pair.cluster} * vpls().size() + pair.vpl;
    }

    /// Facing luxels of a pair of 32 that a triangle, by its place in the hierarchy, hides.
    [[nodiscard]] std::uint32_t hidden_by(std::uint32_t triangle, mir::OpenPair pair) const {
        const mir::TriangleRows& rows = stage_.bvh().triangles()[triangle];
        std::uint32_t hidden = 0;
        for (std::uint32_t left = facing(pair); left != 0; left &= left - 1) {
            const std::uint32_t k = mir::LaneGroup::lowest(left);
            const mir::Hit& hit = stage_.lit().luxels[pair.cluster * mir::cluster_luxels + k];
            if (mir::hits_segment(rows, vpls()[pair.vpl].position, hit.position)) hidden |= 1u << k;
        }
        return hidden;
    }
    /// Places of all triangles that hide one of a pair of 32.
    [[nodiscard]] std::vector<std::uint32_t> hiding(mir::OpenPair pair) const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t t = 0; t < triangles(); ++t)
            if (hidden_by(t, pair) != 0) found.push_back(t);
        return found;
    }

    /// The pairs of 32 that one of 256 has.
    [[nodiscard]] static std::vector<mir::OpenPair> parts(mir::OpenPair block) {
        constexpr std::uint32_t count = mir::block_luxels / mir::cluster_luxels;
        std::vector<mir::OpenPair> pairs;
        for (std::uint32_t k = 0; k < count; ++k)
            pairs.push_back({block.cluster * count + k, block.vpl});
        return pairs;
    }
    /// Whether a luxel of a pair of 256 faces.
    [[nodiscard]] bool is_faced(mir::OpenPair block) const {
        const std::vector<mir::OpenPair> all = parts(block);
        return std::any_of(all.begin(), all.end(),
                           [&](mir::OpenPair part) { return facing(part) != 0; });
    }
    /// Places of all triangles that hide a luxel of a pair of 256.
    [[nodiscard]] std::vector<std::uint32_t> hiding_in_block(mir::OpenPair block) const {
        std::vector<std::uint32_t> found;
        for (const mir::OpenPair& part : parts(block))
            for (const std::uint32_t t : hiding(part)) found.push_back(t);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }
    /// Whether one triangle by itself hides all luxels of a pair of 256 that face.
    [[nodiscard]] bool is_covered(mir::OpenPair block) const {
        const std::vector<mir::OpenPair> all = parts(block);
        const auto hides_all = [&](std::uint32_t t) {
            return std::all_of(all.begin(), all.end(), [&](mir::OpenPair part) {
                return hidden_by(t, part) == facing(part);
            });
        };
        const std::vector<std::uint32_t> some = hiding_in_block(block);
        return std::any_of(some.begin(), some.end(), hides_all);
    }
    /// Whether the luxels of a record or a VPL lie where no search is proved right.
    [[nodiscard]] bool is_beyond_reach(const mir::ClusterRecord& run, std::uint32_t vpl) const {
        const float reach = stage_.bvh().view().reach;
        return !mir::within_reach(run, reach) || !mir::within_reach(vpls()[vpl].position, reach);
    }

    /// Places of the triangles in the leaves of a list of MetLeaves, by the nodes themselves; none
    /// when one of them is no node.
    [[nodiscard]] std::vector<std::uint32_t> triangles_of(const std::uint32_t* leaves,
                                                          std::uint32_t count) const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t i = 0; i < count; ++i) {
            const mir::MetLeaves met{leaves[i]};
            if (met.node() >= stage_.bvh().nodes().size()) return {};
            const mir::WideNode& node = stage_.bvh().nodes()[met.node()];
            for (std::uint32_t left = met.slots(); left != 0; left &= left - 1) {
                const std::uint32_t k = mir::LaneGroup::lowest(left);
                for (std::int32_t t = 0; t < node.count[k]; ++t)
                    found.push_back(node.ref[k] + static_cast<std::uint32_t>(t));
            }
        }
        return found;
    }

 private:
    const ShaftStage& stage_;
    std::vector<mir::QuantisedNode> boxes_;
    std::vector<mir::NodeLinks> links_;
    std::vector<mir::ClusterRecord> blocks_;
    std::vector<std::uint32_t> facing_;
};

/// Random luxels and VPLs, half of which lie in front of surfaces: boxes of leaves are coarse, and
/// a shaft that touches a surface nearly always meets one.
inline Lit lit_in_space(const World& world, std::uint32_t luxels, std::uint32_t vpls) {
    Lit lit = random_lit(world.geometry, luxels, vpls, test_random(31));
    for (std::size_t i = 0; i < lit.luxels.size(); ++i)
        if (i / mir::block_luxels % 2 == 0) lit.luxels[i].position += 0.2f * lit.luxels[i].normal;
    for (std::size_t j = 0; j < lit.vpls.size(); j += 2)
        lit.vpls[j].position += 0.2f * lit.vpls[j].normal;
    return clustered(lit);
}

/// Random luxels and VPLs, some of which lie far outside of the scene.
inline Lit lit_beyond_reach(const World& world, std::uint32_t luxels, std::uint32_t vpls) {
    Lit lit = random_lit(world.geometry, luxels, vpls, test_random(30));
    for (std::size_t i = 0; i < 2 * mir::block_luxels; ++i) lit.luxels[i].position *= 40.0f;
    for (std::size_t j = 0; j < lit.vpls.size(); j += 4) lit.vpls[j].position *= 40.0f;
    return lit;
}

/// Whether every item of `some` is among those of `all`.
inline bool are_among(std::vector<std::uint32_t> some, std::vector<std::uint32_t> all) {
    std::sort(some.begin(), some.end());
    std::sort(all.begin(), all.end());
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

}  // namespace mirtest
