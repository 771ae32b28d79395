// SPDX-License-Identifier: MIT
#include "cuda/segments/gpu_segment_bits.hpp"
#include "cuda/shafts.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/cuda/device.hpp"
#include "support/catch.hpp"
#include "support/leak_luxels.hpp"

// Segments aimed at the edges and vertices of closed surfaces, through the structures in a GPU's
// memory; those of the host in tests/segments/leaks_test.cpp.

namespace {

/// Segments that pass one closed surface.
struct Leaks {
    std::size_t asked = 0;   ///< aimed segments
    std::size_t facing = 0;  ///< those that shafts are asked about
    std::size_t tree = 0;    ///< passed the kd-tree
    std::size_t bvh = 0;     ///< passed the wide hierarchy
    std::size_t shafts = 0;  ///< passed shafts, of all pairs of luxels and VPLs
};

Leaks count_leaks(const mirtest::BallShape& ball, std::size_t blocks) {
    const mir::cuda::Backend gpu(mir::cuda::select_device(0));
    const mirtest::World world = ball.world();
    mir::InlineExecutor executor;
    const mir::KdTree tree(world.geometry, {}, executor);
    const mir::WideBvh bvh = mir::build_wide_bvh(world.geometry, executor);
    mirtest::LeakBlocks leaks(world.geometry, ball.centre(), 5);
    const mirtest::LeakLuxels luxels(leaks, blocks);
    const auto& segments = luxels.segments();
    return {segments.size(), luxels.facing(),
            mirtest::count_bits(mirtest::gpu_segment_bits(gpu, tree, segments)),
            mirtest::count_bits(mirtest::gpu_segment_bits(gpu, bvh, segments)),
            mirtest::count_bits(mirtest::shaft_words_on_gpu(gpu, luxels.input(bvh), {}))};
}

}  // namespace

TEST_CASE("Of ten million segments aimed at edges and vertices none passes a structure on a GPU") {
    const auto& balls = mirtest::leak_balls();
    const std::size_t blocks = 10'000'000 / (mirtest::LeakBlock::size * balls.size()) + 1;
    std::size_t asked = 0;
    for (const mirtest::BallShape& ball : balls) {
        INFO(ball.name());
        const Leaks leaks = count_leaks(ball, blocks);
        asked += leaks.asked;
        CHECK(leaks.facing > leaks.asked - leaks.asked / 1000);
        CHECK(leaks.tree == 0);
        CHECK(leaks.bvh == 0);
        CHECK(leaks.shafts == 0);
    }
    CHECK(asked >= 10'000'000);
}
