// SPDX-License-Identifier: MIT
#include "runtime/host_frame.hpp"

#include "mir/cuts/deviation_cut.hpp"
#include "mir/direct_light.hpp"
#include "mir/film/film.hpp"
#include "mir/film/guides.hpp"
#include "mir/glossy_light.hpp"
#include "mir/normalise/response.hpp"
#include "mir/reconstruct_cuts.hpp"
#include "mir/reshade.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/shading/glossy_shading.hpp"
#include "mir/shading/vsl_shading.hpp"
#include "mir/vsl_light.hpp"
#include "runtime/caustics_on_host.hpp"
#include "runtime/film_layers.hpp"
#include "runtime/host_band.hpp"
#include "runtime/luxel_coverage.hpp"
#include "runtime/pick_variance.hpp"
#include "runtime/residual_on_host.hpp"
#include "runtime/sample_vpls.hpp"
#include "runtime/seam_above.hpp"

#include <optional>
#include <type_traits>

namespace mir {
namespace {

using Vpls = VplSpan<Space::host>;

/// The stages of a render on the host, by the model of its surfaces.
template <Bsdf B>
class HostFrame final : public RenderFrame {
 public:
    HostFrame(RenderJob& job, const TracedScene& traced, HostScheduler scheduler)
        : RenderFrame(job, {sizeof(Hit) + sizeof(Surface<typename B::Params>), true}),
          job_(job),
          surfaces_(std::get<SurfaceTable<B>>(job.surfaces)),
          traced_(traced),
          scheduler_(scheduler) {}

    [[nodiscard]] const AnyEngine& rays() override { return traced_.rays(); }
    [[nodiscard]] double visible_area() override {
        return mir::visible_area(job_.rays.camera, job_.aspect(),
                                 LuxelTracer{rays().ray_caster(), surfaces_.view()});
    }
    [[nodiscard]] VplRecords sample_chains(const MetropolisOptions& options, float bound) override {
        return sample_chains_on_host(*this, options, bound);
    }
    [[nodiscard]] VplRecords sample_light_paths(const InstantRadiosityOptions& options) override {
        return sample_light_paths_on_host(*this, options);
    }
    [[nodiscard]] PathLuminance light_path_luminance(const VplRecords& sampled,
                                                     float bound) override {
        return light_path_luminance_on_host(*this, sampled, bound);
    }
    [[nodiscard]] std::vector<CausticSplat> trace_caustics(const CausticPaths& paths,
                                                           std::uint64_t begin,
                                                           std::uint64_t end) override {
        return trace_caustics_on_host(*this, paths, begin, end);
    }

    [[nodiscard]] BandPtr trace(Extent extent, Extent tile, std::uint32_t first_row) override {
        return traced(extent, tile, first_row, job_.rays);
    }
    [[nodiscard]] BandPtr trace(const ProbeRays& probes) override {
        return traced(probes.cells(), whole_blocks(probes.cells()), 0, probes);
    }
    void find_visible(FrameBand& band, Vpls vpls) override {
        auto& here = HostBand<B>::of(band);
        here.visibility.emplace(here.gbuffer.tiles(), vpls.size(), job_.settings.limits);
        traced_.fill_visibility(*here.visibility, LuxelsOf<B>{here.gbuffer}, vpls, job_.executor);
    }
    void add_responses(const FrameBand& band, Vpls vpls, float bound, BandTurn& turn,
                       ResponseSum& sum) override {
        const auto& here = HostBand<B>::of(band);
        const std::vector<ImageResponse> rows = block_row_responses(
            here.gbuffer, vpls, here.visibility->view(), VplShading<B>{bound}, job_.executor);
        turn.wait();
        sum.add_rows(band.extent(), rows);
    }

