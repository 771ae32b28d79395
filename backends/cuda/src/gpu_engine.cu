// SPDX-License-Identifier: MIT
#include "gpu_engine.hpp"
#include "mir/accel/kd_ray_finder.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/kernels/word_shading.hpp"
#include "mir/resident/backend_metropolis.hpp"
#include "mir/resident/trace_primary_hits.hpp"
#include "mir/resident/uploaded_lights.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"

namespace mir::cuda {

namespace {

using DeviceVpls = sched::detail::UploadedVpls<Backend>;

}  // namespace

template <Bsdf F>
auto GpuEngine<F>::make_luxels(const BlockedGBuffer<Params>& gbuffer) const -> Luxels {
    Luxels luxels;
    const Tile& first = gbuffer.tiles().front();
    luxels.gbuffer.emplace(backend_, gbuffer.extent(), Extent{first.width, first.height});
    return luxels;
}

template <Bsdf F>
auto GpuEngine<F>::trace(BlockedGBuffer<Params>& gbuffer, std::uint32_t first_row,
                         const CameraRays& rays) const -> Luxels {
    Luxels luxels = make_luxels(gbuffer);
    trace_primary_hits<Backend, F>(queue_, *luxels.gbuffer, first_row, rays.luxel_rays(),
                                   KdRayFinder<Space::device>{tree_.view()}, geometry_.view(),
                                   surfaces_.view());
    luxels.gbuffer->download(queue_, gbuffer);
    queue_.sync();
    return luxels;
}

template <Bsdf F>
auto GpuEngine<F>::upload(const BlockedGBuffer<Params>& gbuffer) const -> Luxels {
    Luxels luxels = make_luxels(gbuffer);
    luxels.gbuffer->upload(queue_, gbuffer);
    queue_.sync();
    return luxels;
}

template <Bsdf F>
void GpuEngine<F>::find_visible(Luxels& luxels, VplSpan<Space::host> vpls,
                                const Limits& limits) const {
    DeviceVpls there(backend_, vpls);
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    luxels.visibility.emplace(backend_, luxels.gbuffer->grid(), vpls.size(), limits);
    with_tile_visibility([&](const auto& visibility) {
        luxels.visibility->find(queue_, *luxels.gbuffer, there.view(), visibility);
    });
    queue_.sync();
}

template <Bsdf F>
void GpuEngine<F>::Response::add(const Luxels& luxels, VplSpan<Space::host> vpls,
                                 const VplShading<F>& shading) {
    DeviceVpls there(engine_.backend_, vpls);
    const WaitAtEnd wait(engine_.queue_);
    there.send(engine_.queue_);
    sum_.add_band(engine_.queue_, *luxels.gbuffer, there.view(), *luxels.visibility, shading);
    engine_.queue_.sync();
}

template <Bsdf F>
template <Shading S>
Image<Rgb> GpuEngine<F>::light(const Luxels& luxels, const BlockedGBuffer<Params>& gbuffer,
                               VplSpan<Space::host> vpls, const S& shading,
                               Monitor* monitor) const {
    if (luxels.knows_visibility()) return light_known(luxels, vpls, shading, monitor);
    switch (scheduler_) {
        case GpuScheduler::os:
            return reconstruct(sched::ShadingOnly{backend_, executor_, monitor}, gbuffer, vpls,
                               visibility(), shading);
        case GpuScheduler::rc:
            return reconstruct(sched::Reconstruct{backend_, monitor}, *luxels.gbuffer, vpls,
                               device_visibility(), shading);
        case GpuScheduler::rcvp:
            break;
    }
    return with_tile_visibility([&](const auto& visibility) {
        return reconstruct(sched::ReconstructVisibilityParallel{backend_, monitor}, *luxels.gbuffer,
                           vpls, visibility, shading);
    });
}

/// The second kernel of RCVP alone, from bits that stayed on the GPU.
template <Bsdf F>
template <Shading S>
Image<Rgb> GpuEngine<F>::light_known(const Luxels& luxels, VplSpan<Space::host> vpls,
                                     const S& shading, Monitor* monitor) const {
    const auto& gbuffer = *luxels.gbuffer;
    Image<Rgb> image(gbuffer.extent());
    const std::uint32_t most = gbuffer.view(0).size();
    DeviceVpls there(backend_, vpls);
    auto sums = backend_.template buffer<std::uint32_t>(std::size_t{SoaView<Rgb>::words} * most);
    auto at_home =
        backend_.template host_buffer<std::uint32_t>(std::size_t{SoaView<Rgb>::words} * most);
    const WaitAtEnd wait(queue_);
    there.send(queue_);
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
        if (monitor != nullptr) monitor->check();
        const auto view = gbuffer.view(t);
        queue_.for_each_group(view.size() / LaneGroup::width,
                              WordShading{view, there.view(), luxels.visibility->tile(t).words,
                                          shading, SoaView<Rgb>{sums.data(), view.size()}});
        queue_.download(sums, at_home.span().first(std::size_t{SoaView<Rgb>::words} * view.size()));
        queue_.sync();
        const SoaView<const Rgb> radiance{at_home.span().data(), view.size()};
        const Tile tile = gbuffer.tiles()[t];
        sched::detail::write_tile(image, tile, [&](LuxelIndex i) { return radiance.load(i); });
        if (monitor != nullptr)
            monitor->contributions += std::uint64_t{tile.width} * tile.height * vpls.size();
    }
    return image;
}

template <Bsdf F>
VplRecords GpuEngine<F>::sample_metropolis(const LightTable& lights, const PathView& view,
                                           const MetropolisOptions& options, const Limits& limits,
                                           Monitor* monitor) const {
    using Caster = KdRayCaster<Space::device>;
    using Sight = KdTreeVisibility<Space::device>;
    const UploadedLights<Backend> there(backend_, queue_, lights);
    const WaitAtEnd wait(queue_);
    const PathWorld<F, Caster, Sight, Space::device> world(
        geometry_.view(), there.view(), surfaces_.view(), Caster(geometry_.view(), tree_.view()),
        device_visibility(), view.camera, view.aspect, view.bound);
    ChainPortions portions;
    portions.bytes = std::min<std::uint64_t>(free_memory(queue_.device()) / 4, portions.bytes);
    return BackendMetropolis(backend_, world, options, limits, portions).sample(queue_, monitor);
}

template class GpuEngine<Lambert>;
template class GpuEngine<CookTorrance>;
template Image<Rgb> GpuEngine<Lambert>::light(const Luxels&, const BlockedGBuffer<Params>&,
                                              VplSpan<Space::host>, const VplShading<Lambert>&,
                                              Monitor*) const;
template Image<Rgb> GpuEngine<Lambert>::light(const Luxels&, const BlockedGBuffer<Params>&,
                                              VplSpan<Space::host>, const RemovedByBound<Lambert>&,
                                              Monitor*) const;
template Image<Rgb> GpuEngine<CookTorrance>::light(const Luxels&, const BlockedGBuffer<Params>&,
                                                   VplSpan<Space::host>,
                                                   const VplShading<CookTorrance>&, Monitor*) const;
template Image<Rgb> GpuEngine<CookTorrance>::light(const Luxels&, const BlockedGBuffer<Params>&,
                                                   VplSpan<Space::host>,
                                                   const RemovedByBound<CookTorrance>&,
                                                   Monitor*) const;

}  // namespace mir::cuda
