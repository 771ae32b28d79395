// SPDX-License-Identifier: MIT
#include "mir/data/visibility_matrix.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "mir/concepts/archetypes.hpp"
#include "mir/concepts/known_visibility.hpp"
#include "mir/fill_visibility.hpp"
#include "support/catch.hpp"

#include <string>

namespace {

using Matrix = mir::VisibilityMatrix;
using Stage = mirtest::Stage<mir::Lambert, mirtest::BruteForceScene>;

static_assert(mir::KnownVisibility<Matrix::View>);
static_assert(!mir::KnownVisibility<mirtest::BruteForceVisibility>);
static_assert(!mir::Visibility<Matrix::View>);
static_assert(Matrix::View::group_size == mir::blocks::group_size);

/// Brute force without its packet interface.
struct Segments {
    static constexpr mir::Space space = mir::Space::host;
    mirtest::BruteForceVisibility brute;
    [[nodiscard]] bool visible(mir::Vec3 a, mir::Vec3 b) const { return brute.visible(a, b); }
};
static_assert(!mir::PacketVisibility<Segments>);

template <class V>
Matrix filled(const Stage& stage, const V& visibility) {
    Matrix matrix(stage.gbuffer().tiles(), stage.vpls().size());
    mir::archetype::Executor executor{mir::archetype::make};
    fill_visibility(matrix, stage.gbuffer(), stage.vpls(), visibility, executor);
    return matrix;
}

/// Pairs whose bit is not what faces() and visible() say.
std::size_t wrong_bits(const Stage& stage, const Matrix& matrix) {
    std::size_t wrong = 0;
    const auto bits = matrix.view();
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t) {
        const auto luxels = stage.gbuffer().view(t);
        for (mir::LuxelIndex i = 0; i < luxels.size(); ++i)
            for (mir::VplIndex j = 0; j < stage.vpls().size(); ++j) {
                const mir::Vpl vpl = stage.vpls()[j];
                const mir::Hit hit = luxels.hit(i);
                const bool sees =
                    faces(hit, vpl) && stage.visibility().visible(vpl.position, hit.position);
                wrong += bits.sees(t, i, j) == sees ? 0 : 1;
            }
    }
    return wrong;
}

}  // namespace

TEST_CASE("A bit is faces() and visible(), for packets and for single segments") {
    const Stage stage({70, 50}, {48, 32}, 23);
    CHECK(wrong_bits(stage, filled(stage, stage.visibility())) == 0);
    CHECK(wrong_bits(stage, filled(stage, Segments{stage.visibility()})) == 0);
}

TEST_CASE("Masks of a block lie side by side, group by group") {
    const Stage stage({70, 50}, {48, 32}, 23);
    const Matrix matrix = filled(stage, stage.visibility());
    const auto bits = matrix.view();
    std::size_t wrong = 0;
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t)
        for (mir::LuxelIndex i = 0; i < stage.gbuffer().view(t).size(); ++i)
            for (mir::VplIndex j = 0; j < 23; ++j) {
                const std::uint32_t mask = bits.block_masks(t, i / 256, j)[i % 256 / 16];
                wrong += (mask >> i % 16 & 1u) == (bits.sees(t, i, j) ? 1u : 0u) ? 0 : 1;
            }
    CHECK(wrong == 0);
}

TEST_CASE("A matrix with a wrong bit is rejected") {
    const Stage stage({20, 20}, {16, 16}, 5);
    Matrix matrix = filled(stage, stage.visibility());
    matrix.store(3, 7, 2, matrix.view().mask(3, 7, 2) ^ 0x0100u);
    CHECK(wrong_bits(stage, matrix) == 1);
}

