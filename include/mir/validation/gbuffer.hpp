// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/validation/report.hpp"

#include <cmath>
#include <cstdint>

namespace mir::validation {

namespace detail {

/// Every luxel of the image lies in one tile.
template <TiledGBuffer T>
void expect_tiles_cover(const T& buffer, Report& report) {
    const Extent extent = buffer.extent();
    std::vector<std::uint32_t> times(static_cast<std::size_t>(extent.area()), 0);
    std::size_t outside = 0;
    for (const Tile& tile : buffer.tiles())
        for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y)
            for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x)
                if (x < extent.width && y < extent.height)
                    ++times[std::size_t{y} * extent.width + x];
                else
                    ++outside;
    std::size_t bad = 0;
    for (const std::uint32_t n : times) bad += n == 1 ? 0 : 1;
    report.expect(bad == 0 && outside == 0, "every luxel lies in one tile",
                  std::to_string(bad) + " do not, " + std::to_string(outside) +
                      " places of tiles lie outside of the image");
}

/// What was wrong with the luxels of some tiles.
struct WrongLuxels {
    std::size_t misplaced = 0;
    std::size_t unsound = 0;
    std::size_t padding = 0;
};

inline bool is_sound(const Hit& hit) {
    return is_finite(hit.position) && std::fabs(glm::length(hit.normal) - 1.0f) < 1e-3f;
}

inline bool is_near(const Hit& a, const Hit& b, float tolerance) {
    if (is_empty(a) || is_empty(b)) return is_empty(a) == is_empty(b);
    return max_abs(a.position - b.position) <= tolerance &&
           max_abs(a.normal - b.normal) <= tolerance;
}

template <GBuffer G, class Expected>
void count_wrong(const G& view, Tile tile, const Expected& expected, float tolerance,
                 WrongLuxels& wrong) {
    const auto layout = BlockedLayout::of(tile);
    for (LuxelIndex i = 0; i < layout.size(); ++i) {
        const LuxelPlace at = layout.place(i);
        const Hit hit = view.hit(i);
        if (at.x >= tile.width || at.y >= tile.height) {
            wrong.padding += is_empty(hit) ? 0 : 1;
            continue;
        }
        wrong.unsound += is_empty(hit) || is_sound(hit) ? 0 : 1;
        wrong.misplaced += is_near(hit, expected(tile.x + at.x, tile.y + at.y), tolerance) ? 0 : 1;
    }
}

}  // namespace detail

/// The axioms of GBuffer and TiledGBuffer. `expected(x, y)` gives the Hit of a luxel of the image,
/// an empty one where it sees nothing; positions (metres) and normals may differ from it by
/// `tolerance`. surface() is never called: that hits can be read while surfaces are not there yet
/// is checked by a buffer whose surfaces are not there.
template <TiledGBuffer T, class Expected>
Report check_gbuffer(const T& buffer, const Expected& expected, float tolerance = 0.0f) {
    Report report;
    detail::expect_tiles_cover(buffer, report);
    detail::WrongLuxels wrong;
    std::size_t sizes = 0;
    for (TileIndex t = 0; t < buffer.tiles().size(); ++t) {
        const Tile tile = buffer.tiles()[t];
        const auto view = buffer.view(t);
        if (view.size() == BlockedLayout::of(tile).size())
            detail::count_wrong(view, tile, expected, tolerance, wrong);
        else
            ++sizes;
    }
    report.expect(sizes == 0, "views have the luxels of whole blocks",
                  std::to_string(sizes) + " have another number");
    report.expect(wrong.padding == 0, "luxels of the padding are empty",
                  std::to_string(wrong.padding) + " are not");
    report.expect(wrong.unsound == 0, "luxels are finite and have unit normals",
                  std::to_string(wrong.unsound) + " are not so");
    report.expect(wrong.misplaced == 0, "luxels lie where BlockedLayout says",
                  std::to_string(wrong.misplaced) + " are other than expected");
    return report;
}

}  // namespace mir::validation
