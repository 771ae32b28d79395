// SPDX-License-Identifier: MIT
#include "runtime/render_discs.hpp"

#include "mir/micro/gather_light.hpp"
#include "mir/micro/make_surfels.hpp"
#include "mir/micro/split_patches.hpp"
#include "mir/micro/surfel_albedo.hpp"
#include "mir/micro/surfel_bounces.hpp"
#include "mir/micro/surfel_direct_light.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "mir/micro/triangle_gather.hpp"
#include "mir/runtime/picture_bytes.hpp"
#include "mir/runtime/row_errors.hpp"
#include "runtime/direct_noise.hpp"
#include "runtime/film_layers.hpp"
#include "runtime/host_band.hpp"
#include "runtime/image_bands.hpp"
#include "runtime/indirect_probes.hpp"
#include "runtime/light_correction.hpp"
#include "runtime/row_luminances.hpp"

namespace mir {
namespace {

/// A render from discs, for surfaces of one model.
template <Bsdf B>
class DiscRender {
 public:
    /// What is passed in must outlive it; `machine` may be null.
    DiscRender(RenderFrame& frame, const SurfaceTable<B>& surfaces, DiscGather* machine)
        : frame_(frame),
          job_(frame.job()),
          surfaces_(surfaces),
          rays_(frame.rays()),
          machine_(machine) {}

    /// Renders; to be called once.
    RenderResult run();

 private:
    static void add(Image<Rgb>& sum, const Image<Rgb>& light) {
        for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum.pixels()[i] += light.pixels()[i];
    }
    static std::vector<double> luminances_of(const Image<Rgb>& image) {
        std::vector<double> all;
        for (const Rgb& light : image.pixels())
            all.push_back(static_cast<double>(luminance(light)));
        return all;
    }

    using Radiance = std::vector<SurfelRadiance>;
    using Luxels = BlockedGBuffer<typename B::Params>;

    /// The discs, and their places on triangles for rays to these. Rays go there now or for a
    /// check.
    struct Discs {
        SurfelTree tree;
        std::optional<SurfelPlaces> places;
        float patch_area = 0.0f;  ///< of the largest patch, m^2
    };

    /// What luxels gather from.
    struct Sources {
        Discs discs;
        std::vector<Radiance> light;  ///< of the discs; luxels show the sum of all
    };

    [[nodiscard]] Discs make_discs();
    [[nodiscard]] std::vector<Radiance> light(const Discs& discs);
    void check(const Sources& sources);
    void render_band(RenderFrame& by, const FrameBand& band, const Sources& sources,
                     BandTurn& turn);
    [[nodiscard]] Image<Rgb> gather(const Luxels& gbuffer, const LuxelBand& rows,
                                    const Discs& discs, const Radiance& source);
    template <class Done = decltype(no_progress)>
    [[nodiscard]] Image<Rgb> gather_by_triangles(const Luxels& gbuffer, const LuxelBand& rows,
                                                 const Discs& discs, const Radiance& source,
                                                 const Done& done = no_progress);
    void correct(Image<Rgb>& light, const LuxelBand& rows);
    void append_indirect(RenderFrame& by, const FrameBand& band, const Sources& sources,
                         std::vector<LayerPtr>& layers);

