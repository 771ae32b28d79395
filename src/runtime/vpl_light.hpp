// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"
#include "runtime/render_frame.hpp"

#include <cstddef>
#include <vector>

namespace mir {

/// Light that the VPLs of a render send through a band's luxels. Of all VPLs, or by cuts of trees
/// over them. `vpls` must outlive it.
class VplLight {
 public:
    /// Under `bound`, m^-2, as points, spheres or with lobes, as the settings say.
    VplLight(const RenderSettings& settings, float bound, const VplList& vpls,
             AnyExecutor executor);

    /// Bounces that get a layer of their own.
    [[nodiscard]] std::size_t bounces() const { return layers_; }

    /// Appends the light of all VPLs and that of each bounce, W m^-2 sr^-1. `variance` is null or
    /// black, and becomes that of cuts (RenderFrame::light_and_error_by_cuts()). `monitor` may be
    /// null.
    void append_layers(RenderFrame& frame, const FrameBand& band, FrameLayer* variance,
                       Monitor* monitor, std::vector<LayerPtr>& layers) const;

    /// The light that the bound keeps from the image.
    [[nodiscard]] LayerPtr removed(RenderFrame& frame, const FrameBand& band) const {
        return frame.light(band, vpls_.span(), removed_, nullptr);
    }

 private:
    [[nodiscard]] LayerPtr light(RenderFrame& frame, const FrameBand& band, std::size_t list,
                                 FrameLayer* variance, Monitor* monitor) const;

    const VplList& vpls_;
    VplKernel lit_;
    VplKernel removed_;
    std::size_t layers_ = 0;
    std::vector<std::vector<Vpl>> bounces_;
    std::vector<CutVpls> cut_vpls_;  ///< all, or those of each bounce; none without cuts
};

}  // namespace mir
