// SPDX-License-Identifier: MIT
#include "mir/place_vpls.hpp"

#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "normalise/lit_box.hpp"
#include "support/catch.hpp"

namespace {

using mirtest::Approx;
using mirtest::RandomRecords;
using Box = mirtest::LitBox<mir::Lambert>;

constexpr mir::Extent image{60, 40};
const mir::VplShading<mir::Lambert> shading{3.0f};

/// Records that are final, whatever they are.
struct Final : RandomRecords {
    using RandomRecords::RandomRecords;
    static constexpr mir::Normalisation normalisation = mir::Normalisation::none;
};

template <mir::Sampler S>
mir::PlacedVpls placed(const Box& box) {
    mir::InlineExecutor executor;
    return place_vpls(S(box.world.geometry, 30, 71), box.gbuffer, box.engine.visibility(), shading,
                      executor);
}

}  // namespace

TEST_CASE("placed VPLs bring P_c to the image, less what no luxel sees") {
    const Box box(image);
    const mir::PlacedVpls p = placed<RandomRecords>(box);
    CHECK(p.normalisation.dropped_share > 0.0);
    mir::InlineExecutor executor;
    const auto light = reconstruct(mir::sched::Cpu{executor}, box.gbuffer, p.vpls.span(),
                                   box.engine.visibility(), shading);
    double sum = 0.0;
    for (const mir::Rgb& c : light.pixels()) sum += static_cast<double>(luminance(c));
    CHECK(sum / static_cast<double>(image.area()) ==
          Approx(RandomRecords::path_luminance * (1.0 - p.normalisation.dropped_share))
              .epsilon(1e-5));
}

TEST_CASE("VPLs whose intensities are final are placed as they are") {
    const Box box(image);
    const mir::PlacedVpls p = placed<Final>(box);
    CHECK(p.normalisation.dropped_share == 0.0);
    REQUIRE(p.vpls.size() == box.vpls.size());
    for (mir::VplIndex j = 0; j < p.vpls.size(); ++j)
        REQUIRE(p.vpls.vpls()[j].intensity == box.vpls.vpls()[j].intensity);
}

TEST_CASE("bits of placed VPLs that do not fit into the limit are refused") {
    const Box box(image);
    mir::InlineExecutor executor;
    mir::Limits limits;
    limits.visibility_bytes = 16;
    CHECK_THROWS_AS(place_vpls(RandomRecords(box.world.geometry, 30, 71), box.gbuffer,
                               box.engine.visibility(), shading, executor, limits),
                    mir::Error);
}