    RenderFrame& frame_;
    RenderJob& job_;
    const SurfaceTable<B>& surfaces_;
    const AnyEngine& rays_;
    DiscGather* machine_;
    std::optional<LightCorrection> correction_;
};

template <Bsdf B>
RenderResult DiscRender<B>::run() {
    RenderStatistics& s = job_.result.statistics;
    s.luxels = job_.rays.grid.luxels().area();
    s.luxel_rows_per_pixel = job_.rays.grid.per_pixel_y;
    s.emitted_power = static_cast<float>(job_.lights.power());
    Sources sources{make_discs(), {}};
    sources.light = light(sources.discs);
    s.surfels = sources.discs.tree.surfels().size();
    const ImageBands bands = ImageBands::of_rows(frame_, 0);
    if (job_.monitor != nullptr)
        job_.monitor->planned_gathers = static_cast<std::uint64_t>(
            bands.share() * static_cast<double>(saturating_mul(s.luxels, sources.light.size())));
    if (job_.settings.micro.check != GatherCheck::none && !sources.light.empty()) check(sources);
    const std::size_t bounces = job_.settings.bounce_layers ? sources.light.size() + 1 : 0;
    check_picture(job_.settings, std::size_t{first_bounce_layer} + bounces);
    if (job_.settings.measure_missing) {
        const auto stage = job_.clock.measure(&StageSeconds::light_budget);
        s.direct_noise = direct_noise(frame_, job_.settings.direct_samples_per_luxel());
    }
    job_.begin_bands(bands.count());
    frame_.for_each_band(bands.count(), [&](RenderFrame& by, std::uint32_t i, BandTurn& turn) {
        job_.begin_band();
        render_band(by, *bands.make(by, i), sources, turn);
    });
    const auto stage = job_.clock.measure(&StageSeconds::film);
    keep_row_errors(job_.result.statistics, job_.result.luminances);
    take_layers(frame_.develop(), false, job_.result, job_.executor);
    return job_.take_result();
}

template <Bsdf B>
auto DiscRender<B>::make_discs() -> Discs {
    const auto stage = job_.clock.measure(&StageSeconds::surfels);
    SurfelOptions options;
    const double area = surface_area(job_.geometry) / job_.settings.micro.surfels;
    const bool exact = job_.settings.micro.luxels == MicroGather::exact;
    if (area > 0.0) options.max_area = static_cast<float>(exact ? area / 4.0 : area);
    Discs discs{{make_surfels(job_.geometry, options, job_.settings.limits, job_.executor),
                 SurfelAlbedo<B>(surfaces_, job_.geometry), SurfelTreeOptions{}, job_.executor},
                std::nullopt,
                area > 0.0 ? static_cast<float>(area) : options.max_area};
    if (exact || job_.settings.micro.check != GatherCheck::none)
        discs.places.emplace(discs.tree, job_.geometry);
    return discs;
}

/// What luxels gather from. Bounce by bounce where each has a layer, else the sum; nothing when
/// light may be reflected once alone.
template <Bsdf B>
auto DiscRender<B>::light(const Discs& discs) -> std::vector<Radiance> {
    if (job_.settings.bounce_limit() < 2) return {};
    const auto stage = job_.clock.measure(&StageSeconds::sampling);
    const MicroSettings& m = job_.settings.micro;
    SurfelBounceOptions options;
    options.last = static_cast<std::uint8_t>(job_.settings.bounce_limit() - 1);
    options.gather = m.gather;
    options.gather.rays = m.surfel_rays;
    options.gather.directions = GatherDirections::cosine;
    // Fewer rays are wider; they still stop where those of luxels do.
    options.gather.threshold *=
        static_cast<float>(m.surfel_rays) / static_cast<float>(m.directions());
    options.seed = job_.settings.seed;
    options.limits = job_.settings.limits;
    const float offset = job_.geometry.ray_offset();
    using Direct = SurfelDirectLight<B, AnyRayCaster, AnyVisibility>;
    const typename Direct::World world{job_.geometry, job_.lights, surfaces_, rays_.ray_caster(),
                                       rays_.visibility()};
    const Direct sketch(world, 8, ~job_.settings.seed);
    const Direct direct(world, job_.settings.direct_samples, job_.settings.seed);
    const SurfelPatches patches =
        split_patches(SurfelPatches(discs.tree, SurfelPatchOptions{discs.patch_area}), sketch,
                      offset, job_.executor);
    job_.result.statistics.patches = patches.size();
    const auto by = [&](const auto& rays) {
        return surfel_bounces(patches, direct, rays, offset, options, job_.executor);
    };
    std::vector<Radiance> bounces =
        m.luxels == MicroGather::exact
            ? by(TriangleRays<AnyRayCaster>{rays_.ray_caster(), &*discs.places})
            : by(TreeRays<Space::host>{discs.tree.view(), options.gather.shape});
    if (job_.settings.bounce_layers) return bounces;
    return {sum_of(bounces)};
}

/// Compares gathered light with that of paths at some luxels. Where rays do not end at triangles,
/// what that changes is found along the rays of the gather, the rest along those of the paths.
template <Bsdf B>
void DiscRender<B>::check(const Sources& sources) {
    const auto stage = job_.clock.measure(&StageSeconds::light_budget);
    const IndirectProbes<B> probes(job_, surfaces_, rays_);
    const SurfelPlaces& places = *sources.discs.places;
    const Radiance sum = sum_of(sources.light);
    auto [first, second] = probes.excess([&](const SurfacePoint& point) {
        return sum[places.leaf(point.triangle, point.barycentrics)].of(point.front);
    });
    if (job_.monitor != nullptr) job_.monitor->planned_gathers += probes.luxels().extent().area();
    const Image<Rgb> gathered = gather(probes.luxels(), probes.numbers(), sources.discs, sum);
    if (job_.settings.micro.luxels != MicroGather::exact) {
        const Image<Rgb> exact =
            gather_by_triangles(probes.luxels(), probes.numbers(), sources.discs, sum);
        for (std::size_t i = 0; i < exact.pixels().size(); ++i) {
            const Rgb stopped = gathered.pixels()[i] - exact.pixels()[i];
            first.pixels()[i] += stopped;
            second.pixels()[i] += stopped;
        }
    }
    Image<Rgb> truth(gathered.extent());
    for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
        first.pixels()[i] = gathered.pixels()[i] - first.pixels()[i];
        second.pixels()[i] = gathered.pixels()[i] - second.pixels()[i];
        truth.pixels()[i] = (first.pixels()[i] + second.pixels()[i]) * 0.5f;
    }
    const LightDifference difference =
        light_difference(luminances_of(gathered), luminances_of(first), luminances_of(second));
    job_.result.statistics.gather_difference = difference;
    // What few bright paths tell makes pictures worse.
    constexpr double most_error = 0.02;
    if (job_.settings.micro.check != GatherCheck::correct || difference.standard_error > most_error)
        return;
    correction_.emplace(gathered, truth, job_.executor);
    job_.result.statistics.gather_corrected = true;
}

template <Bsdf B>
void DiscRender<B>::render_band(RenderFrame& by, const FrameBand& band, const Sources& sources,
                                BandTurn& turn) {
    std::vector<LayerPtr> layers;
    {
        const auto stage = job_.clock.measure(&StageSeconds::direct);
        layers.push_back(by.direct(band, job_.settings.direct_samples_per_luxel()));
        layers.push_back(by.emission(band));
        layers.push_back(by.coverage(band));
    }
    append_indirect(by, band, sources, layers);
    const std::vector<double> indirect = by.row_luminances(*layers[indirect_layer]);
    const std::vector<double> direct = by.row_luminances(*layers[direct_layer]);
    turn.wait();
    add_luminances(job_, band, {indirect, {}, {}, {}, {}, direct});
    by.put(band, std::move(layers), turn);
}

/// By the machine where there is one, else on the executor.
template <Bsdf B>
Image<Rgb> DiscRender<B>::gather(const Luxels& gbuffer, const LuxelBand& rows, const Discs& discs,
                                 const Radiance& source) {
    const MicroSettings& m = job_.settings.micro;
    const auto done = [monitor = job_.monitor](std::uint64_t luxels) {
        if (monitor == nullptr) return;
        monitor->gathers.fetch_add(luxels, std::memory_order_relaxed);
        monitor->check();
    };
    if (machine_ == nullptr && m.luxels == MicroGather::exact)
        return gather_by_triangles(gbuffer, rows, discs, source, done);
    const auto by = [&](const auto& options) {
        if (machine_ != nullptr)
            return machine_->gather(LuxelsOf<B>{gbuffer}, discs.tree, source, options, rows, done);
        return gather_light<B>(gbuffer, discs.tree, source, options, rows, job_.executor, done);
    };
    if (m.luxels == MicroGather::buffers) return by(m.buffer());
    GatherOptions options = m.gather;
    if (m.luxels == MicroGather::exact) options.threshold = 0.0f;
    return by(options);
}

template <Bsdf B>
template <class Done>
Image<Rgb> DiscRender<B>::gather_by_triangles(const Luxels& gbuffer, const LuxelBand& rows,
                                              const Discs& discs, const Radiance& source,
                                              const Done& done) {
    // Micro-buffers have no rays of their own.
    const bool by_rays = job_.settings.micro.luxels != MicroGather::buffers;
    GatherOptions options = by_rays ? job_.settings.micro.gather : GatherOptions{};
    options.threshold = 0.0f;
    const TriangleGather<AnyRayCaster, B> by_triangles{
        {rays_.ray_caster(), &*discs.places}, source.data(), options};
    return gather_light(gbuffer, by_triangles, rows, job_.executor, done);
}

template <Bsdf B>
void DiscRender<B>::correct(Image<Rgb>& light, const LuxelBand& rows) {
    if (!correction_) return;
    const auto width = static_cast<float>(rows.grid.luxels().width);
    const auto height = static_cast<float>(rows.grid.luxels().height);
    job_.executor.for_each(light.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        const float v = (static_cast<float>(rows.first_row + y) + 0.5f) / height;
        for (std::uint32_t x = 0; x < light.width(); ++x)
            light(x, y) = light(x, y) * (*correction_)((static_cast<float>(x) + 0.5f) / width, v);
    });
}

/// The sum of all bounces and each of them, where asked for. The direct light comes first.
template <Bsdf B>
void DiscRender<B>::append_indirect(RenderFrame& by, const FrameBand& band, const Sources& sources,
                                    std::vector<LayerPtr>& layers) {
    const auto stage = job_.clock.measure(&StageSeconds::gather);
    const bool apart = job_.settings.bounce_layers;
    layers.push_back(by.black(band));
    Image<Rgb>& sum = HostLayer::of(*layers.back());
    if (apart) layers.push_back(host_layer(HostLayer::of(*layers[direct_layer])));
    const LuxelBand rows{band.first_row, job_.rays.grid, job_.settings.seed};
    for (const Radiance& source : sources.light) {
        Image<Rgb> light = gather(HostBand<B>::of(band).gbuffer, rows, sources.discs, source);
        correct(light, rows);
        add(sum, light);
        if (apart) layers.push_back(host_layer(std::move(light)));
    }
}

}  // namespace

RenderResult render_discs(RenderFrame& frame, DiscGather* machine) {
    return frame.job().with_surfaces([&]<Bsdf B>(const SurfaceTable<B>& surfaces) {
        return DiscRender<B>(frame, surfaces, machine).run();
    });
}

}  // namespace mir
