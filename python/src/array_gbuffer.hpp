// SPDX-License-Identifier: MIT
#pragma once

#include "arrays.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/core/ray.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/shading/material_params.hpp"

#include <nanobind/nanobind.h>

#include <optional>
#include <vector>

namespace mirpy {

/// The arrays of a G-buffer, read where they lie. To be made and to end with the GIL held.
struct GBufferArrays {
    /// Of a mapping from names to arrays.
    /// @throws ArgumentError for arrays that lack or do not fit, and for names that none has.
    explicit GBufferArrays(nanobind::handle mapping);

    FloatArray position;                       ///< (h, w, 3), metres, on the surface
    FloatArray normal;                         ///< (h, w, 3), unit, geometric; zero: background
    std::optional<FloatArray> shading_normal;  ///< (h, w, 3), unit; none: `normal`
    std::optional<FloatArray> view;            ///< (h, w, 3), unit, towards the viewer
    std::optional<FloatArray> eye;             ///< (3,): place of the viewer, instead of `view`
    FloatArray albedo;                         ///< (h, w, 3): base colour, 0..1
    std::optional<FloatArray> roughness;       ///< (h, w), 0..1; none: 1
    std::optional<FloatArray> metallic;        ///< (h, w), 0..1; none: 0
    std::optional<FloatArray> specular;        ///< (h, w), 0..1; none: 0, Lambertian
};

/// The luxels of a tile of such arrays. Model of mir::GBuffer.
struct ArrayTile {
    static constexpr mir::Space space = mir::Space::host;
    using Surface = mir::Surface<mir::CookTorrance::Params>;

    const GBufferArrays* arrays;
    mir::Tile tile;
    float ray_offset;  ///< metres

    [[nodiscard]] std::uint32_t size() const { return mir::BlockedLayout::of(tile).size(); }
    [[nodiscard]] mir::Hit hit(mir::LuxelIndex i) const;
    [[nodiscard]] Surface surface(mir::LuxelIndex i) const;
};

/// Such arrays as an image of luxels. Model of mir::TiledGBuffer; the arrays must outlive it.
class ArrayGBuffer {
 public:
    ArrayGBuffer(const GBufferArrays& arrays, float ray_offset)
        : arrays_(arrays),
          ray_offset_(ray_offset),
          tiles_(mir::cut_into_tiles(extent(), {64, 64})) {}

    [[nodiscard]] mir::Extent extent() const {
        return {static_cast<std::uint32_t>(arrays_.position.size(1)),
                static_cast<std::uint32_t>(arrays_.position.size(0))};
    }
    [[nodiscard]] const std::vector<mir::Tile>& tiles() const { return tiles_; }
    [[nodiscard]] ArrayTile view(mir::TileIndex t) const {
        return {&arrays_, tiles_[t], ray_offset_};
    }

 private:
    const GBufferArrays& arrays_;
    float ray_offset_;
    std::vector<mir::Tile> tiles_;
};

static_assert(mir::GBuffer<ArrayTile>);
static_assert(mir::TiledGBuffer<ArrayGBuffer>);

/// A place of a surface where segments leave it; metres, `normal` unit.
inline mir::Vec3 lifted(mir::Vec3 position, mir::Vec3 normal, float ray_offset) {
    return mir::lift(position, normal, mir::larger(ray_offset, mir::least_offset(position)));
}

}  // namespace mirpy
