// SPDX-License-Identifier: MIT
#include "cuda/response.hpp"

#include "conformance/stage.hpp"
#include "mir/cuda/device.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/normalise/response.hpp"
#include "support/catch.hpp"
#include "support/same_responses.hpp"

// Image responses on the GPU against ResponseSum on the host, in every bit.

namespace {

template <mir::Bsdf B>
using Stage = mirtest::Stage<B, mirtest::BruteForceRows>;
using Responses = std::vector<mir::ImageResponse>;

template <class S, class F>
Responses on_host(const S& stage, const F& shading) {
    mir::InlineExecutor executor;
    mir::VisibilityMatrix matrix(stage.gbuffer().tiles(), stage.vpls().size());
    fill_visibility(matrix, stage.gbuffer(), stage.vpls(), stage.visibility(), executor);
    return response(stage.gbuffer(), stage.vpls(), matrix, shading, executor);
}

template <class S, class F>
Responses on_gpu(const S& stage, const F& shading, std::uint32_t partial_sums = 1u << 21) {
    return mirtest::responses_on_gpu(mir::cuda::Backend(mir::cuda::select_device(0)),
                                     stage.gbuffer(), stage.vpls(), stage.visibility(), shading,
                                     partial_sums);
}

std::uint64_t lit_luxels(const Responses& responses) {
    std::uint64_t lit = 0;
    for (const mir::ImageResponse& r : responses) lit += r.lit_luxels;
    return lit;
}

}  // namespace

TEMPLATE_TEST_CASE("Responses on the GPU are the host's in every bit", "", mir::Lambert,
                   mir::CookTorrance) {
    for (const std::uint32_t vpls : {1u, 31u, 32u, 77u}) {
        CAPTURE(vpls);
        const Stage<TestType> stage({100, 70}, {48, 32}, vpls);
        for (const float bound : {2.0f, 1e30f}) {
            const mir::VplShading<TestType> shading{bound};
            const Responses wanted = on_host(stage, shading);
            CHECK(lit_luxels(wanted) > 100);
            CHECK(mirtest::same_bits(on_gpu(stage, shading), wanted));
            // Seven blocks side by side: 32 VPLs of one row of blocks at a time.
            CHECK(mirtest::same_bits(on_gpu(stage, shading, 0), wanted));
        }
    }
}

TEST_CASE("What shading says of luxels that do not see a VPL is thrown away on the GPU") {
    const Stage<mir::Lambert> stage({100, 70}, {48, 32}, 77);
    const mirtest::NoNumberBehind shading{{2.0f}};
    // Some luxels of a block see a VPL that others are behind, or no lane is asked for nothing.
    const mir::Vpl& vpl = stage.vpls()[0];
    const auto view = stage.gbuffer().view(0);
    bool without_number = false;
    for (mir::LuxelIndex i = 0; i < view.size(); ++i) {
        const mir::Rgb c = shading(view.hit(i), view.surface(i), vpl);
        without_number = without_number || !(c == c);
    }
    CHECK(without_number);
    const Responses wanted = on_host(stage, shading);
    CHECK(lit_luxels(wanted) > 100);
    CHECK(mirtest::same_bits(on_gpu(stage, shading), wanted));
}
