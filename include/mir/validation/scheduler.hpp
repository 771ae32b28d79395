// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/validation/detail/same_pixels.hpp"
#include "mir/validation/report.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace mir::validation {

namespace detail {

/// What no image has before it is written: adding to it would leave it so.
inline Rgb not_written() {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    return {nan, nan, nan};
}

/// Opens a pipeline over an image that nobody wrote yet and submits `tiles`, in order.
template <class S, class In>
Image<Rgb> run_tiles(const S& scheduler, const In& in, const std::vector<TileIndex>& tiles) {
    Image<Rgb> image(in.gbuffer.extent(), not_written());
    auto pipeline = scheduler.open(in, image);
    for (const TileIndex t : tiles) pipeline.submit(t);
    pipeline.finish();
    return image;
}

/// Luxels of every other tile that differ, and luxels of the others that were written. They are
/// compared with `wanted`.
template <class S, class In>
std::size_t wrong_luxels(const S& scheduler, const In& in, const Image<Rgb>& wanted) {
    const auto& tiles = in.gbuffer.tiles();
    std::vector<TileIndex> every_other;
    for (TileIndex t = 0; t < tiles.size(); t += 2) every_other.push_back(t);
    const Image<Rgb> image = run_tiles(scheduler, in, every_other);
    std::size_t wrong = 0;
    for (TileIndex t = 0; t < tiles.size(); ++t)
        for (std::uint32_t y = tiles[t].y; y < tiles[t].y + tiles[t].height; ++y)
            for (std::uint32_t x = tiles[t].x; x < tiles[t].x + tiles[t].width; ++x) {
                const bool right =
                    t % 2 == 0 ? image(x, y) == wanted(x, y) : image(x, y).r != image(x, y).r;
                wrong += right ? 0 : 1;
            }
    return wrong;
}

/// Forwards, backwards, and backwards from the middle on, wrapped round: luxels that differ.
template <class S, class In>
std::size_t luxels_by_order(const S& scheduler, const In& in) {
    std::vector<TileIndex> tiles(in.gbuffer.tiles().size());
    for (TileIndex t = 0; t < tiles.size(); ++t) tiles[t] = t;
    const Image<Rgb> forwards = run_tiles(scheduler, in, tiles);
    std::reverse(tiles.begin(), tiles.end());
    const std::size_t backwards = pixels_that_differ(run_tiles(scheduler, in, tiles), forwards);
    std::rotate(tiles.begin(), tiles.begin() + static_cast<std::ptrdiff_t>(tiles.size() / 2),
                tiles.end());
    return backwards + pixels_that_differ(run_tiles(scheduler, in, tiles), forwards);
}

}  // namespace detail

/// The axioms of Scheduler, against the image of sched::Cpu, in every bit. Both see the same
/// luxels, VPLs, visibility and shading. Compile with -ffp-contract=off, or bits differ for other
/// reasons. The G-buffer should have several tiles and ragged edges, and the VPLs should light a
/// hundred luxels. A luxel that is stored twice with the same value is not noticed.
template <class S, TiledGBuffer G, VplSet P, Visibility V, Shading F>
Report check_scheduler(const S& scheduler, const G& gbuffer, P vpls, V visibility, F shading) {
    const Inputs<G, P, V, F> in{gbuffer, vpls, visibility, shading};
    InlineExecutor executor;
    const Image<Rgb> wanted = reconstruct(sched::Cpu{executor}, gbuffer, vpls, visibility, shading);
    std::size_t lit = 0;
    for (const Rgb& c : wanted.pixels()) lit += is_black(c) ? 0 : 1;
    Report report;
    const auto expect_none = [&](std::size_t wrong, const char* axiom) {
        report.expect(wrong == 0, axiom, std::to_string(wrong) + " luxels are other");
    };
    report.expect(lit > 100, "the VPLs light the luxels",
                  "only " + std::to_string(lit) + " of them");
    expect_none(detail::wrong_luxels(scheduler, in, wanted),
                "luxels of submitted tiles are written, and no other");
    expect_none(detail::luxels_by_order(scheduler, in), "the order of tiles does not matter");
    const VplSpan<Space::host> none{};
    expect_none(
        detail::pixels_that_differ(reconstruct(scheduler, gbuffer, none, visibility, shading),
                                   Image<Rgb>(gbuffer.extent())),
        "no VPLs give black");
    expect_none(detail::pixels_that_differ(
                    reconstruct(scheduler, gbuffer, vpls, visibility, shading), wanted),
                "the image is that of sched::Cpu");
    return report;
}

}  // namespace mir::validation
