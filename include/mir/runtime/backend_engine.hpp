// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/kd/kd_tree.hpp"
#include "mir/core/monitor.hpp"
#include "mir/data/image.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/film/guides.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/resident/backend_film.hpp"
#include "mir/resident/backend_guides.hpp"
#include "mir/resident/backend_response.hpp"
#include "mir/resident/backend_wide_bvh.hpp"
#include "mir/resident/quantised_bvh.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/uploaded_trees.hpp"
#include "mir/runtime/band_engine.hpp"
#include "mir/runtime/sampling_engine.hpp"
#include "mir/runtime/stage_clock.hpp"
#include "mir/shading/direct_samples.hpp"
#include "mir/shading/vpl_shading.hpp"

#include <functional>
#include <optional>
#include <utility>

namespace mir {

/// How contributions are arranged in time.
enum class BackendScheduler { os, rc, rcvp };

/// What a BackendEngine is to build and how it is to work. Pictures are the same for all of them,
/// bit for bit. Shafts are decided by whole triangles: where some are masked, every ray is a single
/// one through a wide hierarchy, whatever the options say.
struct BackendEngineOptions {
    /// How VPLs light luxels whose visibility is not stored.
    BackendScheduler scheduler = BackendScheduler::rcvp;
    bool kd_tree = false;  ///< single rays by a kd-tree that the host builds; else by a wide
                           ///< hierarchy that the backend builds
    bool shafts = true;    ///< whole tiles by shafts through a wide hierarchy
    std::uint64_t chain_bytes = std::uint64_t{1} << 29;  ///< see ChainPortions

    /// True when a wide hierarchy is to be built.
    [[nodiscard]] bool needs_bvh() const { return shafts || !kd_tree; }
    /// The same for a scene with masks.
    [[nodiscard]] BackendEngineOptions masked() const {
        return {scheduler, false, false, chain_bytes};
    }
};

/// A scene in a backend's memory, and everything that a render does with it there: a frame leaves
/// it as finished pixels. Model of BandEngine and SamplingEngine. What asks for rays on the host
/// gets them from a kd-tree with the same answers in every bit, which is built when it is asked for
/// first. Members that start kernels are defined in backend_engine_kernels.hpp. One thread at a
/// time.
template <Backend B, Bsdf F, Executor E>
class BackendEngine {
 public:
    using Params = typename F::Params;  ///< what a luxel's surface keeps of the BSDF
    using Layer = BackendLayer<B>;      ///< radiance towards the viewer, W m^-2 sr^-1

    /// Luxels of a band and, once found, which VPLs they see.
    struct Luxels {
        BackendGBuffer<B, Params> gbuffer;               ///< in the backend's memory
        std::optional<BackendVisibility<B>> visibility;  ///< none before find_visible()

        /// True after find_visible().
        [[nodiscard]] bool knows_visibility() const { return visibility.has_value(); }
        /// Luxels of the band, without padding.
        [[nodiscard]] Extent extent() const { return gbuffer.extent(); }
    };

    /// ResponseSum on the backend.
    class Response {
     public:
        /// For an image of `luxels` and a set of `vpls` VPLs. The engine must outlive it.
        Response(const BackendEngine& engine, Extent luxels, std::uint32_t vpls)
            : engine_(engine), sum_(engine.backend_, luxels, vpls) {}

        /// Adds the rows below those added before; all work is done when it returns. `luxels` must
        /// know the visibility of these VPLs, whose intensities are not read.
        /// @throws Error(invalid_argument) when they do not fit or tiles cut blocks.
        void add(const Luxels& luxels, VplSpan<Space::host> vpls, const VplShading<F>& shading);
        /// Responses in the order of the VPLs.
        /// @throws Error(invalid_argument) before all rows were added.
        [[nodiscard]] std::vector<ImageResponse> mean() { return sum_.mean(engine_.queue_); }

     private:
        const BackendEngine& engine_;
        BackendResponse<B> sum_;
    };

    /// Pixels on their way home.
    struct Picture {
        BackendFilm<B> film;      ///< pixels of every layer
        BackendGuides<B> guides;  ///< those of the last band that are not at home yet
    };

    /// Makes the kd-tree of the geometry that the engine is made for.
    using MakeTree = std::function<KdTree()>;

    /// Copies the scene to the backend and builds there. `geometry`, `clock` and `executor`, on
    /// which the host works, must outlive the engine. `make_tree` is called at most once.
    BackendEngine(const B& backend, const Scene& scene, const WorldGeometry& geometry, E& executor,
                  MakeTree make_tree, const BackendEngineOptions& options, StageClock& clock);

    /// For the host; valid as long as the engine. Builds the kd-tree unless that was done.
    [[nodiscard]] KdTreeVisibility<Space::host> visibility() const {
        return {host_tree().view(), geometry_.alpha_masks()};
    }
    /// For the host; valid as long as the engine. Builds the kd-tree unless that was done.
    [[nodiscard]] KdRayCaster<Space::host> ray_caster() const {
        return {geometry_, host_tree().view(), geometry_.alpha_masks()};
    }
    /// Area of the surfaces that the camera sees through a film of `aspect` = width / height, m^2.
    [[nodiscard]] double visible_area(const Camera& camera, float aspect) const;

