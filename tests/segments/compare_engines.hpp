// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/backend.hpp"
#include "support/packet_points.hpp"
#include "support/random_segments.hpp"
#include "support/segment_bits.hpp"
#include "support/segment_judge.hpp"

#include <bit>

namespace mirtest {

/// Segments of some kinds for which a kd-tree and another engine have different answers, and what
/// double precision says about them.
struct Disagreements {
    std::uint64_t asked = 0;
    std::uint64_t hidden = 0;  ///< by the kd-tree
    std::uint64_t different = 0;
    std::uint64_t at_ends = 0;      ///< decided by the distance of an end from a plane
    std::uint64_t tree_right = 0;   ///< double precision sides with the kd-tree
    std::uint64_t tree_wrong = 0;   ///< beyond rounding
    std::uint64_t other_wrong = 0;  ///< beyond the rounding that a kd-tree may have
    double farthest_tie = 0.0;      ///< largest |margin| within rounding

    void settle(const Judgement& truth, bool tree_says_hidden) {
        ++different;
        const bool tree_agrees = truth.hidden() == tree_says_hidden;
        at_ends += truth.at_end ? 1 : 0;
        tree_right += tree_agrees ? 1 : 0;
        if (truth.within_rounding())
            farthest_tie = std::max(farthest_tie, std::fabs(truth.margin));
        else
            ++(tree_agrees ? other_wrong : tree_wrong);
    }
    [[nodiscard]] double rate() const {
        return static_cast<double>(different) / static_cast<double>(asked);
    }
};

/// What a comparison of engines over one scene found.
struct Comparison {
    std::uint64_t wrong_in_packets = 0;  ///< answers of packets unlike those of single segments
    Disagreements generic;               ///< kinds that meet edges by chance
    Disagreements aimed;
    Disagreements in_plane;

    [[nodiscard]] Disagreements& of(SegmentKind kind) {
        return is_generic(kind) ? generic : kind == SegmentKind::aimed ? aimed : in_plane;
    }
    [[nodiscard]] std::uint64_t tree_wrong() const {
        return generic.tree_wrong + aimed.tree_wrong + in_plane.tree_wrong;
    }
};

/// The words of segment_bits(), asked in packets of the sixteen segments with one origin.
template <mir::PacketVisibility V, mir::Executor E>
std::vector<std::uint32_t> packet_bits(const V& visibility, std::span<const SegmentEnds> segments,
                                       E& executor) {
    std::vector<std::uint32_t> words(segments.size() / 32);
    executor.for_each(words.size(), [&](std::size_t w) {
        for (std::uint32_t half = 0; half < 2; ++half) {
            const SegmentEnds* packet = &segments[w * 32 + half * 16];
            mir::PointPacket points;
            for (std::uint32_t k = 0; k < 16; ++k) set_point(points, k, packet[k].to);
            words[w] |= visibility.visible_packet(packet->from, points, 0xFFFF) << 16 * half;
        }
    });
    return words;
}

/// Asks a kd-tree, one by one and in packets, and another engine for the first `count` segments,
/// and settles each disagreement in double precision.
template <mir::PacketVisibility Tree, mir::Visibility Other, mir::Executor E>
Comparison compare_engines(const mir::WorldGeometry& geometry, const Tree& tree, const Other& other,
                           std::uint64_t count, E& executor) {
    constexpr std::uint64_t batch = std::uint64_t{1} << 20;
    const RandomSegments random(geometry);
    const SegmentJudge judge(geometry);
    const mir::host::Backend backend(executor);
    Comparison found;
    for (std::uint64_t first = 0; first < count; first += batch) {
        const auto segments = random.make(first, std::min(batch, count - first), executor);
        const auto by_tree = segment_bits(backend, tree, segments);
        const auto by_other = segment_bits(backend, other, segments);
        const auto in_packets = packet_bits(tree, segments, executor);
        std::vector<std::size_t> different;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const auto bit = [&](const auto& words) { return (words[i / 32] >> i % 32 & 1u) != 0; };
            Disagreements& kind = found.of(RandomSegments::kind_of(first + i));
            ++kind.asked;
            kind.hidden += bit(by_tree) ? 0 : 1;
            found.wrong_in_packets += bit(in_packets) != bit(by_tree) ? 1 : 0;
            if (bit(by_other) != bit(by_tree)) different.push_back(i);
        }
        std::vector<Judgement> truths(different.size());
        executor.for_each(different.size(),
                          [&](std::size_t d) { truths[d] = judge.judge(segments[different[d]]); });
        for (std::size_t d = 0; d < different.size(); ++d) {
            const std::size_t i = different[d];
            found.of(RandomSegments::kind_of(first + i))
                .settle(truths[d], (by_tree[i / 32] >> i % 32 & 1u) == 0);
        }
    }
    return found;
}

}  // namespace mirtest
