// SPDX-License-Identifier: MIT
#pragma once

#include "mir/fill_visibility.hpp"
#include "mir/runtime/band_engine.hpp"
#include "mir/runtime/loop_engine.hpp"
#include "mir/runtime/render_context.hpp"

#include <optional>

namespace mir {

/// Some rows of luxels, and who of them sees which VPL where that was asked.
template <Bsdf B>
struct ImageBand {
    std::uint32_t first_row = 0;                 ///< of luxels, in the whole image
    BlockedGBuffer<typename B::Params> gbuffer;  ///< all columns of the image
    std::optional<VisibilityMatrix> visibility;  ///< none before ImageBands::find_visible()

    /// True after ImageBands::find_visible().
    [[nodiscard]] bool knows_visibility() const { return visibility.has_value(); }
    /// Luxels of the band, without padding.
    [[nodiscard]] Extent extent() const { return gbuffer.extent(); }
};

/// The same where an engine keeps them (BandEngine).
template <BandEngine Engine>
struct KeptBand {
    std::uint32_t first_row = 0;     ///< of luxels, in the whole image
    typename Engine::Luxels luxels;  ///< all columns of the image

    /// True after ImageBands::find_visible().
    [[nodiscard]] bool knows_visibility() const { return luxels.knows_visibility(); }
    /// Luxels of the band, without padding.
    [[nodiscard]] Extent extent() const { return luxels.extent(); }
};

namespace detail {
template <Bsdf B, class Engine>
struct BandOf {
    using Type = ImageBand<B>;
};
template <Bsdf B, BandEngine Engine>
struct BandOf<B, Engine> {
    using Type = KeptBand<Engine>;
};
}  // namespace detail

/// A band of a render by an engine.
template <Bsdf B, class Engine>
using BandOf = typename detail::BandOf<B, Engine>::Type;

/// Cuts the luxels of an image into bands of rows, so that memory does not grow with the image, and
/// makes them one by one. Bands never cut blocks or pixels: nothing but memory depends on them.
template <Bsdf B, class Engine, Executor E>
class ImageBands {
 public:
    using Context = RenderContext<B, Engine, E>;  ///< of the render
    using Band = BandOf<B, Engine>;               ///< what make() returns

    /// `vpls` of which the visibility will be stored, 0 for none: bands become lower until the
    /// matrix of one fits into Limits::visibility_bytes.
    ImageBands(const Context& context, std::uint32_t vpls)
        : context_(context),
          tile_(whole_blocks(context.settings.tile.value_or(default_tile))),
          rows_(choose_rows(vpls)) {}

    /// Bands that the image is cut into; the last may be lower than the others.
    [[nodiscard]] std::uint32_t count() const { return (luxels().height + rows_ - 1) / rows_; }

    /// Luxels of the whole image.
    [[nodiscard]] Extent luxels() const { return context_.rays.grid.luxels(); }

    /// Traces the camera rays of band `i`.
    [[nodiscard]] Band make(std::uint32_t i) const;

    /// Traces the shadow rays of a band.
    /// @throws Error(limit_exceeded) when the bits do not fit into Limits::visibility_bytes.
    void find_visible(Band& band, VplSpan<Space::host> vpls) const;

    /// True when all bands with their visibility of `vpls` VPLs fit into Limits::visibility_bytes.
    [[nodiscard]] bool fit_together(std::uint32_t vpls) const;

 private:
    /// Luxels scheduled together unless the settings say.
    static constexpr Extent default_tile{256, 256};

    [[nodiscard]] std::uint32_t choose_rows(std::uint32_t vpls) const;
    [[nodiscard]] std::uint64_t matrix_bytes(std::uint32_t vpls) const;

