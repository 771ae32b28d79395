// SPDX-License-Identifier: MIT
#pragma once

#include "accel/hard_segments.hpp"
#include "conformance/worlds.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/host/wide_build.hpp"
#include "shaft/cluster_draws.hpp"
#include "support/shafts/cluster_order.hpp"
#include "support/shafts/pair_tally.hpp"
#include "support/shafts/shaft_pass.hpp"
#include "support/soa_run.hpp"

#include <algorithm>
#include <bit>

namespace mirtest {

/// Luxels and VPLs of a world.
struct Lit {
    std::vector<mir::Hit> luxels;
    std::vector<mir::Vpl> vpls;
};

inline std::vector<mir::Vpl> random_vpls(const mir::WorldGeometry& g, std::uint32_t count,
                                         mir::Random& random) {
    std::vector<mir::Vpl> vpls;
    for (std::uint32_t i = 0; i < count; ++i) {
        const mir::Hit h = random_hit(g, random);
        vpls.push_back({h.position, h.normal, {1.0f, 1.0f, 1.0f}});
    }
    return vpls;
}

/// Luxels in patches on triangles, some of them empty, and VPLs on triangles too, some of them
/// where a luxel is.
inline Lit random_lit(const mir::WorldGeometry& g, std::uint32_t luxels, std::uint32_t vpls,
                      mir::Random random) {
    Lit lit;
    while (lit.luxels.size() < luxels) {
        const mir::Hit centre = random_hit(g, random);
        const float size = 0.1f * g.bounds().diagonal() * random.next() * random.next();
        for (std::uint32_t i = 0; i < mir::block_luxels && lit.luxels.size() < luxels; ++i)
            lit.luxels.push_back(chance(random, 0.05f) ? mir::Hit{}
                                                       : hit_beside(centre, size, random));
    }
    lit.vpls = random_vpls(g, vpls, random);
    for (std::size_t j = 0; j < lit.vpls.size(); j += 7)
        if (!lit.luxels.empty()) lit.vpls[j].position = lit.luxels[j % luxels].position;
    return lit;
}

/// A world with its hierarchy, luxels and VPLs, ready for ShaftPass.
class ShaftStage {
 public:
    /// Luxels in the order in which they are given, padded with empty ones.
    ShaftStage(const mir::WorldGeometry& geometry, Lit lit, const mir::WideBvhOptions& options = {})
        : bvh_(mir::build_wide_bvh(geometry, executor_, options)),
          sigma_(float_sigma(mir::magnitude_of(geometry.bounds()))),
          lit_(std::move(lit)) {
        const std::size_t blocks = (lit_.luxels.size() + mir::block_luxels - 1) / mir::block_luxels;
        lit_.luxels.resize(blocks * mir::block_luxels);
        hits_ = HitRun(lit_.luxels);
        make_records(mir::block_luxels, blocks_);
        make_records(mir::cluster_luxels, clusters_);
    }

    /// Words by shafts. They start as ones, which no forgotten word may keep.
    [[nodiscard]] std::vector<std::uint32_t> by_shafts(const mir::ShaftLimits& limits = {}) const {
        return run(limits, mir::UnwatchedPairs{});
    }
    [[nodiscard]] std::vector<std::uint32_t> by_shafts(const mir::ShaftLimits& limits,
                                                       mir::PairTally& tally) const {
        return run(limits, mir::TallyPairs{&tally});
    }

    /// Words luxel by luxel: `hidden(vpl, luxel)` is asked for all that face each other.
    template <class Hidden>
    [[nodiscard]] std::vector<std::uint32_t> one_by_one(const Hidden& hidden) const {
        std::vector<std::uint32_t> words(word_count(), 0u);
        for (std::size_t i = 0; i < lit_.luxels.size(); ++i)
            for (std::size_t j = 0; j < lit_.vpls.size(); ++j) {
                const mir::Hit& hit = lit_.luxels[i];
                const mir::Vpl& vpl = lit_.vpls[j];
                if (mir::faces(hit, vpl) && !hidden(vpl.position, hit.position))
                    words[i / 32 * lit_.vpls.size() + j] |= 1u << (i % 32);
            }
        return words;
    }

