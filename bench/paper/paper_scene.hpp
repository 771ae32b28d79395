// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/kd/kd_tree.hpp"
#include "mir/accel/wide/wide_options.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/surface_table.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/thread_executor.hpp"

#include <map>
#include <string>

namespace mirpaper {

/// Every scene is shaded with the full model, as in the paper.
using Bsdf = mir::CookTorrance;
using Shading = mir::VplShading<Bsdf>;
using GBuffer = mir::BlockedGBuffer<Bsdf::Params>;
using Executor = mirbench::ThreadExecutor;

/// A scene made ready for reconstruction, on the host alone: kd-tree, luxels and VPLs. Const use
/// from any thread but for vpls().
class PaperScene {
 public:
    /// The built-in scene `name` at one luxel per pixel of `size`; neither `tree` nor `wide`, for
    /// the hierarchy that backends build, changes a VPL.
    /// @throws Error(invalid_argument) when there is no such scene.
    PaperScene(const std::string& name, mir::Extent size, const mir::KdTreeOptions& tree,
               const mir::WideBvhOptions& wide, Executor& executor);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::string& hash() const { return hash_; }
    [[nodiscard]] const mir::WorldGeometry& geometry() const { return geometry_; }
    [[nodiscard]] const mir::KdTree& tree() const { return tree_; }
    [[nodiscard]] const mir::WideBvhOptions& wide_options() const { return wide_; }
    /// As shafts want it, metres.
    [[nodiscard]] float sigma() const;
    [[nodiscard]] mir::KdTreeVisibility<mir::Space::host> visibility() const {
        return {tree_.view()};
    }

    [[nodiscard]] const mir::SurfaceTable<Bsdf>& surfaces() const { return surfaces_; }
    [[nodiscard]] mir::CameraRays camera_rays() const {
        return {scene_.cameras.front(), mir::luxel_grid(luxels_.extent(), 1), 0};
    }

    /// All luxels in one tile.
    [[nodiscard]] const GBuffer& luxels() const { return luxels_; }

    /// Exactly `count` geometric VPLs along Morton's curve, chosen evenly from the states of
    /// Metropolis chains: they lie where they light what the camera sees, as in the paper. The same
    /// in every run.
    /// @throws Error(unsupported) when the chains do not find as many.
    [[nodiscard]] const mir::VplList& vpls(std::uint32_t count);

    /// Shading with the bound that `mir render` would choose.
    [[nodiscard]] Shading shading(std::uint32_t vpls) const;

 private:
    [[nodiscard]] mir::KdRayCaster<mir::Space::host> caster() const {
        return {geometry_, tree_.view()};
    }
    [[nodiscard]] float aspect() const;
    void fill_luxels(Executor& executor);
    [[nodiscard]] mir::VplList sample(std::uint32_t states) const;
    [[nodiscard]] const mir::VplList& pool(std::uint32_t at_least);

    std::string name_;
    Executor* executor_;
    mir::Scene scene_;
    std::string hash_;
    mir::WorldGeometry geometry_;
    mir::KdTree tree_;
    mir::WideBvhOptions wide_;
    mir::LightTable lights_;
    mir::SurfaceTable<Bsdf> surfaces_;
    GBuffer luxels_;
    double visible_area_ = 0.0;
    std::map<std::uint32_t, mir::VplList> pools_;  ///< by recorded states
    std::map<std::uint32_t, mir::VplList> vpls_;   ///< by count
};

/// The luxels of a scene in tiles of another size, in memory of `Alloc`.
template <class Alloc>
mir::BlockedGBuffer<Bsdf::Params, Alloc> retiled(const GBuffer& whole, mir::Extent tile,
                                                 Executor& executor, const Alloc& alloc = {}) {
    mir::BlockedGBuffer<Bsdf::Params, Alloc> to(whole.extent(), tile, alloc);
    const auto from = whole.view(0);
    const auto from_layout = mir::BlockedLayout::of(whole.tiles().front());
    executor.for_each(to.tiles().size(), [&](std::size_t index) {
        const mir::Tile t = to.tiles()[index];
        const auto layout = mir::BlockedLayout::of(t);
        for (std::uint32_t y = 0; y < t.height; ++y)
            for (std::uint32_t x = 0; x < t.width; ++x) {
                const mir::LuxelIndex i = from_layout(t.x + x, t.y + y);
                to.store(static_cast<mir::TileIndex>(index), layout(x, y), from.hit(i),
                         from.surface(i));
            }
    });
    return to;
}

}  // namespace mirpaper
