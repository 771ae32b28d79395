// SPDX-License-Identifier: MIT
#include "mir/host/wide_build.hpp"

#include "conformance/wide_builder_suite.hpp"
#include "support/watched_backend.hpp"

using namespace mirtest;

TEST_CASE("The host's tree is that of a backend in every byte, for any number of threads") {
    mir::WideBvhOptions options;
    options.splits = GENERATE(0.0f, 0.3f);
    for (const World& world : worlds_to_compare()) {
        PutOff work(0);
        const CopiedWideBvh truth = build_wide_on(LazyBackend(work), world.geometry, options);
        for (std::size_t threads : {1u, 3u}) {
            BackwardsExecutor executor{threads};
            const mir::WideBvh bvh = mir::build_wide_bvh(world.geometry, executor, options);
            CHECK(same_trees(truth, bvh));
            CHECK(bvh.view().reach == truth.view().reach);
        }
    }
}

TEST_CASE("Nodes are 256 bytes apart, aligned to 64, and say what their slots hold") {
    const World world = triangle_soup(5, 4);
    const mir::WideBvh bvh = build_wide(world.geometry);
    CHECK(reinterpret_cast<std::uintptr_t>(bvh.nodes().data()) % 64 == 0);
    REQUIRE(bvh.nodes().size() == 1);
    CHECK(bvh.bytes() == 256 + 5 * 52);
    const mir::WideNode& root = bvh.nodes()[0];
    for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
        CHECK(root.is_leaf(slot) == (slot < 5));
        CHECK_FALSE(root.is_inner(slot));
        CHECK(root.count[slot] == (slot < 5 ? 1 : mir::WideNode::empty));
    }
}
