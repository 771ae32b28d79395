// SPDX-License-Identifier: MIT
#include "mir/resident/backend_wide_bvh.hpp"

#include "conformance/wide_builder_suite.hpp"
#include "mir/host/tbb_executor.hpp"
#include "support/watched_backend.hpp"

namespace {

using namespace mirtest;

CopiedWideBvh build_on_host(const mir::WorldGeometry& geometry,
                            const mir::WideBvhOptions& options = {}) {
    mir::InlineExecutor executor;
    return build_wide_on(mir::host::Backend(executor), geometry, options);
}

/// A tree built on a backend that may fail, of a geometry that is there already.
void build_watched(const mir::WorldGeometry& geometry, Watch& watch) {
    PutOff work(0);
    const WatchedBackend backend(work, watch);
    auto queue = backend.queue();
    mir::WideBvhOptions options;
    options.splits = 0.5f;
    const mir::BackendWideBvh<WatchedBackend> bvh(backend, queue, geometry, geometry.view(),
                                                  options);
}

double cost_of(const CopiedWideBvh& bvh) { return mir::wide_statistics(bvh.nodes()).sah_cost(); }

}  // namespace

TEST_CASE("Wide trees that a backend builds keep their promises") {
    wide_builder_suite(build_on_host);
}

TEST_CASE("A backend builds the same bytes with any number of threads, in any order, late or not") {
    for (const World& world : worlds_to_compare()) {
        const CopiedWideBvh one = build_on_host(world.geometry);
        for (std::size_t threads : {2u, 3u}) {
            BackwardsExecutor executor{threads};
            CHECK(same_trees(one, build_wide_on(mir::host::Backend(executor), world.geometry)));
        }
        PutOff work(0);
        CHECK(same_trees(one, build_wide_on(LazyBackend(work), world.geometry)));
    }
}

TEST_CASE("Nested triangles would make a backend's tree deeper than it may become") {
    const World world = nested_triangles(3000, 30);
    CHECK(build_on_host(world.geometry).depth() > 6);
}

TEST_CASE("A backend's trees cost less than those of clusters joined by their order alone") {
    const World world(mir::builtin::make("sphere"));
    mir::WideBvhOptions by_order;
    by_order.max_depth = 1;
    const double cost = cost_of(build_on_host(world.geometry));
    CHECK(cost < 0.95 * cost_of(build_on_host(world.geometry, by_order)));
}

TEST_CASE("A backend's tree knows its size") {
    const World world = triangle_soup(100, 1);
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    auto queue = backend.queue();
    const mir::BackendWideBvh<mir::host::Backend<mir::InlineExecutor>> bvh(
        backend, queue, world.geometry, world.geometry.view());
    CHECK(bvh.reference_count() == 100);
    CHECK(bvh.node_count() > 4);
    CHECK(bvh.bytes() == bvh.node_count() * 256 + 100 * 52);
}

TEST_CASE("Whatever fails while a backend builds a tree, its memory outlives its work") {
    const World world = triangle_soup(50, 2);
    Watch all;
    build_watched(world.geometry, all);
    const auto check_refused = [&](Watch watch) {
        CHECK_THROWS_AS(build_watched(world.geometry, watch), mir::Error);
        CHECK(watch.buffers == 0);
        CHECK(watch.ended_too_soon == 0);
    };
    for (std::size_t i = 0; i < all.allocations; ++i) check_refused({.failing_allocation = i});
    for (std::size_t i = 0; i < all.operations; ++i) check_refused({.failing_operation = i});
    CHECK(all.ended_too_soon == 0);
}
