// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/scenes.hpp"
#include "segments/compare_engines.hpp"
#include "support/catch.hpp"
#include "support/fused_visibility.hpp"

#include <map>

// Bugs that the comparison of engines over random segments has to notice.

namespace {

using mirtest::SegmentEnds;

constexpr std::uint64_t segments = 20096;

/// The paper's sphere with all that is asked about it.
struct SphereRoom {
    mirtest::World world{mir::builtin::make("sphere")};
    mir::KdTreeScene tree{world.geometry};
    mir::cpu::EmbreeScene embree{world.geometry};

    template <mir::PacketVisibility V>
    [[nodiscard]] mirtest::Comparison compare(const V& visibility) const {
        mir::InlineExecutor executor;
        return mirtest::compare_engines(world.geometry, visibility, embree.visibility(), segments,
                                        executor);
    }
    [[nodiscard]] std::vector<SegmentEnds> random_segments() const {
        mir::InlineExecutor executor;
        return mirtest::RandomSegments(world.geometry).make(0, segments, executor);
    }
};

/// Leaf visitor that remembers which leaf hid the segment.
struct RememberLeaf {
    const mir::KdTreeView<mir::Space::host>& tree;
    SegmentEnds s;
    std::uint32_t first_reference = 0;

    bool operator()(mir::KdNode leaf, float) {
        first_reference = leaf.first();
        return mir::detail::any_hides(tree, leaf, s.from, s.to);
    }
};

/// Number of the first reference of the leaf that hides most segments.
std::uint32_t busiest_leaf(const mir::KdTreeView<mir::Space::host>& tree,
                           const std::vector<SegmentEnds>& asked) {
    std::map<std::uint32_t, std::size_t> hidden;
    for (const SegmentEnds& s : asked) {
        RememberLeaf leaf{tree, s};
        if (mir::detail::walk(tree, s.from, s.to, leaf)) ++hidden[leaf.first_reference];
    }
    return std::max_element(hidden.begin(), hidden.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

/// Packets whose last lane is switched off.
struct LosesLane : mir::KdTreeVisibility<mir::Space::host> {
    [[nodiscard]] std::uint32_t visible_packet(mir::Vec3 origin, const mir::PointPacket& points,
                                               std::uint32_t active) const {
        return mir::visible_in_packet(tree, origin, points, active & 0x7FFF);
    }
};

}  // namespace

TEST_CASE("A kd-tree that lost the triangles of one leaf is convicted") {
    const SphereRoom room;
    auto view = room.tree.tree().view();
    const std::uint32_t lost = busiest_leaf(view, room.random_segments());
    std::vector<mir::KdNode> nodes(room.tree.tree().nodes().begin(),
                                   room.tree.tree().nodes().end());
    for (mir::KdNode& n : nodes)
        if (n.is_leaf() && n.first() == lost) n = mir::KdNode::leaf(lost, 0);
    view.nodes = nodes.data();
    CHECK(room.compare(room.tree.visibility()).tree_wrong() == 0);
    CHECK(room.compare(mir::KdTreeVisibility<mir::Space::host>{view}).tree_wrong() > 0);
}

TEST_CASE("Packets that lose a lane are noticed") {
    const SphereRoom room;
    CHECK(room.compare(LosesLane{room.tree.visibility()}).wrong_in_packets > 0);
}

TEST_CASE("One fused product changes some bits of random segments") {
    const SphereRoom room;
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    const auto asked = room.random_segments();
    const auto right = mirtest::segment_bits(backend, room.tree.visibility(), asked);
    const mirtest::FusedVisibility<mir::Space::host> fused{room.tree.tree().view()};
    CHECK(mirtest::segment_bits(backend, fused, asked) != right);
}
