// SPDX-License-Identifier: MIT
#pragma once

#include "mir/reference/path_tracer.hpp"
#include "mir/runtime/render_context.hpp"
#include "mir/runtime/share_estimate.hpp"
#include "mir/sampling/probe_rays.hpp"
#include "mir/scene/light_table.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace mir {

/// What VPLs do not bring of the light that they stand for.
struct MissingShares {
    ShareEstimate cut;      ///< scattered more often than RenderSettings::bounce_limit(), of what
                            ///< the bound leaves
    ShareEstimate removed;  ///< by the bound, of what is scattered no more often
};

/// Measures what a render by VPLs leaves out: paths of the reference from two thousand places
/// spread over the image tell it, because VPLs know nothing of longer paths than theirs, and only
/// the few that lie next to a luxel tell what the bound removes. Indirect light counts, with
/// DirectLight::vpl direct light too. Surfaces that paths meet reflect with their full BSDF. Bits
/// depend on scene, settings and seed alone.
template <Bsdf B, class Engine, Executor E>
class MissingLight {
 public:
    using Context = RenderContext<B, Engine, E>;  ///< of the render

    /// Under `bound`, m^-2; the largest number for none. What is passed in must outlive it.
    MissingLight(const Context& context, const LightTable& lights, float bound)
        : context_(context),
          limit_(context.settings.bounce_limit()),
          kept_(world(context, lights), kept_options(bound)),
          removed_(world(context, lights), removed_options(bound)) {}

    /// Traces the paths, on the context's executor.
    [[nodiscard]] MissingShares measure() const {
        const ProbeRays rays{context_.rays.camera, context_.aspect(), places,
                             context_.settings.seed};
        const Extent grid = rays.cells();
        Ledger ledger(static_cast<std::size_t>(grid.area()));
        context_.executor.for_each(grid.height, [&](std::size_t row) {
            const auto y = static_cast<std::uint32_t>(row);
            for (std::uint32_t x = 0; x < grid.width; ++x)
                add_place(rays(x, y), row * grid.width + x, ledger);
        });
        return {share_estimate(ledger.cut, ledger.kept),
                share_estimate(ledger.removed, ledger.kept)};
    }

 private:
    using Tracer = PathTracer<B, decltype(std::declval<const Engine&>().ray_caster()),
                              decltype(std::declval<const Engine&>().visibility())>;

    static constexpr std::uint32_t places = 2048;
    /// At each place, in search of what the bound removed: most meet nothing so near.
    static constexpr std::uint32_t near_directions = 16;

    /// Luminances of each place, W m^-2 sr^-1.
    struct Ledger {
        explicit Ledger(std::size_t n) : kept(n), cut(n), removed(n) {}
        std::vector<double> kept;
        std::vector<double> cut;
        std::vector<double> removed;
    };

    static typename Tracer::World world(const Context& c, const LightTable& lights) {
        return {c.geometry, lights, c.surfaces, c.engine.ray_caster(), c.engine.visibility()};
    }
    [[nodiscard]] PathTracerOptions kept_options(float bound) const {
        PathTracerOptions options;
        // No path ends by chance before it reaches what is cut: few would otherwise tell.
        options.roulette_from = static_cast<std::uint8_t>(std::min(limit_ + 1, 33));
        options.bound = bound;
        options.bound_lamps = by_vpls();
        return options;
    }
    [[nodiscard]] PathTracerOptions removed_options(float bound) const {
        PathTracerOptions options;
        options.directions = near_directions;
        options.max_bounce = limit_;
        options.bound = bound;
        options.part = BoundPart::removed;
        options.bound_lamps = by_vpls();
        return options;
    }
    [[nodiscard]] bool by_vpls() const { return context_.settings.direct == DirectLight::vpl; }

    void add_place(const Ray& ray, std::size_t place, Ledger& ledger) const {
        const auto first = kept_.luxel(ray);
        if (is_empty(first.hit)) return;
        Random random(context_.settings.seed, Stream::missing, place);
        const Bounces kept = trace(kept_, first, random);
        ledger.kept[place] = light_of(kept);
        ledger.cut[place] = luminance_of(kept[limit_ + 1u]);
        ledger.removed[place] = light_of(trace(removed_, first, random));
    }

    /// By scattering events; the one behind the limit takes all that are more.
    using Bounces = std::array<RgbSum, 256>;

    [[nodiscard]] Bounces trace(const Tracer& tracer, const typename Tracer::Vertex& first,
                                Random& random) const {
        Bounces bounces{};
        tracer.trace(first, random, std::span(bounces).first(limit_ + 2u));
        return bounces;
    }
    static double luminance_of(const RgbSum& sum) {
        return static_cast<double>(luminance(sum.rgb()));
    }
    [[nodiscard]] double light_of(const Bounces& bounces) const {
        RgbSum sum;
        for (std::size_t b = by_vpls() ? 1 : 2; b <= limit_; ++b) sum += bounces[b];
        return luminance_of(sum);
    }

    Context context_;
    std::uint8_t limit_;
    Tracer kept_;
    Tracer removed_;
};

}  // namespace mir
