// SPDX-License-Identifier: MIT
#include "cuda/gather.hpp"

#include "mir/cuda/device.hpp"
#include "mir/host/backend.hpp"
#include "support/catch.hpp"
#include "support/gather_stage.hpp"

// Light gathered on the GPU against the host, bit for bit: what is computed is made of operations
// that both round alike, and atanf, which may differ, only chooses texels with a margin.

namespace {

template <mir::Bsdf B, class Options>
void check_same(const Options& options) {
    using Host = mir::host::Backend<mir::InlineExecutor>;
    mirtest::GatherStage<B> stage;
    mir::BackendGather<Host, B> here(Host(stage.executor), stage.tree);
    const mir::cuda::Backend gpu(mir::cuda::select_device(0));
    const mirtest::GatherInput<B> input{stage.tree, stage.radiance, stage.luxels, stage.band};
    CHECK(mirtest::different_luxels(mirtest::gather_on_gpu(gpu, input, options),
                                    here(stage.luxels, stage.radiance, options, stage.band)) == 0);
}

}  // namespace

TEST_CASE("The GPU gathers by rays what the host gathers, bit for bit") {
    check_same<mir::Lambert>(mir::GatherOptions{.rays = 64});
    check_same<mir::Lambert>(mir::GatherOptions{
        .rays = 16, .directions = mir::GatherDirections::uniform, .threshold = 0.0f});
    check_same<mir::Lambert>(
        mir::GatherOptions{.rays = 16, .threshold = 4.0f, .shape = mir::StopShape::sphere});
    check_same<mir::CookTorrance>(mir::GatherOptions{.rays = 64});
}

TEST_CASE("The GPU gathers by micro-buffers what the host gathers, bit for bit") {
    using mir::BufferGatherOptions;
    check_same<mir::Lambert>(BufferGatherOptions{.side = 8});
    check_same<mir::Lambert>(BufferGatherOptions{.side = 13});
    check_same<mir::Lambert>(BufferGatherOptions{.side = 24, .threshold = 0.5f});
    check_same<mir::CookTorrance>(BufferGatherOptions{.side = 8});
    check_same<mir::CookTorrance>(
        BufferGatherOptions{.side = 16, .warp = mir::BufferWarp::importance});
}
