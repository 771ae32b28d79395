// SPDX-License-Identifier: MIT
#include "support/random_segments.hpp"

#include "cuda/segments/gpu_segment_bits.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/host/backend.hpp"
#include "support/catch.hpp"
#include "support/segment_bits.hpp"
#include "support/segment_scenes.hpp"
#include "support/thread_executor.hpp"

#include <bit>
#include <iostream>

// Random segments through six scenes, the same as in tests/segments: the kd-tree in the GPU's
// memory against the one on the host, in every bit. MIR_TEST_SEGMENTS says how many per scene.

namespace {

using Words = std::vector<std::uint32_t>;

std::uint64_t bits_that_differ(const Words& a, const Words& b) {
    std::uint64_t different = 0;
    for (std::size_t w = 0; w < a.size(); ++w)
        different += static_cast<std::uint64_t>(std::popcount(a[w] ^ b[w]));
    return different;
}

/// Answers of the host and the GPU.
struct Count {
    std::uint64_t asked = 0;
    std::uint64_t hidden = 0;
    std::uint64_t different = 0;
};

Count compare(const mir::cuda::Backend& gpu, const mir::WorldGeometry& geometry,
              std::uint64_t segments, mirtest::Rounding rounding) {
    constexpr std::uint64_t batch = std::uint64_t{1} << 21;
    mirbench::ThreadExecutor executor;
    const mir::KdTreeScene tree(geometry, executor);
    const mirtest::RandomSegments random(geometry);
    Count count;
    for (; count.asked < segments; count.asked = std::min(segments, count.asked + batch)) {
        const auto asked =
            random.make(count.asked, std::min(batch, segments - count.asked), executor);
        const Words host =
            mirtest::segment_bits(mir::host::Backend(executor), tree.visibility(), asked);
        const Words there = mirtest::gpu_segment_bits(gpu, tree.tree(), asked, rounding);
        count.hidden += asked.size() - bits_that_differ(host, Words(host.size()));
        count.different += bits_that_differ(host, there);
    }
    return count;
}

mir::cuda::Backend first_gpu() { return mir::cuda::Backend(mir::cuda::select_device(0)); }

}  // namespace

TEST_CASE("A kd-tree on the GPU answers random segments through six scenes like the host") {
    const std::uint64_t segments = mirtest::segments_per_scene(100000);
    for (const mirtest::SegmentScene& scene : mirtest::segment_scenes) {
        const auto world = mirtest::load(scene);
        if (!world) {
            WARN("skipped: " << scene.file << " is not on this machine");
            continue;
        }
        INFO(scene.name);
        const Count c = compare(first_gpu(), world->geometry, segments, mirtest::Rounding::strict);
        std::cout << "| " << scene.name << " | " << c.asked << " | " << c.hidden << " | "
                  << c.different << " |\n";
        CHECK(c.hidden > c.asked / 50);
        CHECK(c.hidden < c.asked);
        CHECK(c.different == 0);
    }
}

TEST_CASE("A kd-tree on the GPU that fuses a product is noticed") {
    const mirtest::World world(mir::builtin::make("sphere"));
    CHECK(compare(first_gpu(), world.geometry, 100096, mirtest::Rounding::fused).different > 0);
}