    /// The truth: every triangle is asked.
    [[nodiscard]] std::vector<std::uint32_t> by_brute_force() const {
        return one_by_one([&](mir::Vec3 q, mir::Vec3 p) {
            return std::any_of(bvh_.triangles().begin(), bvh_.triangles().end(),
                               [&](const auto& rows) { return mir::hits_segment(rows, q, p); });
        });
    }

    /// Segment by segment through the same hierarchy.
    [[nodiscard]] std::vector<std::uint32_t> by_segments() const {
        return one_by_one([&](mir::Vec3 q, mir::Vec3 p) { return is_hidden(bvh_.view(), q, p); });
    }

    [[nodiscard]] const mir::WideBvh& bvh() const { return bvh_; }
    [[nodiscard]] mir::SoaView<const mir::Hit> hits() const { return hits_.view(); }
    [[nodiscard]] float sigma() const { return sigma_; }
    [[nodiscard]] const Lit& lit() const { return lit_; }
    [[nodiscard]] const std::vector<mir::ClusterRecord>& clusters() const { return clusters_; }

 private:
    using Vpls = mir::VplSpan<mir::Space::host>;
    static_assert(mir::DeviceCopyable<mir::ShaftPass<mir::Space::host, Vpls>>);

    template <class Watch>
    [[nodiscard]] std::vector<std::uint32_t> run(const mir::ShaftLimits& limits,
                                                 Watch watch) const {
        std::vector<std::uint32_t> words(word_count(), ~0u);
        const mir::ShaftPass<mir::Space::host, Vpls, Watch> pass{
            hits_.view(), blocks_.data(), clusters_.data(), mir::span_of(lit_.vpls),
            bvh_.view(),  sigma_,         limits,           words.data(),
            watch};
        for (std::uint32_t i = 0; i < blocks_.size() * lit_.vpls.size(); ++i) pass(i);
        return words;
    }
    [[nodiscard]] std::size_t word_count() const {
        return lit_.luxels.size() / mir::cluster_luxels * lit_.vpls.size();
    }
    void make_records(std::uint32_t run, std::vector<mir::ClusterRecord>& records) const {
        records.resize(lit_.luxels.size() / run);
        const mir::ClusterRecords kernel{hits_.view(), run, sigma_, records.data()};
        for (std::uint32_t i = 0; i < records.size(); ++i) kernel(i);
    }

    mir::InlineExecutor executor_;
    mir::WideBvh bvh_;
    float sigma_ = 0.0f;
    Lit lit_;
    HitRun hits_{{}};
    std::vector<mir::ClusterRecord> blocks_;
    std::vector<mir::ClusterRecord> clusters_;
};

/// Bits that differ.
inline std::size_t different_bits(const std::vector<std::uint32_t>& a,
                                  const std::vector<std::uint32_t>& b) {
    std::size_t bits = a.size() == b.size() ? 0 : 32;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        bits += static_cast<std::size_t>(std::popcount(a[i] ^ b[i]));
    return bits;
}

/// Luxels moved into cluster order.
inline Lit clustered(const Lit& lit) {
    mir::InlineExecutor executor;
    const HitRun run(lit.luxels);
    Lit moved{{}, lit.vpls};
    for (const std::uint32_t i : mir::cluster_order(run.view(), {}, executor))
        moved.luxels.push_back(lit.luxels[i]);
    return moved;
}

/// Sixty triangles, or sixty needles, of that size, moved aside.
inline World soup(bool needles, float scale = 1.0f, float x = 0.0f) {
    const mir::Vec3 move(x, 0.3f * x, -x);
    return needles ? needle_soup(60, 17, scale, move) : triangle_soup(60, 18, scale, move);
}

/// A world with random luxels in cluster order, and random VPLs.
inline ShaftStage stage_of(const World& world, std::uint32_t luxels, std::uint32_t vpls,
                           std::uint64_t seed = 19) {
    return {world.geometry, clustered(random_lit(world.geometry, luxels, vpls, test_random(seed)))};
}

}  // namespace mirtest