    [[nodiscard]] LayerPtr black(const FrameBand& band) override {
        return host_layer(Image<Rgb>(band.extent()));
    }
    [[nodiscard]] LayerPtr direct(const FrameBand& band, DirectSamples samples) override {
        return host_layer(direct_light<B>(
            HostBand<B>::of(band).gbuffer, job_.lights, rays().visibility(),
            {band.first_row, job_.rays.grid, job_.settings.seed}, samples, job_.executor));
    }
    [[nodiscard]] LayerPtr emission(const FrameBand& band) override;
    [[nodiscard]] LayerPtr coverage(const FrameBand& band) override {
        return host_layer(luxel_coverage(HostBand<B>::of(band).gbuffer, job_.executor));
    }
    [[nodiscard]] LayerPtr light(const FrameBand& band, Vpls vpls, VplKernel kernel,
                                 Monitor* monitor) override;
    [[nodiscard]] LayerPtr light_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                         Monitor* monitor) override {
        return gathered_by_cuts(band, vpls, bound, nullptr, monitor);
    }
    [[nodiscard]] LayerPtr light_and_error_by_cuts(const FrameBand& band, const CutVpls& vpls,
                                                   float bound, FrameLayer& variance,
                                                   Monitor* monitor) override {
        Image<float> more;
        LayerPtr light = gathered_by_cuts(band, vpls, bound, &more, monitor);
        add_errors(HostLayer::of(variance), more, job_.executor);
        return light;
    }
    [[nodiscard]] LayerPtr residual(const FrameBand& band, float bound,
                                    std::span<const LayerPtr> bounces) override {
        std::vector<Image<Rgb>*> images;
        for (const LayerPtr& layer : bounces) images.push_back(&HostLayer::of(*layer));
        return host_layer(residual_on_host(*this, LuxelsOf<B>{HostBand<B>::of(band).gbuffer},
                                           band.first_row, bound, images));
    }
    [[nodiscard]] CausticLayers seen_caustics(const FrameBand& band,
                                              std::span<const LayerPtr> bounces) override {
        std::vector<Image<Rgb>*> images;
        for (const LayerPtr& layer : bounces) images.push_back(&HostLayer::of(*layer));
        CausticImages seen = seen_caustics_on_host(*this, band, images);
        return {host_layer(std::move(seen.direct)), host_layer(std::move(seen.indirect))};
    }
    [[nodiscard]] LayerPtr layer_of(const FrameBand& /*band*/, Image<Rgb> light) override {
        return host_layer(std::move(light));
    }
    void add(FrameLayer& sum, const FrameLayer& layer) override;
    [[nodiscard]] std::vector<double> row_luminances(const FrameLayer& layer) override;

    void keep_radii(std::vector<float>&& radii) override { radii_ = std::move(radii); }
    float keep_lobes(const VplRecords& records) override {
        VplLobes<B> kept(records, surfaces_, job_.settings.glossy.least_alpha());
        lobes_ = std::move(kept.lobes);
        return kept.widened_share;
    }

    void put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) override;
    [[nodiscard]] std::vector<Image<Rgb>> develop() override;
    void develop_rows(std::uint32_t first, std::uint32_t end,
                      std::vector<Image<Rgb>>& images) override;

 private:
    template <class Rays>
    [[nodiscard]] BandPtr traced(Extent extent, Extent tile, std::uint32_t first_row,
                                 const Rays& camera) {
        auto band = std::make_unique<HostBand<B>>(extent, tile);
        band->first_row = first_row;
        fill_gbuffer<B>(band->gbuffer, first_row, camera,
                        LuxelTracer{rays().ray_caster(), surfaces_.view()},
                        job_.lights.environment().view(), job_.executor);
        return band;
    }
    [[nodiscard]] LayerPtr gathered_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                            Image<float>* variance, Monitor* monitor);
    [[nodiscard]] Image<Rgb> light_of_points(const HostBand<B>& band, Vpls vpls, VplKernel kernel,
                                             Monitor* monitor);
    [[nodiscard]] Image<Rgb> light_of_shapes(const HostBand<B>& band, Vpls vpls, VplKernel kernel,
                                             Monitor* monitor);

    RenderJob& job_;
    const SurfaceTable<B>& surfaces_;
    const TracedScene& traced_;
    HostScheduler scheduler_;
    std::vector<float> radii_;
    std::vector<VplLobe<B>> lobes_;
    std::optional<Film> film_;
};

template <Bsdf B>
LayerPtr HostFrame<B>::gathered_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                        Image<float>* variance, Monitor* monitor) {
    return host_layer(reconstruct_cuts(
        HostBand<B>::of(band).gbuffer, vpls.tree(), rays().visibility(), VplShading<B>{bound},
        DeviationCut{job_.settings.picks}, {job_.settings.seed, band.first_row}, job_.executor,
        monitor, best_instruction_set(), variance));
}

template <Bsdf B>
LayerPtr HostFrame<B>::emission(const FrameBand& band) {
    Image<Rgb> image(band.extent());
    for_each_luxel(HostBand<B>::of(band).gbuffer, job_.executor,
                   [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                       image(x, y) = luxels.surface(i).emission;
                   });
    return host_layer(std::move(image));
}

template <Bsdf B>
LayerPtr HostFrame<B>::light(const FrameBand& band, Vpls vpls, VplKernel kernel, Monitor* monitor) {
    const auto& here = HostBand<B>::of(band);
    const bool by_points =
        kernel.kind == VplKernel::Kind::points || kernel.kind == VplKernel::Kind::removed;
    return host_layer(by_points ? light_of_points(here, vpls, kernel, monitor)
                                : light_of_shapes(here, vpls, kernel, monitor));
}

