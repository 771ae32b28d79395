// SPDX-License-Identifier: MIT
#include "cuda/cuts.hpp"

#include "mir/cuda/device.hpp"
#include "support/catch.hpp"
#include "support/cuts_stage.hpp"
#include "support/same_images.hpp"

// Light gathered by cuts on the GPU against reconstruct_cuts() on the host, bit for bit.

namespace {

template <class B>
void check_same(mirtest::CutsStage<B>& stage, std::uint32_t picks, const mir::CutPlace& place) {
    CAPTURE(picks);
    const mir::cuda::Backend gpu(mir::cuda::select_device(0));
    mir::Monitor here;
    mir::Monitor there;
    const auto wanted = stage.on_host(picks, place, &here);
    const auto asked = stage.asked(picks, place, &there);
    CHECK(mirtest::same_bits(mirtest::cuts_by_wide_bvh_on_gpu(gpu, asked, stage.geometry), wanted));
    CHECK(here.contributions > 0);
    CHECK(there.contributions == here.contributions);
    CHECK(mirtest::same_bits(mirtest::cuts_by_kd_tree_on_gpu(gpu, asked, stage.engine.tree()),
                             wanted));
}

}  // namespace

TEMPLATE_TEST_CASE("The GPU gathers cuts with the bits of the host", "", mir::Lambert,
                   mir::CookTorrance) {
    for (const char* name : {"cornell-box", "sphere-indirect", "door-ajar", "car-indirect"}) {
        CAPTURE(name);
        mirtest::CutsStage<TestType> stage(name, {203, 150}, {112, 96}, 20'000, 4.0f);
        for (const std::uint32_t picks : {1u, 32u, 128u, 300u}) check_same(stage, picks, {picks});
    }
}

TEST_CASE("The GPU gathers every VPL where as many picks are wanted, in the host's order") {
    mirtest::CutsStage<mir::CookTorrance> few("cornell-box", {40, 33}, {48, 48}, 1000, 4.0f);
    check_same(few, 65536, {2, 64});
    mirtest::CutsStage<mir::Lambert> one("cornell-box", {20, 16}, {16, 16}, 1, 4.0f);
    check_same(one, 128, {3});
}
