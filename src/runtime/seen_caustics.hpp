// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"
#include "mir/film/luxel_rays.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/runtime/settings.hpp"

namespace mir {

/// Caustics of a luxel, W m^-2 sr^-1.
struct CausticRadiance {
    Rgb direct;    ///< light of one bounce
    Rgb indirect;  ///< that of more
};

/// Caustics that luxels see in mirrors or through bodies of glass, for host and device. No light
/// path meets those luxels, so paths trace them back: PathPart::residual. Unbiased. Bits depend on
/// seed and luxel alone. Const use from any thread.
template <Bsdf B, class R, Visibility V>
class SeenCaustics {
 public:
    using World = PathTracerWorld<B, R, V>;  ///< what paths run through

    /// Of the luxels that these rays belong to.
    SeenCaustics(const World& world, const RenderSettings& settings, const LuxelRays& rays)
        : luxels_{world.caster, world.surfaces}, paths_(world, options_of(settings)), rays_(rays) {}

    /// Of the luxel at (x, y) of the whole luxel image; black where the camera sees it straight.
    /// `layers`.add(b, light) is called with each part of it, of bounce b > 1.
    template <class Layers>
    [[nodiscard]] MIR_HD CausticRadiance operator()(std::uint32_t x, std::uint32_t y,
                                                    const Layers& layers) const {
        const SeenLuxel seen = luxels_.luxel(rays_, x, y);
        if (seen.is_background || seen.is_straight) return {};
        const std::uint64_t luxel = std::uint64_t{y} * rays_.grid.luxels().width + x;
        Random random(rays_.seed, Stream::caustic, ~luxel);
        Sums<Layers> sums{layers, {}, {}};
        paths_.trace_to(sums, {luxels_.hit(seen), luxels_.surface(seen)}, random);
        return {sums.direct.rgb(), sums.indirect.rgb()};
    }

 private:
    template <class Layers>
    struct Sums {
        const Layers& layers;
        RgbSum direct;
        RgbSum indirect;

        MIR_HD void add(std::uint32_t bounce, Rgb light) {
            if (bounce <= 1) {
                direct += light;
                return;
            }
            indirect += light;
            layers.add(bounce, light);
        }
    };

    static PathTracerOptions options_of(const RenderSettings& settings) {
        PathTracerOptions options;
        options.paths = PathPart::residual;
        options.max_bounce = settings.bounce_limit();
        options.directions = settings.caustics;
        return options;
    }

    LuxelTracer<R, World::space, B> luxels_;
    PathTracer<B, R, V> paths_;
    LuxelRays rays_;
};

/// Element of the layers of bounces 1, 2, ... that takes light of `bounce` > 1: the last one takes
/// that of all later ones too. `count` where none does.
[[nodiscard]] MIR_HD constexpr std::uint32_t caustic_layer(std::uint32_t bounce,
                                                           std::uint32_t count) {
    if (count < 2) return count;
    return (bounce < count ? bounce : count) - 1;
}

/// One luxel: writes its SeenCaustics. Kernel over the luxels of a tile, padding included.
template <class Caustics>
struct SeenCausticsPass {
    Tile tile;                               ///< in the band
    std::uint32_t first_row = 0;             ///< of the band, in luxels of the whole image
    Caustics caustics;                       ///< SeenCaustics
    SoaView<Rgb> direct;                     ///< W m^-2 sr^-1 by blocked index
    SoaView<Rgb> indirect;                   ///< the same
    std::size_t first;                       ///< word of the tile in each layer
    std::uint32_t* const* layers = nullptr;  ///< words of bounce 1, 2, ..., which are added to
    std::uint32_t layer_count = 0;           ///< of them

    /// Luxel `i` (blocked index) of the tile; black for the padding.
    MIR_HD void operator()(LuxelIndex i) const {
        const LuxelPlace at = BlockedLayout::of(tile).place(i);
        CausticRadiance light;
        if (at.x < tile.width && at.y < tile.height)
            light = caustics(tile.x + at.x, first_row + tile.y + at.y, Layers{*this, i});
        direct.store(i, light.direct);
        indirect.store(i, light.indirect);
    }

 private:
    struct Layers {
        const SeenCausticsPass& pass;
        LuxelIndex i;

        MIR_HD void add(std::uint32_t bounce, Rgb light) const {
            const std::uint32_t b = caustic_layer(bounce, pass.layer_count);
            if (b == pass.layer_count) return;
            const SoaView<Rgb> layer{pass.layers[b] + pass.first, pass.direct.stride};
            layer.store(i, layer.load(i) + light);
        }
    };
};

}  // namespace mir