template <Bsdf B>
Image<Rgb> HostFrame<B>::light_of_points(const HostBand<B>& band, Vpls vpls, VplKernel kernel,
                                         Monitor* monitor) {
    const LuxelsOf<B> luxels{band.gbuffer};
    // All schedulers have the same bits. What is removed is no part of the picture that they differ
    // in time for, so it need not be compiled for each.
    if (kernel.kind == VplKernel::Kind::removed) {
        const sched::CpuBlocks blocks{job_.executor, monitor};
        return band.visibility ? reshade(blocks, band.gbuffer, vpls, *band.visibility,
                                         RemovedByBound<B>{kernel.bound})
                               : traced_.removed(blocks, luxels, vpls, kernel.bound);
    }
    const VplShading<B> shading{kernel.bound};
    return with_host_scheduler(
        scheduler_, job_.executor, monitor, [&]<class S>(const S& scheduler) {
            if (band.visibility)
                return reshade(scheduler, band.gbuffer, vpls, *band.visibility, shading);
            if constexpr (std::is_same_v<S, sched::CpuBlocks<AnyExecutor>>)
                return traced_.reconstruct(scheduler, luxels, vpls, kernel.bound);
            else
                return reconstruct(scheduler, band.gbuffer, vpls, rays().visibility(), shading);
        });
}

/// From the band's visibility.
template <Bsdf B>
Image<Rgb> HostFrame<B>::light_of_shapes(const HostBand<B>& band, Vpls vpls, VplKernel kernel,
                                         Monitor* monitor) {
    const VslSettings& vsl = job_.settings.vsl;
    Image<Rgb> light =
        kernel.kind == VplKernel::Kind::spheres
            ? vsl_light(band.gbuffer, *band.visibility, vpls, radii_,
                        VslShading<B>{0.0f, vsl.samples, job_.settings.seed}, job_.executor)
            : glossy_light<B>(band.gbuffer, *band.visibility, vpls, lobes_,
                              {kernel.bound, kernel.kind == VplKernel::Kind::removed_of_lobes},
                              job_.executor);
    if (monitor != nullptr) monitor->contributions += band.extent().area() * vpls.size();
    return light;
}

template <Bsdf B>
void HostFrame<B>::add(FrameLayer& sum, const FrameLayer& layer) {
    Image<Rgb>& all = HostLayer::of(sum);
    const Image<Rgb>& more = HostLayer::of(layer);
    job_.executor.for_each(all.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < all.width(); ++x) all(x, y) += more(x, y);
    });
}

template <Bsdf B>
std::vector<double> HostFrame<B>::row_luminances(const FrameLayer& layer) {
    const Image<Rgb>& image = HostLayer::of(layer);
    std::vector<double> rows(image.height());
    job_.executor.for_each(rows.size(), [&](std::size_t row) {
        for (std::uint32_t x = 0; x < image.width(); ++x)
            rows[row] += static_cast<double>(luminance(image(x, static_cast<std::uint32_t>(row))));
    });
    return rows;
}

template <Bsdf B>
void HostFrame<B>::put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) {
    FilmSeam* const seam = turn.seam();
    {
        const auto stage = job_.clock.measure(&StageSeconds::film);
        if (!film_)
            film_.emplace(job_.rays.grid, job_.settings.filter, job_.settings.seed, layers.size());
        std::vector<const Image<Rgb>*> images;
        for (const LayerPtr& layer : layers) images.push_back(&HostLayer::of(*layer));
        if (film_->rows() != band.first_row)
            film_->go_on(seam_above(job_, band.first_row, images.size(), seam));
        film_->add_rows(job_.executor, band.first_row, std::span<const Image<Rgb>* const>(images));
        if (seam != nullptr) *seam = film_->seam();
    }
    turn.pass();
    const auto stage = job_.clock.measure(&StageSeconds::guides);
    add_guides<B>(job_.result.guides, HostBand<B>::of(band).gbuffer, band.first_row, job_.rays.grid,
                  job_.rays.camera, job_.executor);
}

template <Bsdf B>
std::vector<Image<Rgb>> HostFrame<B>::develop() {
    std::vector<Image<Rgb>> layers;
    for (std::size_t l = 0; l < film_->layers(); ++l)
        layers.push_back(film_->develop(job_.executor, l));
    film_.reset();
    return layers;
}

template <Bsdf B>
void HostFrame<B>::develop_rows(std::uint32_t first, std::uint32_t end,
                                std::vector<Image<Rgb>>& images) {
    if (images.empty()) images.resize(film_->layers(), Image<Rgb>(job_.settings.image));
    for (std::size_t l = 0; l < images.size(); ++l)
        film_->develop_rows(job_.executor, l, first, end, images[l]);
}

}  // namespace

std::unique_ptr<RenderFrame> host_frame(RenderJob& job, const TracedScene& traced,
                                        HostScheduler scheduler) {
    return job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>&) -> std::unique_ptr<RenderFrame> {
        return std::make_unique<HostFrame<B>>(job, traced, scheduler);
    });
}

}  // namespace mir
