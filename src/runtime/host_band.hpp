// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/gbuffer.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "runtime/render_frame.hpp"

#include <optional>
#include <utility>

namespace mir {

/// Luxels in the host's memory, and which VPLs they see where that was asked.
template <Bsdf B>
struct HostBand final : FrameBand {
    /// `extent` luxels in tiles of `tile`.
    HostBand(Extent extent, Extent tile) : gbuffer(extent, tile) {}

    [[nodiscard]] Extent extent() const override { return gbuffer.extent(); }
    [[nodiscard]] bool knows_visibility() const override { return visibility.has_value(); }

    /// The band of a host's frame whose surfaces are of this model.
    [[nodiscard]] static const HostBand& of(const FrameBand& band) {
        return dynamic_cast<const HostBand&>(band);
    }
    /// The same to write.
    [[nodiscard]] static HostBand& of(FrameBand& band) { return dynamic_cast<HostBand&>(band); }

    BlockedGBuffer<typename B::Params> gbuffer;  ///< all columns of the image
    std::optional<VisibilityMatrix> visibility;  ///< none before find_visible()
};

/// A layer in the host's memory.
struct HostLayer final : FrameLayer {
    /// Of light that was found.
    explicit HostLayer(Image<Rgb> light) : image(std::move(light)) {}

    /// The light of a layer of a host's frame.
    [[nodiscard]] static const Image<Rgb>& of(const FrameLayer& layer) {
        return dynamic_cast<const HostLayer&>(layer).image;
    }
    /// The same to write.
    [[nodiscard]] static Image<Rgb>& of(FrameLayer& layer) {
        return dynamic_cast<HostLayer&>(layer).image;
    }

    Image<Rgb> image;  ///< radiance, W m^-2 sr^-1
};

/// Makes a layer of light.
[[nodiscard]] inline LayerPtr host_layer(Image<Rgb> light) {
    return std::make_unique<HostLayer>(std::move(light));
}

}  // namespace mir
