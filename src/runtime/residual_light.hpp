// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/light_of_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/runtime/settings.hpp"

namespace mir {

/// Light that the bound keeps from luxels, traced back by paths, for host and device. They leave
/// each luxel as its BSDF says: f cos max(0, 1 - b/G) / p times the light that the point they meet
/// sends back, which is that of a path tracer without bound. Unbiased; surfaces met reflect with
/// their full BSDF, so what is added is what the bound removed where those are Lambertian, as VPLs
/// are, or where VPLs keep a lobe that was not widened. Source: Kollig and Keller, "Illumination in
/// the presence of weak singularities", MCQMC 2004, with paths instead of the recursion. Bits
/// depend on seed and luxel alone. Const use from any thread.
template <Bsdf B, class R, Visibility V>
class ResidualLight {
 public:
    using World = typename PathTracer<B, R, V>::World;  ///< what paths run through

    /// Of the luxels of a band under `bound`, m^-2.
    ResidualLight(const World& world, const RenderSettings& settings, float bound,
                  const LuxelBand& band)
        : tracer_(world, options_of(settings, bound)), band_(band) {}

    /// Radiance towards the viewer of the luxel at (x, y) of the band, W m^-2 sr^-1. It must not be
    /// empty. `layers`.add(b, light) is called with each part of it, of bounce b.
    template <class Layers>
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& surface,
                                        std::uint32_t x, std::uint32_t y,
                                        const Layers& layers) const {
        Random random = band_.luxel_numbers(x, y, Stream::residual);
        Sums<Layers> sums{layers, {}};
        tracer_.trace_to(sums, {hit, surface}, random);
        return sums.all.rgb();
    }

 private:
    template <class Layers>
    struct Sums {
        const Layers& layers;
        RgbSum all;

        MIR_HD void add(std::uint32_t bounce, Rgb light) {
            all += light;
            layers.add(bounce, light);
        }
    };

    static PathTracerOptions options_of(const RenderSettings& settings, float bound) {
        PathTracerOptions options;
        options.directions = settings.compensate_per_luxel();
        options.max_bounce = settings.bounce_limit();
        options.bound = bound;
        options.part = BoundPart::removed;
        options.bound_lamps = settings.direct == DirectLight::vpl;
        return options;
    }

    PathTracer<B, R, V> tracer_;
    LuxelBand band_;
};

/// One luxel: writes its ResidualLight, or black. Kernel over the luxels of a tile, padding
/// included.
template <class G, class Light>
struct ResidualPass {
    G luxels;                                ///< of the tile
    Tile tile;                               ///< in the band
    Light light;                             ///< ResidualLight
    SoaView<Rgb> out;                        ///< W m^-2 sr^-1 by blocked index
    std::size_t first;                       ///< word of the tile in each layer
    std::uint32_t* const* layers = nullptr;  ///< words of bounce 1, 2, ..., which are added to
    std::uint32_t layer_count = 0;           ///< of them

    /// Luxel `i` (blocked index) of the tile; black for the padding.
    MIR_HD void operator()(LuxelIndex i) const {
        out.store(i, light_of_luxel(luxels, tile, i,
                                    [&](const Hit& hit, const auto& surface, std::uint32_t x,
                                        std::uint32_t y) {
                                        return light(hit, surface, x, y, Layers{*this, i});
                                    }));
    }

 private:
    struct Layers {
        const ResidualPass& pass;
        LuxelIndex i;

        MIR_HD void add(std::uint32_t bounce, Rgb light) const {
            if (bounce - 1 >= pass.layer_count) return;
            const SoaView<Rgb> layer{pass.layers[bounce - 1] + pass.first, pass.out.stride};
            layer.store(i, layer.load(i) + light);
        }
    };
};

}  // namespace mir
