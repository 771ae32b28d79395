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
template <class Options>
std::size_t differences(GatherStage& s, const Options& options) {
    using Host = mir::host::Backend<mir::InlineExecutor>;
    mir::BackendGather<Host, mir::Lambert> gather(Host(s.executor), s.tree);
    const mir::Image<mir::Rgb> there = gather(s.luxels, s.radiance, options, s.band);
    mir::Image<mir::Rgb> here(s.luxels.extent());
    const auto at = [&] {
        if constexpr (std::is_same_v<Options, mir::GatherOptions>)
            return mir::RayGather<mir::Space::host, mir::Lambert>{s.tree.view(), s.radiance.data(),
                                                                  options};
        else
            return mir::BufferGather<mir::Space::host, mir::Lambert>{s.tree.view(),
                                                                     s.radiance.data(), options};
    }();
    double light = 0.0;
    mir::for_each_luxel(s.luxels, s.executor,
                        [&](std::uint32_t x, std::uint32_t y, const auto& view, mir::LuxelIndex i) {
                            here(x, y) = at(view.hit(i), view.surface(i),
                                            s.band.luxel_numbers(x, y, mir::Stream::gather));
                            light += static_cast<double>(luminance(here(x, y)));
                        });
    CHECK(light > 0.0);
    return different_luxels(there, here);
}

}  // namespace

TEST_CASE("The host gathers the same bits as a backend and luxel by luxel") {
    GatherStage s;
    CHECK(differences(s, mir::GatherOptions{.rays = 16}) == 0);
    CHECK(differences(s, mir::BufferGatherOptions{.side = 4}) == 0);
    s.band = {11, {{45, 64}}, 6};  // rows of a larger picture have numbers of their own
    CHECK(differences(s, mir::GatherOptions{.rays = 8, .threshold = 0.0f}) == 0);
}

TEST_CASE("gather_light() and a backend over the host make the same picture") {
    GatherStage s;
    using Host = mir::host::Backend<mir::InlineExecutor>;
    mir::BackendGather<Host, mir::Lambert> gather(Host(s.executor), s.tree);
    const mir::GatherOptions options{.rays = 12};
    CHECK(different_luxels(gather(s.luxels, s.radiance, options, s.band),
                           mir::gather_light<mir::Lambert>(s.luxels, s.tree, s.radiance, options,
                                                           s.band, s.executor)) == 0);
    CHECK_THROWS_AS(gather(s.luxels, s.radiance, mir::GatherOptions{.rays = 0}, s.band),
                    mir::Error);
}