    Context context_;
    Extent tile_;
    std::uint32_t rows_;
};

template <Bsdf B, class Engine, Executor E>
std::uint32_t ImageBands<B, Engine, E>::choose_rows(std::uint32_t vpls) const {
    // Some 2 million luxels at a time; whole pixels, and whole tiles unless those are huge.
    constexpr std::uint64_t luxels_per_band = 1u << 21;
    const std::uint64_t pixel = context_.rays.grid.per_pixel_y;
    const std::uint64_t grain = pixel * std::min<std::uint64_t>(tile_.height, 256);
    const std::uint64_t rows =
        std::max<std::uint64_t>(luxels_per_band / luxels().width / grain, 1) * grain;
    const std::uint64_t least = pixel * BlockedLayout::side;
    const std::uint64_t least_bytes = saturating_mul(
        VisibilityMatrix::bytes_for({{0, 0, luxels().width, BlockedLayout::side}}, vpls), pixel);
    const std::uint64_t fitting = matrix_bytes(vpls) / std::max<std::uint64_t>(least_bytes, 1);
    const std::uint64_t fitting_rows = saturating_mul(std::max<std::uint64_t>(fitting, 1), least);
    return static_cast<std::uint32_t>(
        std::min({rows, fitting_rows, std::uint64_t{luxels().height}}));
}

/// Of the matrix of one band. The host gains nothing by larger ones when bands are not kept.
template <Bsdf B, class Engine, Executor E>
std::uint64_t ImageBands<B, Engine, E>::matrix_bytes(std::uint32_t vpls) const {
    const std::uint64_t limit = context_.settings.limits.visibility_bytes;
    if (BandEngine<Engine> || fit_together(vpls)) return limit;
    return std::min(limit, std::uint64_t{1} << 30);
}

template <Bsdf B, class Engine, Executor E>
auto ImageBands<B, Engine, E>::make(std::uint32_t i) const -> Band {
    const auto stage = context_.clock.measure(&StageSeconds::gbuffer);
    const std::uint32_t first_row = i * rows_;
    const Extent extent{luxels().width, std::min(rows_, luxels().height - first_row)};
    if constexpr (BandEngine<Engine>) {
        return {first_row, context_.engine.trace(extent, tile_, first_row, context_.rays)};
    } else {
        Band band{first_row, BlockedGBuffer<typename B::Params>(extent, tile_), {}};
        fill_gbuffer<B>(band.gbuffer, first_row, context_.rays, context_.engine.ray_caster(),
                        context_.surfaces, context_.executor);
        return band;
    }
}

template <Bsdf B, class Engine, Executor E>
void ImageBands<B, Engine, E>::find_visible(Band& band, VplSpan<Space::host> vpls) const {
    const auto stage = context_.clock.measure(&StageSeconds::visibility);
    const std::uint64_t pairs = band.extent().area() * vpls.size();
    if (context_.monitor != nullptr) {
        context_.monitor->begin_loop(0);  // what the loop before has done is none of these
        context_.monitor->looping_contributions = pairs;
    }
    if constexpr (BandEngine<Engine>) {
        context_.engine.find_visible(band.luxels, vpls, context_.settings.limits);
    } else {
        band.visibility.emplace(band.gbuffer.tiles(), vpls.size(), context_.settings.limits);
        if constexpr (LoopEngine<Engine, B, E>)
            context_.engine.fill_visibility(*band.visibility, band.gbuffer, vpls,
                                            context_.executor);
        else
            fill_visibility(*band.visibility, band.gbuffer, vpls, context_.engine.visibility(),
                            context_.executor);
    }
    if (context_.monitor == nullptr) return;
    context_.monitor->looping_contributions = 0;
    context_.monitor->contributions += pairs;
}

template <Bsdf B, class Engine, Executor E>
bool ImageBands<B, Engine, E>::fit_together(std::uint32_t vpls) const {
    const std::uint64_t padded = whole_blocks(luxels()).area();
    const std::uint64_t surface_bytes = sizeof(Hit) + sizeof(Surface<typename B::Params>);
    const std::uint64_t limit = context_.settings.limits.visibility_bytes;
    return saturating_mul(padded, 8 * surface_bytes + vpls) / 8 <= limit;
}

}  // namespace mir
