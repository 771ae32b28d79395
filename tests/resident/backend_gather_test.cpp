// SPDX-License-Identifier: MIT
#include "mir/resident/backend_gather.hpp"

#include "mir/host/backend.hpp"
#include "mir/micro/gather_light.hpp"
#include "support/catch.hpp"
#include "support/gather_stage.hpp"

using mirtest::different_luxels;
using mirtest::GatherStage;

namespace {

/// Of what the host gathers as a backend and as itself.
template <mir::Bsdf B, class Options>
std::size_t differences(GatherStage<B>& s, const Options& options) {
    using Host = mir::host::Backend<mir::InlineExecutor>;
    mir::BackendGather<Host, B> gather(Host(s.executor), s.tree);
    const mir::Image<mir::Rgb> there = gather(s.luxels, s.radiance, options, s.band);
    const mir::Image<mir::Rgb> here =
        mir::gather_light<B>(s.luxels, s.tree, s.radiance, options, s.band, s.executor);
    double light = 0.0;
    for (const mir::Rgb& c : here.pixels()) light += static_cast<double>(luminance(c));
    CHECK(light > 0.0);
    return different_luxels(there, here);
}

}  // namespace

TEST_CASE("The host gathers the same bits as a backend and luxel by luxel") {
    GatherStage<mir::Lambert> s;
    CHECK(differences(s, mir::GatherOptions{.rays = 16}) == 0);
    CHECK(differences(s, mir::BufferGatherOptions{.side = 4}) == 0);
    CHECK(differences(s, mir::BufferGatherOptions{.side = 12}) == 0);
    s.band = {11, {{45, 64}}, 6};  // rows of a larger picture have numbers of their own
    CHECK(differences(s, mir::GatherOptions{.rays = 8, .threshold = 0.0f}) == 0);
}

TEST_CASE("Glossy luxels gather the same bits as a backend and luxel by luxel") {
    GatherStage<mir::CookTorrance> s;
    CHECK(differences(s, mir::GatherOptions{.rays = 16}) == 0);
    CHECK(differences(
              s, mir::BufferGatherOptions{.side = 6, .warp = mir::BufferWarp::importance}) == 0);
}

TEST_CASE("A backend tells of luxels as they are done and ends when it is told to") {
    GatherStage<mir::Lambert> s;
    using Host = mir::host::Backend<mir::InlineExecutor>;
    mir::BackendGather<Host, mir::Lambert> gather(Host(s.executor), s.tree);
    const mir::GatherOptions few{.rays = 1};
    std::uint64_t told = 0;
    static_cast<void>(gather(s.luxels, s.radiance, few, s.band,
                             [&told](std::uint64_t luxels) { told += luxels; }));
    CHECK(told == s.luxels.extent().area());
    const auto end = [](std::uint64_t) { throw mir::Error(mir::ErrorCode::cancelled, "enough"); };
    CHECK_THROWS_AS(gather(s.luxels, s.radiance, few, s.band, end), mir::Error);
    CHECK_THROWS_AS(gather(s.luxels, s.radiance, mir::GatherOptions{.rays = 0}, s.band),
                    mir::Error);
}
