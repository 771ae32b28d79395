// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/stage.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <limits>
#include <vector>

// The axioms of Scheduler. Bits are compared, so the tests are built with -ffp-contract=off.

namespace mirtest {

inline mir::Rgb not_written() {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    return {nan, nan, nan};
}
inline bool is_written(mir::Rgb c) { return c.r == c.r && c.g == c.g && c.b == c.b; }

/// What the oracle makes of the same inputs, on one thread.
template <class S, class F>
mir::Image<mir::Rgb> oracle(const S& stage, const F& shading) {
    mir::InlineExecutor executor;
    return mir::reconstruct(mir::sched::Cpu{executor}, stage.gbuffer(), stage.vpls(),
                            stage.visibility(), shading);
}

/// Opens a pipeline by hand over an image that nobody wrote yet and submits `tiles`, in order.
template <class Scheduler, class S, class F>
mir::Image<mir::Rgb> run_tiles(const Scheduler& scheduler, const S& stage, const F& shading,
                               const std::vector<mir::TileIndex>& tiles) {
    using In = mir::Inputs<std::remove_cvref_t<decltype(stage.gbuffer())>, decltype(stage.vpls()),
                           decltype(stage.visibility()), F>;
    static_assert(mir::Scheduler<Scheduler, In>);
    const In in{stage.gbuffer(), stage.vpls(), stage.visibility(), shading};
    mir::Image<mir::Rgb> image(stage.gbuffer().extent(), not_written());
    auto pipeline = scheduler.open(in, image);
    for (mir::TileIndex t : tiles) pipeline.submit(t);
    pipeline.finish();
    return image;
}

/// Every luxel of the submitted tiles is written, and no other one: what was not a number before
/// would stay so if anything were added to it.
template <class Scheduler, class S, class F>
void luxels_of_submitted_tiles_are_written(const Scheduler& scheduler, const S& stage,
                                           const F& shading) {
    const auto& tiles = stage.gbuffer().tiles();
    std::vector<mir::TileIndex> every_other;
    for (mir::TileIndex t = 0; t < tiles.size(); t += 2) every_other.push_back(t);
    const auto image = run_tiles(scheduler, stage, shading, every_other);
    const mir::Image<mir::Rgb> wanted = oracle(stage, shading);
    std::size_t wrong = 0;
    for (mir::TileIndex t = 0; t < tiles.size(); ++t)
        for (std::uint32_t y = tiles[t].y; y < tiles[t].y + tiles[t].height; ++y)
            for (std::uint32_t x = tiles[t].x; x < tiles[t].x + tiles[t].width; ++x) {
                const bool right =
                    t % 2 == 0 ? image(x, y) == wanted(x, y) : !is_written(image(x, y));
                wrong += right ? 0 : 1;
            }
    CHECK(wrong == 0);
}

/// Forwards, backwards, and from the middle outwards.
template <class Scheduler, class S, class F>
void order_of_tiles_does_not_matter(const Scheduler& scheduler, const S& stage, const F& shading) {
    std::vector<mir::TileIndex> tiles(stage.gbuffer().tiles().size());
    for (mir::TileIndex t = 0; t < tiles.size(); ++t) tiles[t] = t;
    const auto forwards = run_tiles(scheduler, stage, shading, tiles);
    std::reverse(tiles.begin(), tiles.end());
    CHECK(pixels_that_differ(run_tiles(scheduler, stage, shading, tiles), forwards) == 0);
    std::rotate(tiles.begin(), tiles.begin() + tiles.size() / 2, tiles.end());
    CHECK(pixels_that_differ(run_tiles(scheduler, stage, shading, tiles), forwards) == 0);
}

template <class Scheduler, class S, class F>
void no_vpls_give_black(const Scheduler& scheduler, const S& stage, const F& shading) {
    const mir::VplSpan<mir::Space::host> none{};
    const auto image =
        mir::reconstruct(scheduler, stage.gbuffer(), none, stage.visibility(), shading);
    CHECK(pixels_that_differ(image, mir::Image<mir::Rgb>(stage.gbuffer().extent())) == 0);
}

/// In every bit.
template <class Scheduler, class S, class F>
void image_is_that_of_the_oracle(const Scheduler& scheduler, const S& stage, const F& shading) {
    const auto wanted = oracle(stage, shading);
    std::size_t lit = 0;
    for (const mir::Rgb& c : wanted.pixels()) lit += mir::is_black(c) ? 0 : 1;
    // An oracle that sees nothing proves nothing.
    CHECK(lit > 100);
    const auto found =
        mir::reconstruct(scheduler, stage.gbuffer(), stage.vpls(), stage.visibility(), shading);
    CHECK(pixels_that_differ(found, wanted) == 0);
}

/// All axioms, for one stage and two shadings of it.
template <mir::Bsdf B, class Scheduler, class Engine>
void scheduler_suite(const Scheduler& scheduler, const Stage<B, Engine>& stage) {
    const mir::VplShading<B> bounded{2.0f};
    luxels_of_submitted_tiles_are_written(scheduler, stage, bounded);
    order_of_tiles_does_not_matter(scheduler, stage, bounded);
    no_vpls_give_black(scheduler, stage, bounded);
    image_is_that_of_the_oracle(scheduler, stage, bounded);
    image_is_that_of_the_oracle(scheduler, stage, mir::RemovedByBound<B>{2.0f});
}

}  // namespace mirtest
