// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/kd/kd_tree.hpp"
#include "mir/resident/backend_film.hpp"
#include "mir/resident/backend_guides.hpp"
#include "mir/resident/backend_visibility.hpp"
#include "mir/resident/backend_wide_bvh.hpp"
#include "mir/resident/quantised_bvh.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/uploaded_trees.hpp"
#include "mir/resident/uploaded_triangles.hpp"
#include "runtime/render_frame.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mir {

template <Backend B>
class BackendCuts;

/// How contributions are arranged in time.
enum class BackendScheduler { os, rc, rcvp };

/// What a BackendFrame is to build and how it is to work. Pictures are the same for all of them,
/// bit for bit. Single rays know triangles that are not opaque through a wide hierarchy alone,
/// whatever the options say.
struct BackendFrameOptions {
    /// How VPLs light luxels whose visibility is not stored.
    BackendScheduler scheduler = BackendScheduler::rcvp;
    bool kd_tree = false;  ///< single rays by a kd-tree that the host builds; else by a wide
                           ///< hierarchy that the backend builds
    bool shafts = true;    ///< whole tiles by shafts through a wide hierarchy
    std::uint64_t chain_bytes = std::uint64_t{1} << 29;  ///< see ChainPortions

    /// True when a wide hierarchy is to be built.
    [[nodiscard]] bool needs_bvh() const { return shafts || !kd_tree; }
    /// The same for a scene that is not opaque.
    [[nodiscard]] BackendFrameOptions see_through() const {
        return {scheduler, false, shafts, chain_bytes};
    }
};

/// Features of every BackendFrame. One that learns another overrides what RenderFrame refuses.
inline constexpr FrameFeatures backend_features{};

/// A frame that stays in a backend's memory, from triangles to pixels. A developed pixel comes home
/// when no later band reaches it. What asks for rays on the host gets them from a kd-tree with the
/// same answers in every bit, built when it is asked for first. Members are defined in
/// runtime/backend_frame/, by what the backend's compiler takes long for.
template <Backend M, Bsdf B>
class BackendFrame final : public RenderFrame {
 public:
    /// Makes the kd-tree of a job's geometry, which frames may share. Never null.
    using MakeTree = std::function<std::shared_ptr<const KdTree>()>;

    /// Copies the scene to the backend and builds there. The surfaces of the job must be of this
    /// model. `make_tree` is called at most once.
    BackendFrame(RenderJob& job, const M& machine, MakeTree make_tree,
                 const BackendFrameOptions& options);

    [[nodiscard]] const AnyEngine& rays() override;
    [[nodiscard]] double visible_area() override;
    [[nodiscard]] VplRecords sample_chains(const MetropolisOptions& options, float bound) override;
    [[nodiscard]] VplRecords sample_light_paths(const InstantRadiosityOptions& options) override;
    [[nodiscard]] PathLuminance light_path_luminance(const VplRecords& sampled,
                                                     float bound) override;
    [[nodiscard]] std::vector<CausticSplat> trace_caustics(const CausticPaths& paths,
                                                           std::uint64_t begin,
                                                           std::uint64_t end) override;

    /// Returns with no work under way, as all members that take bands or layers.
    /// @throws Error(limit_exceeded) for 2^32 luxels and more.
    [[nodiscard]] BandPtr trace(Extent extent, Extent tile, std::uint32_t first_row) override;
    [[nodiscard]] BandPtr trace(const ProbeRays& probes) override;
    void find_visible(FrameBand& band, VplSpan<Space::host> vpls) override;
    void add_responses(const FrameBand& band, VplSpan<Space::host> vpls, float bound,
                       BandTurn& turn, ResponseSum& sum) override;