    /// First phase for the rows from `first_row` on: a band of `extent` luxels in tiles of `tile`.
    /// No work is under way when it returns, as with all members below that take luxels or layers.
    /// @throws Error(limit_exceeded) for 2^32 luxels and more.
    [[nodiscard]] Luxels trace(Extent extent, Extent tile, std::uint32_t first_row,
                               const CameraRays& rays) const;
    /// The luxels of a band that the host has filled, in the same tiles.
    [[nodiscard]] Luxels upload(const BlockedGBuffer<Params>& gbuffer) const;
    /// Keeps with a band which luxels and VPLs face and see each other.
    /// @throws Error(limit_exceeded) when the bits do not fit into Limits::visibility_bytes.
    void find_visible(Luxels& luxels, VplSpan<Space::host> vpls, const Limits& limits) const;
    /// An empty sum over an image of `luxels`; the engine must outlive it.
    [[nodiscard]] Response response(Extent luxels, std::uint32_t vpls) const {
        return {*this, luxels, vpls};
    }
    /// MetropolisSampler's records, for lights of the engine's scene. `monitor` may be null.
    /// @throws Error(invalid_argument) for options out of range; Error(cancelled).
    [[nodiscard]] VplRecords sample_metropolis(const LightTable& lights, const PathView& view,
                                               const MetropolisOptions& options,
                                               const Limits& limits, Monitor* monitor) const;

    /// No light.
    [[nodiscard]] Layer black(const Luxels& luxels) const;
    /// Next-event light from lamps and environment, and light without extent.
    [[nodiscard]] Layer direct(const Luxels& luxels, const LightTable& lights,
                               const LuxelBand& band, DirectSamples samples) const;
    /// What the luxels themselves emit, and the environment where they see nothing else.
    [[nodiscard]] Layer emission(const Luxels& luxels, const EnvironmentTable& around,
                                 const CameraRays& rays, std::uint32_t first_row) const;
    /// White where luxels see a surface.
    [[nodiscard]] Layer coverage(const Luxels& luxels) const;
    /// Light of VPLs: from the band's visibility where it is known, by tracing otherwise.
    /// `monitor`, which may be null, counts pairs of luxel and VPL.
    /// @throws Error(cancelled).
    template <Shading S>
    [[nodiscard]] Layer light(const Luxels& luxels, VplSpan<Space::host> vpls, const S& shading,
                              Monitor* monitor) const;
    /// sum += layer; both are of the same tiles.
    void add(Layer& sum, const Layer& layer) const;
    /// Sum of the luminance of each row's luxels, from left to right, W m^-2 sr^-1.
    [[nodiscard]] std::vector<double> row_luminances(const Layer& layer) const;

    /// An empty film of `layers` images, with guides. No later band is higher than `band`.
    [[nodiscard]] Picture picture(Extent band, const CameraRays& rays, const Filter& filter,
                                  std::uint32_t layers) const;
    /// Puts the next band on the film, all layers at once; bands come from top to bottom.
    /// @throws Error(invalid_argument) when band or layers do not fit.
    void film(Picture& picture, std::uint32_t first_row, std::vector<Layer>& layers) const;
    /// Makes the guides of that band, which must come home before the next is put there.
    void guides(Picture& picture, const Luxels& luxels) const;
    /// Copies finished pixels to the host, and the guides of the last band to `guides`.
    void bring_home(Picture& picture, Guides& guides) const;
    /// The images of the layers, once every band came home. Leaves the picture without.
    [[nodiscard]] std::vector<Image<Rgb>> develop(Picture& picture) const {
        return picture.film.take_images();
    }

 private:
    static constexpr Space space = B::space;

    [[nodiscard]] const KdTree& host_tree() const;
    [[nodiscard]] AlphaMaskView<space> masks_there() const {
        return {geometry_there_.view(), masks_.data(), surfaces_.view().textures};
    }
    void build_bvh();
    /// Calls use(rays) with what single rays are traced by: KdRays or one of WideRays.
    template <class Use>
    auto with_rays(const Use& use) const;
    /// Calls use(visibility) with the best that there is for whole tiles.
    template <class Use>
    auto with_tile_visibility(const Use& use) const;
    template <Shading S>
    [[nodiscard]] Layer light_known(const Luxels& luxels, VplSpan<Space::host> vpls,
                                    const S& shading, Monitor* monitor) const;
    template <Shading S>
    [[nodiscard]] Image<Rgb> light_traced(const Luxels& luxels, VplSpan<Space::host> vpls,
                                          const S& shading, Monitor* monitor) const;
    [[nodiscard]] Layer layer_of(const Luxels& luxels, const Image<Rgb>& image) const;

    B backend_;
    const WorldGeometry& geometry_;
    E& executor_;
    MakeTree make_tree_;
    BackendEngineOptions options_;
    StageClock& clock_;
    SurfaceTable<F> table_;
    float sigma_;  ///< as shafts want it
    mutable typename B::Queue queue_;
    UploadedGeometry<B> geometry_there_;
    UploadedSurfaces<B, F> surfaces_;
    UploadedArray<B, AlphaMask> masks_;
    mutable std::optional<KdTree> host_tree_;
    std::optional<UploadedKdTree<B>> tree_;
    std::optional<BackendWideBvh<B>> bvh_;
    std::optional<QuantisedBvh<B>> short_bvh_;
};

}  // namespace mir
