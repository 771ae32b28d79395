// SPDX-License-Identifier: MIT
//
// The engine's render targets as mir reads them: where they lie, without a copy.
#pragma once

#include "rasteriser.hpp"

#include <glm/gtc/packing.hpp>
#include <mir/concepts/gbuffer.hpp>
#include <mir/core/ray.hpp>
#include <mir/data/blocked_layout.hpp>
#include <mir/shading/material_params.hpp>

#include <cstring>

namespace engine {

// region: view
/// The pixels of a tile. mir asks for luxel i, which BlockedLayout says the place of.
struct TileView {
    static constexpr mir::Space space = mir::Space::host;
    using Surface = mir::Surface<mir::CookTorrance::Params>;

    const GBuffer* image;
    mir::Tile tile;
    mir::Vec3 eye;
    float ray_offset;  ///< metres

    [[nodiscard]] std::uint32_t size() const { return mir::BlockedLayout::of(tile).size(); }

    /// Reads the first target alone.
    [[nodiscard]] mir::Hit hit(mir::LuxelIndex i) const {
        const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
        if (at.x >= tile.width || at.y >= tile.height) return {};  // padding of ragged tiles
        const auto g = read<GeometryPixel>(image->geometry, at);
        if (g.normal == 0) return {};  // nothing was drawn
        const mir::Vec3 n = unpack_normal(g.normal);
        return {mir::lift({g.position[0], g.position[1], g.position[2]}, n, ray_offset), n};
    }

    [[nodiscard]] Surface surface(mir::LuxelIndex i) const {
        const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
        const auto g = read<GeometryPixel>(image->geometry, at);
        const auto m = read<MaterialPixel>(image->material, at);
        const auto real = [](std::uint16_t half) { return glm::unpackHalf1x16(half); };
        mir::MaterialFactors factors;
        factors.base_color = {real(m.albedo[0]), real(m.albedo[1]), real(m.albedo[2])};
        factors.roughness = real(m.roughness);
        factors.metallic = real(m.metallic);
        const mir::Vec3 position(g.position[0], g.position[1], g.position[2]);
        return {unpack_normal(g.normal),
                glm::normalize(eye - position),
                {},
                material_params(factors, mir::CookTorrance{})};
    }

 private:
    template <class Pixel>
    [[nodiscard]] Pixel read(const Target& target, mir::LuxelPlace at) const {
        Pixel pixel;
        std::memcpy(&pixel, target.pixel(tile.x + at.x, tile.y + at.y), sizeof pixel);
        return pixel;
    }
};
static_assert(mir::GBuffer<TileView>);

/// The whole image, which must outlive it.
class ImageView {
 public:
    ImageView(const GBuffer& image, mir::Vec3 eye, float ray_offset)
        : image_(image),
          eye_(eye),
          ray_offset_(ray_offset),
          tiles_(mir::cut_into_tiles(extent(), {64, 64})) {}

    [[nodiscard]] mir::Extent extent() const {
        return {image_.geometry.width(), image_.geometry.height()};
    }
    [[nodiscard]] const std::vector<mir::Tile>& tiles() const { return tiles_; }
    [[nodiscard]] TileView view(mir::TileIndex t) const {
        return {&image_, tiles_[t], eye_, ray_offset_};
    }

 private:
    const GBuffer& image_;
    mir::Vec3 eye_;
    float ray_offset_;
    std::vector<mir::Tile> tiles_;
};
static_assert(mir::TiledGBuffer<ImageView>);
// endregion: view

}  // namespace engine
