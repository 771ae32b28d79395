// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/host/backend.hpp"
#include "mir/host/wide_bvh_scene.hpp"
#include "mir/shaft/host/shaft_visibility.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/leak_luxels.hpp"

#include <bit>
#include <functional>

// Segments aimed at the edges and vertices of closed surfaces, through the structures themselves.

namespace {

using mir::Vec3;
using mirtest::LeakBlock;

/// Leaf visitor of a kd-tree whose triangles end at their edges: the mistake that must be noticed.
struct FindInsideEdges {
    const mir::KdTreeView<mir::Space::host>& tree;
    mirtest::SegmentEnds s;

    bool operator()(mir::KdNode leaf, float) const {
        for (std::uint32_t i = 0; i != leaf.count(); ++i) {
            const auto& rows = tree.triangles[tree.references[leaf.first() + i]];
            if (mirtest::is_inside_edges(rows, s)) return true;
        }
        return false;
    }
};

/// Segments of a block that pass, one by one.
template <class Passes>
std::size_t count_single(const LeakBlock& block, const Passes& passes) {
    return static_cast<std::size_t>(std::count_if(block.to.begin(), block.to.end(),
                                                  [&](Vec3 to) { return passes(block.from, to); }));
}

/// Segments of a block that pass a tree by packets of sixteen.
template <class Tree>
std::size_t count_packets(const LeakBlock& block, const Tree& tree, mir::InstructionSet set) {
    std::size_t seen = 0;
    mir::run_with(set, [&](auto s) {
        for (std::uint32_t g = 0; g < mir::BlockMask::packets; ++g)
            seen += static_cast<std::size_t>(std::popcount(
                mir::visible_in_packet<s.value>(tree, block.from, block.packet(g), 0xFFFFu)));
    });
    return seen;
}

/// Segments of a block that pass by shafts.
std::size_t count_shafts(const LeakBlock& block, const mir::ShaftVisibility& shafts,
                         mir::InstructionSet set) {
    const mirtest::HitRun luxels(block.luxels());
    mir::BlockMask seen;
    for (std::uint32_t& packet : seen.packet) packet = 0xFFFFu;
    shafts.visible_block(shafts.block(luxels.view(), set), block.from, seen);
    std::size_t count = 0;
    for (const std::uint32_t packet : seen.packet)
        count += static_cast<std::size_t>(std::popcount(packet));
    return count;
}

/// "WHAT by INSTRUCTION SET".
std::string named(std::string what, mir::InstructionSet set) {
    constexpr const char* names[] = {" by every processor's", " by AVX2", " by AVX-512"};
    return what.append(names[static_cast<std::size_t>(set)]);
}

/// The structures over one closed surface.
class Structures {
 public:
    explicit Structures(const mirtest::World& world)
        : tree_(world.geometry),
          bvh_(world.geometry),
          lanes_(mir::make_triangle_lanes(bvh_.tree().triangles())) {}

    /// A way to ask for a block of segments: how many pass.
    struct Way {
        std::string name;
        std::function<std::size_t(const LeakBlock&)> passed;
    };

    /// All ways, of which packets and shafts exist for each instruction set. Valid while this
    /// object stays where it is.
    [[nodiscard]] std::vector<Way> ways() const {
        std::vector<Way> all{{"kd-tree", one_by_one(tree_.tree().view())},
                             {"wide hierarchy", one_by_one(bvh_.tree().view())}};
        for (const mir::InstructionSet set : mirtest::instruction_sets()) {
            all.push_back({named("packets, kd-tree", set), by_packets(tree_.tree().view(), set)});
            all.push_back(
                {named("packets, wide hierarchy", set), by_packets(bvh_.tree().view(), set)});
            all.push_back({named("shafts", set), by_shafts(set)});
        }
        return all;
    }

