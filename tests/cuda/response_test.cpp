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

template <class G, class S>
mir::VisibilityMatrix seen_by(const G& luxels, const S& stage) {
    mir::InlineExecutor executor;
    mir::VisibilityMatrix matrix(luxels.tiles(), stage.vpls().size());
    fill_visibility(matrix, luxels, stage.vpls(), stage.visibility(), executor);
    return matrix;
}

/// ResponseSum over luxels of the stage's scene.
template <class G, class S, class F>
Responses on_host(const G& luxels, const S& stage, const F& shading) {
    mir::InlineExecutor executor;
    return response(luxels, stage.vpls(), seen_by(luxels, stage), shading, executor);
}

template <class G, class S, class F>
Responses on_gpu(const G& luxels, const S& stage, const F& shading,
                 std::uint32_t partial_sums = 1u << 21) {
    return mirtest::responses_on_gpu(mir::cuda::Backend(mir::cuda::select_device(0)), luxels,
                                     stage.vpls(), stage.visibility(), shading, partial_sums);
}

/// Pairs of sixteen luxels of the first tile and a VPL that some of them see, of which shading
/// makes no number for others.
template <class S>
std::uint32_t mixed_runs(const S& stage, const mirtest::NoNumberBehind& shading) {
    const auto view = stage.gbuffer().view(0);
    const mir::VisibilityMatrix matrix = seen_by(stage.gbuffer(), stage);
    const auto seen = matrix.view().tile(0);
    std::uint32_t mixed = 0;
    for (mir::VplIndex j = 0; j < stage.vpls().size(); ++j)
        for (mir::LuxelIndex first = 0; first < view.size(); first += 16) {
            bool some_see = false;
            bool some_without = false;
            for (mir::LuxelIndex i = first; i < first + 16; ++i) {
                const mir::Rgb c = shading(view.hit(i), view.surface(i), stage.vpls()[j]);
                some_see = some_see || seen.sees(i, j);
                some_without = some_without || !(c == c);
            }
            mixed += some_see && some_without ? 1 : 0;
        }
    return mixed;
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
            const Responses wanted = on_host(stage.gbuffer(), stage, shading);
            // The first VPL alone is seen by no luxel.
            CHECK((lit_luxels(wanted) > 100) == (vpls > 1));
            CHECK(mirtest::same_bits(on_gpu(stage.gbuffer(), stage, shading), wanted));
            // Seven blocks side by side: 32 VPLs of one row of blocks at a time.
            CHECK(mirtest::same_bits(on_gpu(stage.gbuffer(), stage, shading, 0), wanted));
        }
    }
}

TEST_CASE("Black luxels beside others are the host's on the GPU") {
    const Stage<mir::Lambert> stage({100, 70}, {48, 32}, 77);
    auto luxels = stage.gbuffer();
    for (mir::TileIndex t = 0; t < luxels.tiles().size(); ++t)
        for (mir::LuxelIndex i = 0; i < luxels.view(t).size(); i += 3) {
            auto surface = luxels.view(t).surface(i);
            surface.bsdf.reflectance = {};
            luxels.store(t, i, luxels.view(t).hit(i), surface);
        }
    const mir::VplShading<mir::Lambert> shading{2.0f};
    const Responses wanted = on_host(luxels, stage, shading);
    CHECK(lit_luxels(wanted) > 100);
    CHECK(lit_luxels(wanted) < lit_luxels(on_host(stage.gbuffer(), stage, shading)));
    CHECK(mirtest::same_bits(on_gpu(luxels, stage, shading), wanted));
}

TEST_CASE("What shading says of luxels that do not see a VPL is thrown away on the GPU") {
    const Stage<mir::Lambert> stage({100, 70}, {48, 32}, 77);
    const mirtest::NoNumberBehind shading{{2.0f}};
    CHECK(mixed_runs(stage, shading) > 100);
    const Responses wanted = on_host(stage.gbuffer(), stage, shading);
    CHECK(lit_luxels(wanted) > 100);
    for (const mir::ImageResponse& r : wanted) REQUIRE(r.r + r.g + r.b < 1e30);
    CHECK(mirtest::same_bits(on_gpu(stage.gbuffer(), stage, shading), wanted));
}
