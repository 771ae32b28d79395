// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/block_list.hpp"
#include "mir/blocks/luxel_block.hpp"
#include "mir/blocks/page_sight.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/error.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "mir/shading/contribution.hpp"

#include <algorithm>
#include <vector>

namespace mir {

namespace detail {

/// Bits of one block by single segments.
template <TiledGBuffer G, VplSet P, Visibility V>
void fill_block_by_segments(VisibilityMatrix& matrix, const G& gbuffer, const P& vpls,
                            const V& visibility, blocks::Block b) {
    constexpr std::uint32_t size = VisibilityMatrix::View::group_size;
    constexpr std::uint32_t count = VisibilityMatrix::View::groups_per_block;
    const auto luxels = gbuffer.view(b.tile);
    for (VplIndex j = 0; j < vpls.size(); ++j) {
        const Vpl vpl = vpls[j];
        for (std::uint32_t group = b.block * count; group < (b.block + 1) * count; ++group) {
            std::uint32_t mask = 0;
            for (std::uint32_t k = 0; k < size; ++k) {
                const Hit hit = luxels.hit(group * size + k);
                if (faces(hit, vpl) && visibility.visible(vpl.position, hit.position))
                    mask |= 1u << k;
            }
            matrix.store(b.tile, group, j, mask);
        }
    }
}

/// The same by packets, after VPLs that the block cannot face were thrown away.
template <TiledGBuffer G, VplSet P, PacketVisibility V>
void fill_block(VisibilityMatrix& matrix, const G& gbuffer, const P& vpls, const V& visibility,
                blocks::Block b) {
    using namespace blocks;
    const BoundedHitBlock block(gbuffer.view(b.tile).hits, b, [](std::uint32_t) { return true; });
    const BlockSight<V> sight(block, visibility);
    for (VplIndex j = 0; j < vpls.size(); ++j) {
        const Vpl vpl = vpls[j];
        if (block.cannot_face(vpl)) continue;
        const BlockMask mask = sight(vpl);
        for (std::uint32_t g = 0; g < groups_per_block; ++g)
            matrix.store(b.tile, b.block * groups_per_block + g, j, mask.packet[g]);
    }
}

/// The same of the blocks of a page, 256 of its luxels at a time.
template <TiledGBuffer G, VplSet P, BlockVisibility V>
void fill_page(VisibilityMatrix& matrix, const G& gbuffer, const P& vpls, const V& visibility,
               InstructionSet instructions, const blocks::PlacedPage& place) {
    using namespace blocks;
    const LuxelPage& page = place.page;
    PageSight<V> sight(gbuffer.view(place.tile).hits, page, visibility, instructions,
                       [](std::uint32_t) { return true; });
    constexpr std::uint32_t most = PageSight<V>::most_vpls;
    for (VplIndex first = 0; first < vpls.size(); first += most) {
        const std::uint32_t count = std::min(most, vpls.size() - first);
        std::uint32_t seen = sight.look(vpls, first, count, [](const Vpl&) { return true; });
        while (seen != 0) {
            const std::uint32_t k = mir::detail::pop_lowest(seen);
            for (std::uint32_t b = 0; b < page.blocks(); ++b) {
                const BlockMask mask = sight.seen(b, k);
                for (std::uint32_t g = 0; g < groups_per_block; ++g)
                    matrix.store(place.tile, page.block(b) * groups_per_block + g, first + k,
                                 mask.packet[g]);
            }
        }
    }
}

}  // namespace detail

/// Fills an empty `matrix` of the same tiles and VPLs: bit = faces() and visible(). What stays zero
/// need not be written. Packets and blocks are used where the visibility has them and the G-buffer
/// has planes; then the bits are those of visible() as far as the visibility keeps the axioms of
/// those faces. Black VPLs and surfaces are traced like others. The bits do not depend on
/// `executor` or `instructions`.
/// @throws Error(invalid_argument) when the matrix belongs to other tiles or VPLs.
template <TiledGBuffer G, VplSet P, Visibility V, Executor E>
void fill_visibility(VisibilityMatrix& matrix, const G& gbuffer, P vpls, V visibility, E& executor,
                     InstructionSet instructions = best_instruction_set()) {
    expects(matrix.tiles() == gbuffer.tiles().size() && matrix.vpls() == vpls.size(),
            "a visibility matrix was given luxels or VPLs that it was not made for (its bits would "
            "not fit); make it from the tiles of this G-buffer");
    if (vpls.size() == 0) return;
    constexpr bool has_planes = requires { gbuffer.view(0).hits.planes; };
    const auto for_each = [&](auto places, const auto& append, const auto& fill) {
        for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t)
            append(places, t, gbuffer.tiles()[t]);
        executor.for_each(places.size(), [&](std::size_t i) { fill(places[i]); });
    };
    if constexpr (BlockVisibility<V> && has_planes)
        for_each(std::vector<blocks::PlacedPage>{}, blocks::append_pages,
                 [&](const blocks::PlacedPage& page) {
                     run_with(instructions, [&] {
                         detail::fill_page(matrix, gbuffer, vpls, visibility, instructions, page);
                     });
                 });
    else
        for_each(std::vector<blocks::Block>{}, blocks::append_blocks, [&](blocks::Block block) {
            if constexpr (PacketVisibility<V> && has_planes)
                run_with(instructions,
                         [&] { detail::fill_block(matrix, gbuffer, vpls, visibility, block); });
            else
                detail::fill_block_by_segments(matrix, gbuffer, vpls, visibility, block);
        });
}

}  // namespace mir