    /// How many pass where triangles end at their edges. Ends must be within reach.
    [[nodiscard]] std::size_t passed_by_edges(const LeakBlock& block) const {
        const auto tree = tree_.tree().view();
        return count_single(block, [&](Vec3 from, Vec3 to) {
            FindInsideEdges any{tree, {from, to}};
            return !mir::detail::walk(tree, from, to, any);
        });
    }

 private:
    template <class Tree>
    static std::function<std::size_t(const LeakBlock&)> one_by_one(const Tree& tree) {
        return [tree](const LeakBlock& block) {
            return count_single(
                block, [&](Vec3 from, Vec3 to) { return !mir::is_hidden(tree, from, to); });
        };
    }
    template <class Tree>
    static std::function<std::size_t(const LeakBlock&)> by_packets(const Tree& tree,
                                                                   mir::InstructionSet set) {
        return [tree, set](const LeakBlock& block) { return count_packets(block, tree, set); };
    }

    [[nodiscard]] std::function<std::size_t(const LeakBlock&)> by_shafts(
        mir::InstructionSet set) const {
        return [this, set](const LeakBlock& block) {
            const mir::ShaftVisibility shafts{bvh_.tree().view(), lanes_.data(), {}, {}};
            return count_shafts(block, shafts, set);
        };
    }

    mir::KdTreeScene tree_;
    mir::WideBvhScene bvh_;
    std::vector<mir::TriangleLanes> lanes_;
};

/// Asks for so many segments, spread over the balls, in each way.
void check_none_passes(std::size_t segments) {
    const auto& balls = mirtest::leak_balls();
    const std::size_t blocks = segments / (LeakBlock::size * balls.size()) + 1;
    for (const mirtest::BallShape& ball : balls) {
        INFO(ball.name());
        const mirtest::World world = ball.world();
        const Structures structures(world);
        const std::vector<Structures::Way> ways = structures.ways();
        std::vector<std::size_t> passed(ways.size());
        mirtest::LeakBlocks leaks(world.geometry, ball.centre(), 3);
        for (std::size_t i = 0; i < blocks; ++i) {
            const LeakBlock block = leaks.next();
            for (std::size_t w = 0; w < ways.size(); ++w) passed[w] += ways[w].passed(block);
        }
        for (std::size_t w = 0; w < ways.size(); ++w) {
            INFO(ways[w].name);
            CHECK(passed[w] == 0);
        }
    }
}

}  // namespace

TEST_CASE("No segment aimed at edges and vertices passes a structure in any way of asking") {
    check_none_passes(100'000);
}

TEST_CASE("Of ten million segments aimed at edges and vertices none passes a structure",
          "[extended]") {
    check_none_passes(10'000'000);
}

TEST_CASE("A kd-tree whose triangles end at their edges lets segments pass") {
    const mirtest::BallShape ball = mirtest::leak_balls()[1];
    const mirtest::World world = ball.world();
    const Structures structures(world);
    mirtest::LeakBlocks leaks(world.geometry, ball.centre(), 3);
    std::size_t passed = 0;
    for (int i = 0; i < 400; ++i) {
        const LeakBlock block = leaks.next();
        if (!mirtest::LeakBlocks::is_far(i)) passed += structures.passed_by_edges(block);
    }
    CHECK(passed > 0);
}

TEST_CASE("No segment aimed at edges and vertices passes the shafts of a backend") {
    mir::InlineExecutor executor;
    for (const mirtest::BallShape& ball : mirtest::leak_balls()) {
        INFO(ball.name());
        const mirtest::World world = ball.world();
        const mir::WideBvh bvh = mir::build_wide_bvh(world.geometry, executor);
        mirtest::LeakBlocks leaks(world.geometry, ball.centre(), 5);
        const mirtest::LeakLuxels luxels(leaks, 40);
        CHECK(luxels.facing() > luxels.segments().size() - luxels.segments().size() / 1000);
        const auto words =
            mirtest::shaft_words(mir::host::Backend(executor), luxels.input(bvh), {});
        CHECK(mirtest::count_bits(words) == 0);
    }
}
