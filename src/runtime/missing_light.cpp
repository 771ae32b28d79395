// SPDX-License-Identifier: MIT
#include "runtime/missing_light.hpp"

#include "mir/reference/path_tracer.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mir {
namespace {

/// By rays of the host, for surfaces of one model.
template <Bsdf B>
class MissingLight {
 public:
    /// What is passed in must outlive it.
    MissingLight(RenderJob& job, const SurfaceTable<B>& surfaces, const AnyEngine& rays,
                 float bound)
        : job_(job),
          limit_(job.settings.bounce_limit()),
          kept_(world(job, surfaces, rays), kept_options(bound)),
          removed_(world(job, surfaces, rays), removed_options(bound)) {}

    /// Traces the paths.
    [[nodiscard]] MissingShares measure() const {
        const ProbeRays probes{job_.rays.camera, job_.aspect(), places, job_.settings.seed};
        const Extent grid = probes.cells();
        Luminances at(static_cast<std::size_t>(grid.area()));
        job_.executor.for_each(grid.height, [&](std::size_t row) {
            const auto y = static_cast<std::uint32_t>(row);
            for (std::uint32_t x = 0; x < grid.width; ++x)
                add_place(probes(x, y), row * grid.width + x, at);
        });
        return {share_estimate(at.cut, at.kept), share_estimate(at.removed, at.kept)};
    }

 private:
    using Tracer = PathTracer<B, AnyRayCaster, AnyVisibility>;

    static constexpr std::uint32_t places = 2048;
    /// At each place, in search of what the bound removed: most meet nothing so near.
    static constexpr std::uint32_t near_directions = 16;

    /// Luminances of each place, W m^-2 sr^-1.
    struct Luminances {
        explicit Luminances(std::size_t n) : kept(n), cut(n), removed(n) {}
        std::vector<double> kept;
        std::vector<double> cut;
        std::vector<double> removed;
    };

    static typename Tracer::World world(const RenderJob& job, const SurfaceTable<B>& surfaces,
                                        const AnyEngine& rays) {
        return {job.geometry, job.lights, surfaces, rays.ray_caster(), rays.visibility()};
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
    [[nodiscard]] bool by_vpls() const { return job_.settings.direct == DirectLight::vpl; }

    void add_place(const Ray& ray, std::size_t place, Luminances& at) const {
        const auto first = kept_.luxel(ray);
        if (is_empty(first.hit)) return;
        Random random(job_.settings.seed, Stream::missing, place);
        const Bounces kept = trace(kept_, first, random);
        at.kept[place] = light_of(kept);
        at.cut[place] = luminance_of(kept[limit_ + 1u]);
        at.removed[place] = light_of(trace(removed_, first, random));
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

    RenderJob& job_;
    std::uint8_t limit_;
    Tracer kept_;
    Tracer removed_;
};

}  // namespace

MissingShares missing_light(RenderFrame& frame, float bound) {
    const AnyEngine& rays = frame.rays();
    return frame.job().with_surfaces([&]<Bsdf B>(const SurfaceTable<B>& surfaces) {
        return MissingLight<B>(frame.job(), surfaces, rays, bound).measure();
    });
}

}  // namespace mir
