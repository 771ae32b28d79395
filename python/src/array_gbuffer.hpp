// SPDX-License-Identifier: MIT
#pragma once

#include "arrays.hpp"
#include "errors.hpp"
#include "luxel_arrays.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/data/blocked_layout.hpp"

#include <nanobind/nanobind.h>

#include <optional>
#include <vector>

namespace mirpy {

/// The arrays of a G-buffer, read where they lie. To be made and to end with the GIL held. `Array`
/// holds one, on the host or on a GPU.
template <class Array>
class GBufferArrays {
 public:
    /// Of a mapping from names to arrays; make(value, place, shape) makes one of them.
    /// @throws ArgumentError for arrays that lack or do not fit, and for names that none has.
    template <class Make>
    GBufferArrays(nanobind::handle mapping, const Make& make);

    [[nodiscard]] std::size_t height() const { return position_->size(0); }
    [[nodiscard]] std::size_t width() const { return position_->size(1); }
    /// For kernels, with surfaces lifted by `ray_offset`, metres.
    [[nodiscard]] LuxelArrays view(float ray_offset) const {
        const auto of = [](const std::optional<Array>& a) {
            return a ? a->view() : StridedFloats{};
        };
        return {of(position_), of(normal_),    of(shading_normal_), of(view_),     of(eye_),
                of(albedo_),   of(roughness_), of(metallic_),       of(specular_), ray_offset};
    }

 private:
    std::optional<Array> position_, normal_, shading_normal_, view_, eye_, albedo_;
    std::optional<Array> roughness_, metallic_, specular_;
};

/// The array of that name; none where there is none.
/// @throws ArgumentError for what is no dictionary, or has names that mean nothing.
nanobind::handle gbuffer_array(nanobind::handle mapping, const char* name);

template <class Array>
template <class Make>
GBufferArrays<Array>::GBufferArrays(nanobind::handle mapping, const Make& make) {
    using Shape = std::initializer_list<long>;
    const auto place_of = [](const char* name) { return "gbuffer." + std::string(name); };
    const auto found = [&](const char* name, Shape shape) -> std::optional<Array> {
        const nanobind::handle value = gbuffer_array(mapping, name);
        if (!value.is_valid() || value.is_none()) return std::nullopt;
        return make(value, place_of(name), shape);
    };
    const auto needed = [&](const char* name, Shape shape) {
        std::optional<Array> array = found(name, shape);
        if (!array)
            throw ArgumentError(place_of(name),
                                "it is missing; give " + shape_text(shape) + " floats");
        return array;
    };
    position_ = needed("position", {any_size, any_size, 3});
    normal_ = needed("normal", {any_size, any_size, 3});
    albedo_ = needed("albedo", {any_size, any_size, 3});
    const auto h = static_cast<long>(height());
    const auto w = static_cast<long>(width());
    if (h == 0 || w == 0) throw ArgumentError("gbuffer.position", "it has no pixels; give some");
    for (const auto* other : {&normal_, &albedo_})
        if ((*other)->size(0) != height() || (*other)->size(1) != width())
            throw ArgumentError(
                "gbuffer", "its arrays differ in size; give " + shape_text({h, w, 3}) + " each");
    shading_normal_ = found("shading_normal", {h, w, 3});
    view_ = found("view", {h, w, 3});
    eye_ = found("eye", {3});
    roughness_ = found("roughness", {h, w});
    metallic_ = found("metallic", {h, w});
    specular_ = found("specular", {h, w});
    if (!view_ && !eye_)
        throw ArgumentError("gbuffer.view",
                            "it is missing, and eye too (surfaces reflect towards the viewer); "
                            "give one of them");
}

/// The luxels of a tile of such arrays. Model of mir::GBuffer.
struct ArrayTile {
    static constexpr mir::Space space = mir::Space::host;
    using Surface = LuxelArrays::Surface;

    LuxelArrays arrays;
    mir::Tile tile;

    [[nodiscard]] std::uint32_t size() const { return mir::BlockedLayout::of(tile).size(); }
    [[nodiscard]] mir::Hit hit(mir::LuxelIndex i) const {
        const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
        if (at.x >= tile.width || at.y >= tile.height) return {};
        return arrays.hit(tile.y + at.y, tile.x + at.x);
    }
    [[nodiscard]] Surface surface(mir::LuxelIndex i) const {
        const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
        if (at.x >= tile.width || at.y >= tile.height) return {};
        return arrays.surface(tile.y + at.y, tile.x + at.x);
    }
};

/// Such arrays as an image of luxels. Model of mir::TiledGBuffer; the arrays must outlive it.
class ArrayGBuffer {
 public:
    ArrayGBuffer(const LuxelArrays& arrays, mir::Extent extent)
        : arrays_(arrays), extent_(extent), tiles_(mir::cut_into_tiles(extent, {64, 64})) {}

    [[nodiscard]] mir::Extent extent() const { return extent_; }
    [[nodiscard]] const std::vector<mir::Tile>& tiles() const { return tiles_; }
    [[nodiscard]] ArrayTile view(mir::TileIndex t) const { return {arrays_, tiles_[t]}; }

 private:
    LuxelArrays arrays_;
    mir::Extent extent_;
    std::vector<mir::Tile> tiles_;
};

static_assert(mir::GBuffer<ArrayTile>);
static_assert(mir::TiledGBuffer<ArrayGBuffer>);

}  // namespace mirpy