TEST_CASE("Bits do not depend on tiles that are whole blocks or on instruction sets") {
    const Stage wanted({70, 50}, {256, 256}, 9);
    const Stage stage({70, 50}, {16, 32}, 9);
    const Matrix a = filled(wanted, wanted.visibility());
    Matrix b(stage.gbuffer().tiles(), stage.vpls().size());
    mir::InlineExecutor executor;
    fill_visibility(b, stage.gbuffer(), stage.vpls(), stage.visibility(), executor,
                    mir::InstructionSet::baseline);
    std::size_t different = 0;
    const auto whole = mir::BlockedLayout::of(wanted.gbuffer().tiles()[0]);
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t) {
        const mir::Tile tile = stage.gbuffer().tiles()[t];
        const auto layout = mir::BlockedLayout::of(tile);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x)
                for (mir::VplIndex j = 0; j < 9; ++j)
                    different += a.view().sees(0, whole(tile.x + x, tile.y + y), j) ==
                                         b.view().sees(t, layout(x, y), j)
                                     ? 0
                                     : 1;
    }
    CHECK(different == 0);
}

TEST_CASE("Black VPLs and black surfaces have bits like others") {
    Stage stage({20, 20}, {16, 16}, 3);
    const Matrix wanted = filled(stage, stage.visibility());
    std::vector<mir::Vpl> black;
    for (mir::VplIndex j = 0; j < 3; ++j) black.push_back({stage.vpls()[j]});
    for (mir::Vpl& vpl : black) vpl.intensity = {};
    mir::BlockedGBuffer<mir::Lambert::Params> dark({20, 20}, {16, 16});
    for (mir::TileIndex t = 0; t < dark.tiles().size(); ++t)
        for (mir::LuxelIndex i = 0; i < dark.view(t).size(); ++i)
            dark.store(t, i, stage.gbuffer().view(t).hit(i), {});
    Matrix found(dark.tiles(), 3);
    mir::InlineExecutor executor;
    fill_visibility(found, dark, mir::span_of(black), stage.visibility(), executor);
    for (mir::TileIndex t = 0; t < dark.tiles().size(); ++t)
        for (std::uint32_t g = 0; g < dark.view(t).size() / 16; ++g)
            for (mir::VplIndex j = 0; j < 3; ++j)
                REQUIRE(found.view().mask(t, g, j) == wanted.view().mask(t, g, j));
}

TEST_CASE("Filling asks for no more than the concepts say") {
    const mir::archetype::TiledGBuffer gbuffer{mir::archetype::make};
    Matrix matrix(gbuffer.tiles(), 2);
    mir::archetype::Executor executor{mir::archetype::make};
    fill_visibility(matrix, gbuffer, mir::archetype::VplSet{mir::archetype::make},
                    mir::archetype::Visibility{mir::archetype::make}, executor);
    for (mir::LuxelIndex i = 0; i < 256; ++i) CHECK(matrix.view().sees(0, i, 1));
}

TEST_CASE("Memory is bounded before it is taken, and counted without overflow") {
    const std::vector<mir::Tile> tiles{{0, 0, 33, 16}, {33, 0, 7, 5}};
    CHECK(Matrix::bytes_for(tiles, 100) == 4 * 256 * 100 / 8);
    CHECK(Matrix(tiles, 100).bytes() == 4 * 256 * 100 / 8);
    mir::Limits limits;
    limits.visibility_bytes = 4 * 256 * 100 / 8 - 1;
    try {
        const Matrix too_large(tiles, 100, limits);
        FAIL("a matrix passed the limit");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::limit_exceeded);
        CHECK(std::string(e.what()).find("Limits::visibility_bytes") != std::string::npos);
    }
    constexpr std::uint32_t most = 0xffffffffu;
    const std::vector<mir::Tile> huge{{0, 0, 0xfffffff0u, 0xfffffff0u}};
    CHECK(Matrix::bytes_for(huge, most) == std::numeric_limits<std::uint64_t>::max());
}

TEST_CASE("A matrix of other luxels or VPLs is refused") {
    const Stage stage({20, 20}, {16, 16}, 5);
    mir::InlineExecutor executor;
    Matrix other_vpls(stage.gbuffer().tiles(), 6);
    CHECK_THROWS_AS(
        fill_visibility(other_vpls, stage.gbuffer(), stage.vpls(), stage.visibility(), executor),
        mir::Error);
    Matrix other_tiles({{0, 0, 16, 16}}, 5);
    CHECK_THROWS_AS(
        fill_visibility(other_tiles, stage.gbuffer(), stage.vpls(), stage.visibility(), executor),
        mir::Error);
}
