// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/core/space.hpp"
#include "mir/data/blocked_layout.hpp"

#include <cstddef>
#include <vector>

namespace mir {

/// Masks of one tile of a VisibilityMatrix: which luxels see which VPL. A view.
template <Space S>
struct TileMasks {
    static constexpr Space space = S;                ///< of the memory of the masks
    static constexpr std::uint32_t group_size = 16;  ///< luxels of one mask, 4 x 4 of the image
    /// Masks of a block and a VPL.
    static constexpr std::uint32_t groups_per_block = BlockedLayout::block_size / group_size;

    const std::uint16_t* masks = nullptr;  ///< of the tile, placed by index()
    std::uint32_t vpls = 0;                ///< number of VPLs

    /// Masks of a tile of `luxels` luxels, padding included.
    static constexpr std::size_t count(std::uint32_t luxels, std::uint32_t vpls) {
        return std::size_t{luxels / group_size} * vpls;
    }

    /// Place of a mask: block by block, and in a block VPL by VPL. Blocks are shaded in that order.
    [[nodiscard]] MIR_HD std::size_t index(std::uint32_t group, VplIndex j) const {
        return (std::size_t{group / groups_per_block} * vpls + j) * groups_per_block +
               group % groups_per_block;
    }
    /// True when luxel `i` (blocked index) faces and sees VPL `j`.
    [[nodiscard]] MIR_HD bool sees(LuxelIndex i, VplIndex j) const {
        return (masks[index(i / group_size, j)] >> (i % group_size) & 1u) != 0;
    }
};

/// View of a VisibilityMatrix; the model of KnownVisibility.
template <Space S>
struct VisibilityBits {
    static constexpr Space space = S;  ///< of the memory of the masks
    static constexpr std::uint32_t group_size = TileMasks<S>::group_size;  ///< luxels of a mask
    /// Masks of a block and a VPL.
    static constexpr std::uint32_t groups_per_block = TileMasks<S>::groups_per_block;

    const std::uint16_t* masks = nullptr;      ///< of all tiles, one after another
    const std::size_t* first_block = nullptr;  ///< of each tile
    std::uint32_t vpls = 0;                    ///< number of VPLs

    /// Bit k: luxel `group_size * group + k` of tile `t` faces and sees `j`.
    [[nodiscard]] MIR_HD std::uint32_t mask(TileIndex t, std::uint32_t group, VplIndex j) const {
        return masks[index(t, group, j)];
    }
    /// mask() of all groups of block `block` of tile `t`, side by side.
    [[nodiscard]] MIR_HD const std::uint16_t* block_masks(TileIndex t, std::uint32_t block,
                                                          VplIndex j) const {
        return masks + index(t, block * groups_per_block, j);
    }
    /// True when luxel `i` (blocked index) of tile `t` faces and sees VPL `j`.
    [[nodiscard]] MIR_HD bool sees(TileIndex t, LuxelIndex i, VplIndex j) const {
        return tile(t).sees(i, j);
    }

    /// Place of a mask among those of all tiles.
    [[nodiscard]] MIR_HD std::size_t index(TileIndex t, std::uint32_t group, VplIndex j) const {
        return first_mask(t) + tile(t).index(group, j);
    }

    /// The masks of tile `t`.
    [[nodiscard]] MIR_HD TileMasks<S> tile(TileIndex t) const {
        return {masks + first_mask(t), vpls};
    }

 private:
    [[nodiscard]] MIR_HD std::size_t first_mask(TileIndex t) const {
        return first_block[t] * vpls * groups_per_block;
    }
};

/// One bit per luxel and VPL: set where they face and see each other. It says nothing of materials
/// and intensities, so that those may change without a ray. Storing masks of different blocks from
/// different threads is safe.
class VisibilityMatrix {
 public:
    using View = VisibilityBits<Space::host>;  ///< what schedulers read

    /// Nobody sees anybody yet. `tiles` are those of the G-buffer.
    /// @throws Error(limit_exceeded) when Limits::visibility_bytes is less than bytes_for().
    VisibilityMatrix(const std::vector<Tile>& tiles, std::uint32_t vpls, const Limits& limits = {})
        : vpls_(vpls) {
        check_limit(bytes_for(tiles, vpls), limits.visibility_bytes, "visibility_bytes");
        first_block_.push_back(0);
        for (const Tile& t : tiles)
            first_block_.push_back(first_block_.back() + BlockedLayout::of(t).blocks());
        masks_.resize(first_block_.back() * vpls * View::groups_per_block);
    }

    /// Bytes that a matrix takes; the largest number where that overflows.
    static std::uint64_t bytes_for(const std::vector<Tile>& tiles, std::uint32_t vpls) {
        std::uint64_t blocks = 0;
        for (const Tile& t : tiles) {
            const auto layout = BlockedLayout::of(t);
            blocks += std::uint64_t{layout.blocks_x} * layout.blocks_y;
        }
        return saturating_mul(blocks, std::uint64_t{vpls} * (BlockedLayout::block_size / 8));
    }

    /// Valid until the matrix is moved or ends.
    [[nodiscard]] View view() const { return {masks_.data(), first_block_.data(), vpls_}; }
    /// Number of VPLs.
    [[nodiscard]] std::uint32_t vpls() const { return vpls_; }
    /// Number of tiles.
    [[nodiscard]] std::size_t tiles() const { return first_block_.size() - 1; }
    /// Bytes of masks held: bytes_for() of the same tiles and VPLs.
    [[nodiscard]] std::size_t bytes() const { return masks_.size() * sizeof(std::uint16_t); }

    /// Replaces a mask of sixteen luxels; see VisibilityBits::mask().
    void store(TileIndex t, std::uint32_t group, VplIndex j, std::uint32_t mask) {
        masks_[view().index(t, group, j)] = static_cast<std::uint16_t>(mask);
    }

 private:
    std::uint32_t vpls_;
    std::vector<std::size_t> first_block_;
    std::vector<std::uint16_t> masks_;
};

}  // namespace mir
