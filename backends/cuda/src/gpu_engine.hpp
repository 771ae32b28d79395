// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd_ray_caster.hpp"
#include "mir/accel/kd_tree_visibility.hpp"
#include "mir/core/monitor.hpp"
#include "mir/cpu/tbb_executor.hpp"
#include "mir/cuda/backend.hpp"
#include "mir/data/image.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/resident/backend_response.hpp"
#include "mir/resident/uploaded_geometry.hpp"
#include "mir/resident/uploaded_kd_tree.hpp"
#include "mir/resident/uploaded_surfaces.hpp"
#include "mir/resident/uploaded_wide_bvh.hpp"
#include "mir/runtime/band_engine.hpp"
#include "mir/runtime/sampling_engine.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "mir/shaft/cluster_visibility.hpp"

namespace mir::cuda {

/// How contributions are arranged in time.
enum class GpuScheduler { os, rc, rcvp };

/// Luxels of a band on the GPU and, once found, which VPLs they see.
template <Bsdf F>
struct GpuLuxels {
    std::optional<BackendGBuffer<Backend, typename F::Params>> gbuffer;
    std::optional<BackendVisibility<Backend>> visibility;

    [[nodiscard]] bool knows_visibility() const { return visibility.has_value(); }
};

/// A scene on a GPU and on the host: its kd-tree in both memories, with the same answers in every
/// bit. Model of BandEngine and SamplingEngine. Members that start kernels are defined in
/// gpu_engine.cu for the models of Bsdf and Shading that renderers use. One thread at a time.
template <Bsdf F>
class GpuEngine {
 public:
    using Params = typename F::Params;
    using Luxels = GpuLuxels<F>;

    /// ResponseSum on the GPU.
    class Response {
     public:
        Response(const GpuEngine& engine, Extent luxels, std::uint32_t vpls)
            : engine_(engine), sum_(engine.backend_, luxels, vpls) {}

        void add(const Luxels& luxels, VplSpan<Space::host> vpls, const VplShading<F>& shading);
        [[nodiscard]] std::vector<ImageResponse> mean() { return sum_.mean(engine_.queue_); }

     private:
        const GpuEngine& engine_;
        BackendResponse<Backend> sum_;
    };

    /// Copies everything to the GPU. `geometry`, the tree over it and `executor`, on which OS
    /// traces, must outlive the engine. With a `bvh`, visibility is found by shafts through it, and
    /// by single segments through the tree where those decide nothing.
    GpuEngine(const Backend& backend, const Scene& scene, const WorldGeometry& geometry,
              const KdTree& tree, const WideBvh* bvh, cpu::TbbExecutor& executor,
              GpuScheduler scheduler)
        : backend_(backend),
          executor_(executor),
          scheduler_(scheduler),
          host_geometry_(geometry),
          host_tree_(tree),
          table_(scene),
          queue_(backend.queue()),
          tree_(backend, queue_, tree),
          geometry_(backend, queue_, geometry),
          surfaces_(backend, queue_, table_),
          sigma_(static_cast<float>(sigma_of(magnitude_of(geometry.bounds())))) {
        if (bvh != nullptr) bvh_.emplace(backend, queue_, *bvh);
        queue_.sync();
    }

    [[nodiscard]] KdTreeVisibility<Space::host> visibility() const { return {host_tree_.view()}; }
    [[nodiscard]] KdRayCaster<Space::host> ray_caster() const {
        return {host_geometry_, host_tree_.view()};
    }

    [[nodiscard]] Luxels trace(BlockedGBuffer<Params>& gbuffer, std::uint32_t first_row,
                               const CameraRays& rays) const;
    [[nodiscard]] Luxels upload(const BlockedGBuffer<Params>& gbuffer) const;
    void find_visible(Luxels& luxels, VplSpan<Space::host> vpls, const Limits& limits) const;
    [[nodiscard]] Response response(Extent luxels, std::uint32_t vpls) const {
        return {*this, luxels, vpls};
    }
    template <Shading S>
    [[nodiscard]] Image<Rgb> light(const Luxels& luxels, const BlockedGBuffer<Params>& gbuffer,
                                   VplSpan<Space::host> vpls, const S& shading,
                                   Monitor* monitor) const;
    [[nodiscard]] VplRecords sample_metropolis(const LightTable& lights, const PathView& view,
                                               const MetropolisOptions& options,
                                               const Limits& limits, Monitor* monitor) const;

 private:
    template <Shading S>
    [[nodiscard]] Image<Rgb> light_known(const Luxels& luxels, VplSpan<Space::host> vpls,
                                         const S& shading, Monitor* monitor) const;
    [[nodiscard]] Luxels make_luxels(const BlockedGBuffer<Params>& gbuffer) const;
    [[nodiscard]] KdTreeVisibility<Space::device> device_visibility() const {
        return {tree_.view()};
    }
    /// Calls use(visibility) with the best that there is for whole tiles.
    template <class Use>
    auto with_tile_visibility(const Use& use) const {
        if (!bvh_) return use(device_visibility());
        return use(ClusterVisibility<KdTreeVisibility<Space::device>>{bvh_->quantised(), sigma_,
                                                                      device_visibility()});
    }

    Backend backend_;
    cpu::TbbExecutor& executor_;
    GpuScheduler scheduler_;
    const WorldGeometry& host_geometry_;
    const KdTree& host_tree_;
    SurfaceTable<F> table_;
    mutable Queue queue_;
    UploadedKdTree<Backend> tree_;
    UploadedGeometry<Backend> geometry_;
    UploadedSurfaces<Backend, F> surfaces_;
    float sigma_;  ///< as shafts want it
    std::optional<UploadedWideBvh<Backend>> bvh_;
};

static_assert(BandEngine<GpuEngine<Lambert>> && SamplingEngine<GpuEngine<Lambert>>);

}  // namespace mir::cuda