    [[nodiscard]] LayerPtr black(const FrameBand& band) override;
    [[nodiscard]] LayerPtr direct(const FrameBand& band, DirectSamples samples) override;
    [[nodiscard]] LayerPtr emission(const FrameBand& band) override;
    [[nodiscard]] LayerPtr coverage(const FrameBand& band) override;
    [[nodiscard]] LayerPtr light(const FrameBand& band, VplSpan<Space::host> vpls, VplKernel kernel,
                                 Monitor* monitor) override;
    [[nodiscard]] LayerPtr light_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                         Monitor* monitor) override;
    [[nodiscard]] LayerPtr residual(const FrameBand& band, float bound,
                                    std::span<const LayerPtr> bounces) override;
    [[nodiscard]] CausticLayers seen_caustics(const FrameBand& band,
                                              std::span<const LayerPtr> bounces) override;
    void add(FrameLayer& sum, const FrameLayer& layer) override;
    [[nodiscard]] std::vector<double> row_luminances(const FrameLayer& layer) override;

    [[nodiscard]] LayerPtr layer_of(const FrameBand& band, Image<Rgb> light) override {
        return upload(of(band), light);
    }
    void put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) override;
    [[nodiscard]] std::vector<Image<Rgb>> develop() override;
    void develop_rows(std::uint32_t first, std::uint32_t end,
                      std::vector<Image<Rgb>>& images) override;

 private:
    using Params = typename B::Params;
    using Vpls = VplSpan<Space::host>;
    static constexpr Space space = M::space;

    /// Luxels and, once found, which VPLs they see.
    struct Band final : FrameBand {
        explicit Band(BackendGBuffer<M, Params> luxels) : gbuffer(std::move(luxels)) {}
        [[nodiscard]] Extent extent() const override { return gbuffer.extent(); }
        [[nodiscard]] bool knows_visibility() const override { return visibility.has_value(); }

        BackendGBuffer<M, Params> gbuffer;
        std::optional<BackendVisibility<M>> visibility;
    };
    struct Layer final : FrameLayer {
        explicit Layer(BackendLayer<M> light) : words(std::move(light)) {}

        BackendLayer<M> words;
    };
    /// Pixels on their way home.
    struct Picture {
        BackendFilm<M> film;      ///< pixels of every layer
        BackendGuides<M> guides;  ///< those of the last band that are not at home yet
    };

    [[nodiscard]] static const Band& of(const FrameBand& band) {
        return dynamic_cast<const Band&>(band);
    }
    [[nodiscard]] static BackendLayer<M>& of(FrameLayer& layer) {
        return dynamic_cast<Layer&>(layer).words;
    }
    [[nodiscard]] static const BackendLayer<M>& of(const FrameLayer& layer) {
        return dynamic_cast<const Layer&>(layer).words;
    }

    /// Calls use(rays) with what single rays are traced by: KdRays or one of WideRays.
    template <class Use>
    auto with_rays(const Use& use) const;
    /// Calls use(visibility) with the best that there is for whole tiles.
    template <class Use>
    auto with_tile_visibility(const Use& use) const;

    template <class Rays>
    [[nodiscard]] BandPtr traced(Extent extent, Extent tile, std::uint32_t first_row,
                                 const Rays& camera);
    template <class Rays>
    [[nodiscard]] VplRecords sample_chains_through(const Rays& rays,
                                                   const MetropolisOptions& options, float bound);

    void build_bvh();
    void build_parts();
    [[nodiscard]] const KdTree& host_tree();
    [[nodiscard]] OpacityView<space> opacity_there() const {
        return {geometry_there_.view(), masks_.size() == 0 ? nullptr : masks_.data(),
                see_through_.size() == 0 ? nullptr : see_through_.data(),
                surfaces_.view().textures};
    }
    [[nodiscard]] BackendLayer<M> layer_for(const Band& band) const {
        return {machine_, band.gbuffer.grid()};
    }
    /// A layer that pass(luxels, words) makes of every tile.
    template <class MakePass>
    [[nodiscard]] LayerPtr layer_by(const FrameBand& band, const MakePass& pass);
    [[nodiscard]] LayerPtr light_known(const Band& band, Vpls vpls, VplKernel kernel,
                                       Monitor* monitor);
    [[nodiscard]] Image<Rgb> light_traced(const Band& band, Vpls vpls, VplKernel kernel,
                                          Monitor* monitor);
    [[nodiscard]] LayerPtr upload(const Band& band, const Image<Rgb>& image);

    RenderJob& job_;
    M machine_;
    MakeTree make_tree_;
    BackendFrameOptions options_;
    float sigma_;  ///< as shafts want it
    typename M::Queue queue_;
    UploadedGeometry<M> geometry_there_;
    UploadedLights<M> lights_;
    UploadedSurfaces<M, B> surfaces_;
    UploadedArray<M, AlphaMask> masks_;
    UploadedArray<M, SeeThrough> see_through_;
    std::shared_ptr<const KdTree> host_tree_;  ///< null until it is asked for
    std::optional<AnyEngine> rays_;
    std::optional<UploadedKdTree<M>> tree_;
    std::optional<BackendWideBvh<M>> bvh_;
    std::optional<QuantisedBvh<M>> short_bvh_;
    /// Where some triangle is not opaque, of the opaque ones; shafts go through it.
    std::optional<BackendWideBvh<M>> opaque_bvh_;
    std::optional<BackendWideBvh<M>> open_bvh_;  ///< of the others
    std::optional<QuantisedBvh<M>> short_open_bvh_;
    /// Of all VPLs, or of those of each bounce, which every band gathers.
    std::vector<std::pair<CutVpls, std::shared_ptr<BackendCuts<M>>>> cuts_;
    std::optional<Picture> picture_;
};

}  // namespace mir
