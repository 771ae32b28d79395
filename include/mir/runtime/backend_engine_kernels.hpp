// SPDX-License-Identifier: MIT
#pragma once

// Members of BackendEngine that start kernels: for files that the backend's compiler compiles.

#include "mir/kernels/background_pass.hpp"
#include "mir/kernels/direct_light_pass.hpp"
#include "mir/kernels/word_shading.hpp"
#include "mir/resident/backend_metropolis.hpp"
#include "mir/resident/ray_structures.hpp"
#include "mir/resident/trace_primary_hits.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/runtime/backend_engine.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"

#include <numeric>

namespace mir {

template <Backend B, Bsdf F, Executor E>
BackendEngine<B, F, E>::BackendEngine(const B& backend, const Scene& scene,
                                      const WorldGeometry& geometry, E& executor,
                                      MakeTree make_tree, const BackendEngineOptions& options,
                                      StageClock& clock)
    : backend_(backend),
      geometry_(geometry),
      executor_(executor),
      make_tree_(std::move(make_tree)),
      options_(geometry.is_masked() ? options.masked() : options),
      clock_(clock),
      table_(scene),
      sigma_(static_cast<float>(sigma_of(magnitude_of(geometry.bounds())))),
      queue_(backend.queue()),
      geometry_there_(backend, queue_, geometry),
      surfaces_(backend, queue_, table_),
      masks_(backend, queue_, geometry.masks()) {
    queue_.record().sync();
    if (options_.kd_tree) {
        tree_.emplace(backend, queue_, host_tree());
        queue_.record().sync();
    }
    if (options_.needs_bvh()) build_bvh();
}

template <Backend B, Bsdf F, Executor E>
void BackendEngine<B, F, E>::build_bvh() {
    const auto stage = clock_.measure(&StageSeconds::build);
    bvh_.emplace(backend_, queue_, geometry_, geometry_there_.view());
    if (!options_.shafts) return;
    short_bvh_.emplace(backend_, queue_, bvh_->view(), bvh_->node_count());
    queue_.record().sync();
}

template <Backend B, Bsdf F, Executor E>
const KdTree& BackendEngine<B, F, E>::host_tree() const {
    if (!host_tree_) {
        const auto stage = clock_.measure(&StageSeconds::build);
        host_tree_.emplace(make_tree_());
    }
    return *host_tree_;
}

template <Backend B, Bsdf F, Executor E>
template <class Use>
auto BackendEngine<B, F, E>::with_rays(const Use& use) const {
    if (geometry_.is_masked())
        return use(WideRays<space, AlphaMaskView<space>>{bvh_->view(), masks_there()});
    if (tree_) return use(KdRays<space>{tree_->view()});
    return use(WideRays<space>{bvh_->view()});
}

template <Backend B, Bsdf F, Executor E>
template <class Use>
auto BackendEngine<B, F, E>::with_tile_visibility(const Use& use) const {
    return with_rays([&](const auto& rays) {
        const auto sight = rays.sight();
        using Sight = std::remove_const_t<decltype(sight)>;
        if constexpr (std::is_same_v<Sight, WideBvhVisibility<space, AlphaMaskView<space>>>) {
            return use(sight);
        } else {
            if (!short_bvh_) return use(sight);
            return use(ClusterVisibility<Sight>{short_bvh_->view(), sigma_, sight});
        }
    });
}

template <Backend B, Bsdf F, Executor E>
double BackendEngine<B, F, E>::visible_area(const Camera& camera, float aspect) const {
    auto areas = backend_.template buffer<double>(AreaRays::count);
    std::vector<double> here(AreaRays::count);
    const WaitAtEnd wait(queue_);
    with_rays([&](const auto& rays) {
        queue_.for_each(AreaRays::count,
                        AreaPass{AreaRays(camera, aspect),
                                 LuxelTracer{rays.caster(geometry_there_.view()), surfaces_.view()},
                                 areas.data()});
    });
    queue_.download(areas, std::span(here));
    queue_.record().sync();
    return std::accumulate(here.begin(), here.end(), 0.0);
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::trace(Extent extent, Extent tile, std::uint32_t first_row,
                                   const CameraRays& rays) const -> Luxels {
    Luxels luxels{{backend_, extent, tile}, {}};
    with_rays([&](const auto& structure) {
        trace_primary_hits(queue_, luxels.gbuffer, first_row, rays.luxel_rays(),
                           LuxelTracer{structure.caster(geometry_there_.view()), surfaces_.view()},
                           {});
    });
    queue_.record().sync();
    return luxels;
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::upload(const BlockedGBuffer<Params>& gbuffer) const -> Luxels {
    const Tile& first = gbuffer.tiles().front();
    Luxels luxels{{backend_, gbuffer.extent(), {first.width, first.height}}, {}};
    luxels.gbuffer.upload(queue_, gbuffer);
    queue_.record().sync();
    return luxels;
}

template <Backend B, Bsdf F, Executor E>
void BackendEngine<B, F, E>::find_visible(Luxels& luxels, VplSpan<Space::host> vpls,
                                          const Limits& limits) const {
    UploadedVpls<B> there(backend_, vpls);
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    luxels.visibility.emplace(backend_, luxels.gbuffer.grid(), vpls.size(), limits);
    with_tile_visibility([&](const auto& visibility) {
        luxels.visibility->find(queue_, luxels.gbuffer, there.view(), visibility);
    });
    queue_.record().sync();
}

template <Backend B, Bsdf F, Executor E>
void BackendEngine<B, F, E>::Response::add(const Luxels& luxels, VplSpan<Space::host> vpls,
                                           const VplShading<F>& shading) {
    UploadedVpls<B> there(engine_.backend_, vpls);
    const WaitAtEnd wait(engine_.queue_);
    there.send(engine_.queue_);
    sum_.add_band(engine_.queue_, luxels.gbuffer, there.view(), *luxels.visibility, shading);
    engine_.queue_.record().sync();
}

template <Backend B, Bsdf F, Executor E>
VplRecords BackendEngine<B, F, E>::sample_metropolis(const LightTable& lights, const PathView& view,
                                                     const MetropolisOptions& options,
                                                     const Limits& limits, Monitor* monitor) const {
    const UploadedLights<B> there(backend_, queue_, lights);
    const WaitAtEnd wait(queue_);
    ChainPortions portions;
    portions.bytes = options_.chain_bytes;
    return with_rays([&](const auto& rays) {
        using Rays = std::remove_cvref_t<decltype(rays)>;
        const PathWorld<F, typename Rays::Caster, typename Rays::Sight, space> world(
            geometry_there_.view(), there.view(), surfaces_.view(),
            rays.caster(geometry_there_.view()), rays.sight(), view.camera, view.aspect,
            view.bound);
        return BackendMetropolis(backend_, world, options, limits, portions)
            .sample(queue_, monitor);
    });
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::black(const Luxels& luxels) const -> Layer {
    Layer layer(backend_, luxels.gbuffer.grid());
    queue_.clear(layer.words());
    queue_.record().sync();
    return layer;
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::direct(const Luxels& luxels, const LightTable& lights,
                                    const LuxelBand& band, DirectSamples samples) const -> Layer {
    const UploadedLights<B> there(backend_, queue_, lights);
    Layer layer(backend_, luxels.gbuffer.grid());
    const WaitAtEnd wait(queue_);
    with_rays([&](const auto& rays) {
        using Sight = typename std::remove_cvref_t<decltype(rays)>::Sight;
        const LuxelLight<F, Sight> light{
            {there.view(), geometry_there_.view(), rays.sight(), samples.emitters},
            {there.view(), rays.sight()},
            {there.view(), rays.sight(), samples.environment},
            band,
            samples.distant_vpls};
        for (TileIndex t = 0; t < luxels.gbuffer.tiles().size(); ++t) {
            const auto view = luxels.gbuffer.view(t);
            queue_.for_each(view.size(),
                            DirectLightPass{view, luxels.gbuffer.tiles()[t], light, layer.tile(t)});
        }
    });
    queue_.record().sync();
    return layer;
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::emission(const Luxels& luxels, const EnvironmentTable& around,
                                      const CameraRays& rays, std::uint32_t first_row) const
    -> Layer {
    const UploadedEnvironment<B> there(backend_, queue_, around);
    Layer layer(backend_, luxels.gbuffer.grid());
    const WaitAtEnd wait(queue_);
    for (TileIndex t = 0; t < luxels.gbuffer.tiles().size(); ++t) {
        const auto view = luxels.gbuffer.view(t);
        queue_.for_each(view.size(), EmissionPass{view, layer.tile(t)});
        if (!around.empty())
            queue_.for_each(view.size(),
                            BackgroundPass{view, luxels.gbuffer.tiles()[t], first_row,
                                           rays.luxel_rays(), there.view(), layer.tile(t)});
    }
    queue_.record().sync();
    return layer;
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::coverage(const Luxels& luxels) const -> Layer {
    Layer layer(backend_, luxels.gbuffer.grid());
    const WaitAtEnd wait(queue_);
    for (TileIndex t = 0; t < luxels.gbuffer.tiles().size(); ++t) {
        const auto view = luxels.gbuffer.view(t);
        queue_.for_each(view.size(), CoveragePass{view, layer.tile(t)});
    }
    queue_.record().sync();
    return layer;
}

/// As declared.
template <Backend B, Bsdf F, Executor E>
template <Shading S>
auto BackendEngine<B, F, E>::light(const Luxels& luxels, VplSpan<Space::host> vpls,
                                   const S& shading, Monitor* monitor) const -> Layer {
    if (luxels.knows_visibility()) return light_known(luxels, vpls, shading, monitor);
    return layer_of(luxels, light_traced(luxels, vpls, shading, monitor));
}

/// The second kernel of RCVP alone, from bits that stayed on the backend.
template <Backend B, Bsdf F, Executor E>
template <Shading S>
auto BackendEngine<B, F, E>::light_known(const Luxels& luxels, VplSpan<Space::host> vpls,
                                         const S& shading, Monitor* monitor) const -> Layer {
    const auto& gbuffer = luxels.gbuffer;
    Layer layer(backend_, gbuffer.grid());
    UploadedVpls<B> there(backend_, vpls);
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
        if (monitor != nullptr) monitor->check();
        const auto view = gbuffer.view(t);
        queue_.for_each_group(view.size() / LaneGroup::width,
                              WordShading{view, there.view(), luxels.visibility->tile(t).words,
                                          shading, layer.tile(t)});
        queue_.record().sync();
        const Tile tile = gbuffer.tiles()[t];
        if (monitor != nullptr)
            monitor->contributions += std::uint64_t{tile.width} * tile.height * vpls.size();
    }
    return layer;
}

template <Backend B, Bsdf F, Executor E>
template <Shading S>
Image<Rgb> BackendEngine<B, F, E>::light_traced(const Luxels& luxels, VplSpan<Space::host> vpls,
                                                const S& shading, Monitor* monitor) const {
    switch (options_.scheduler) {
        case BackendScheduler::os: {
            const Tile& first = luxels.gbuffer.tiles().front();
            BlockedGBuffer<Params> here(luxels.extent(), {first.width, first.height});
            luxels.gbuffer.download(queue_, here);
            queue_.record().sync();
            return reconstruct(sched::ShadingOnly{backend_, executor_, monitor}, here, vpls,
                               visibility(), shading);
        }
        case BackendScheduler::rc:
            return with_rays([&](const auto& rays) {
                return reconstruct(sched::Reconstruct{backend_, monitor}, luxels.gbuffer, vpls,
                                   rays.sight(), shading);
            });
        case BackendScheduler::rcvp:
            break;
    }
    return with_tile_visibility([&](const auto& visibility) {
        return reconstruct(sched::ReconstructVisibilityParallel{backend_, monitor}, luxels.gbuffer,
                           vpls, visibility, shading);
    });
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::layer_of(const Luxels& luxels, const Image<Rgb>& image) const
    -> Layer {
    Layer layer(backend_, luxels.gbuffer.grid());
    std::vector<std::uint32_t> words(layer.words().size());
    for (TileIndex t = 0; t < luxels.gbuffer.tiles().size(); ++t) {
        const Tile tile = luxels.gbuffer.tiles()[t];
        const auto layout = BlockedLayout::of(tile);
        const SoaView<Rgb> to{words.data() + LayerView::first_word(layer.grid(), t), layout.size()};
        executor_.for_each(tile.height, [&](std::size_t row) {
            const auto y = static_cast<std::uint32_t>(row);
            for (std::uint32_t x = 0; x < tile.width; ++x)
                to.store(layout(x, y), image(tile.x + x, tile.y + y));
        });
    }
    const WaitAtEnd wait(queue_);
    queue_.upload(std::span<const std::uint32_t>(words), layer.words());
    queue_.record().sync();
    return layer;
}

template <Backend B, Bsdf F, Executor E>
void BackendEngine<B, F, E>::add(Layer& sum, const Layer& layer) const {
    const auto luxels = static_cast<std::uint32_t>(sum.grid().size());
    queue_.for_each(luxels, AddLayer{{sum.words().data(), luxels}, {layer.view().words, luxels}});
    queue_.record().sync();
}

template <Backend B, Bsdf F, Executor E>
std::vector<double> BackendEngine<B, F, E>::row_luminances(const Layer& layer) const {
    const std::uint32_t rows = layer.grid().image.height;
    auto sums = backend_.template buffer<double>(rows);
    std::vector<double> here(rows);
    const WaitAtEnd wait(queue_);
    queue_.for_each(rows, RowLuminance{layer.view(), sums.data()});
    queue_.download(sums, std::span(here));
    queue_.record().sync();
    return here;
}

template <Backend B, Bsdf F, Executor E>
auto BackendEngine<B, F, E>::picture(Extent band, const CameraRays& rays, const Filter& filter,
                                     std::uint32_t layers) const -> Picture {
    return {{backend_, queue_, rays.grid, filter, rays.seed, layers, band.height},
            {backend_, rays.grid, rays.camera}};
}

template <Backend B, Bsdf F, Executor E>
void BackendEngine<B, F, E>::film(Picture& picture, std::uint32_t first_row,
                                  std::vector<Layer>& layers) const {
    picture.film.add_rows(queue_, first_row, layers);
}

template <Backend B, Bsdf F, Executor E>
void BackendEngine<B, F, E>::guides(Picture& picture, const Luxels& luxels) const {
    picture.guides.template add<F>(queue_, luxels.gbuffer);
}

template <Backend B, Bsdf F, Executor E>
void BackendEngine<B, F, E>::bring_home(Picture& picture, Guides& guides) const {
    picture.film.bring_home(queue_, executor_);
    picture.guides.bring_home(queue_, executor_, guides);
}

}  // namespace mir
