// SPDX-License-Identifier: MIT
#include "mir/validation/gbuffer.hpp"

#include "support/catch.hpp"
#include "validation/finds.hpp"

namespace {

using mir::Hit;
using mirtest::finds;
using mirtest::finds_only;

/// What is wrong with a buffer.
enum class Bug {
    none,
    rows_for_columns,
    full_padding,
    long_normals,
    no_padding,
    two_tiles_overlap,
    moved
};

Hit expected(std::uint32_t x, std::uint32_t y) {
    if (x == 3 && y == 4) return {};
    return {{static_cast<float>(x), static_cast<float>(y), 0.0f}, {0, 0, 1}};
}

/// Luxels that are computed when they are read.
struct View {
    static constexpr mir::Space space = mir::Space::host;
    struct Surface {};

    mir::Tile tile;
    Bug bug;

    [[nodiscard]] std::uint32_t size() const {
        return bug == Bug::no_padding ? tile.width * tile.height
                                      : mir::BlockedLayout::of(tile).size();
    }
    [[nodiscard]] Hit hit(mir::LuxelIndex i) const {
        const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
        const bool padding = at.x >= tile.width || at.y >= tile.height;
        if (padding && bug != Bug::full_padding) return {};
        Hit hit = expected(tile.x + at.x, tile.y + at.y);
        if (mir::is_empty(hit)) return hit;
        if (bug == Bug::rows_for_columns) std::swap(hit.position.x, hit.position.y);
        if (bug == Bug::long_normals) hit.normal = {0, 0, 2};
        if (bug == Bug::moved) hit.position.z = 1e-3f;
        return hit;
    }
    [[nodiscard]] Surface surface(mir::LuxelIndex) const { return {}; }
};

struct Buffer {
    Bug bug;
    std::vector<mir::Tile> cut = tiles_of(bug);

    static std::vector<mir::Tile> tiles_of(Bug bug) {
        auto tiles = mir::cut_into_tiles({40, 30}, {16, 20});
        if (bug == Bug::two_tiles_overlap) tiles[1].x -= 1;
        return tiles;
    }
    [[nodiscard]] mir::Extent extent() const { return {40, 30}; }
    [[nodiscard]] const std::vector<mir::Tile>& tiles() const { return cut; }
    [[nodiscard]] View view(mir::TileIndex t) const { return {cut[t], bug}; }
};

mir::validation::Report check(Bug bug, float tolerance = 0.0f) {
    return mir::validation::check_gbuffer(Buffer{bug}, expected, tolerance);
}

}  // namespace

TEST_CASE("check_gbuffer finds nothing wrong with a right buffer") {
    CHECK(check(Bug::none).passed());
}

TEST_CASE("check_gbuffer finds each axiom that a buffer breaks") {
    CHECK(finds_only(check(Bug::rows_for_columns), "luxels lie where BlockedLayout says"));
    CHECK(finds_only(check(Bug::full_padding), "luxels of the padding are empty"));
    CHECK(finds(check(Bug::long_normals), "luxels are finite and have unit normals"));
    CHECK(finds_only(check(Bug::no_padding), "views have the luxels of whole blocks"));
    CHECK(finds_only(check(Bug::two_tiles_overlap), "every luxel lies in one tile"));
    CHECK(finds_only(check(Bug::moved), "luxels lie where BlockedLayout says"));
    CHECK(check(Bug::moved, 2e-3f).passed());
}
