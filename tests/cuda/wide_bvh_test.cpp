// SPDX-License-Identifier: MIT
#include "cuda/wide_bvh.hpp"

#include "conformance/wide_builder_suite.hpp"
#include "mir/host/backend.hpp"

using namespace mirtest;

TEST_CASE("Wide trees that the GPU builds keep their promises") {
    const mir::cuda::Backend backend(mir::cuda::select_device(0));
    wide_builder_suite([&](const mir::WorldGeometry& geometry, const mir::WideBvhOptions& options) {
        return build_wide_on_gpu(backend, geometry, options);
    });
}

TEST_CASE("The GPU builds the wide trees of the host, byte for byte") {
    const mir::cuda::Backend backend(mir::cuda::select_device(0));
    mir::InlineExecutor executor;
    mir::WideBvhOptions options;
    options.splits = GENERATE(0.0f, 0.3f);
    for (const World& world : worlds_to_compare())
        CHECK(same_trees(build_wide_on_gpu(backend, world.geometry, options),
                         build_wide_on(mir::host::Backend(executor), world.geometry, options)));
}
