// SPDX-License-Identifier: MIT
#pragma once

#include "bounce_means.hpp"
#include "mir/sampling/visible_area.hpp"
#include "self_normalised.hpp"

#include <utility>

namespace mirtest {

/// A scene, how it is rendered, and what the path tracer says of it.
class Trial {
 public:
    static constexpr mir::Extent pixels{32, 24};  ///< of 4 luxels: 64 x 48

    /// The bound is the automatic one of `bound_vpls` VPLs; `replicates` of either side.
    Trial(mir::Scene scene, std::uint32_t samples, std::uint32_t bound_vpls = 256,
          std::uint32_t replicates = 16)
        : studio(std::move(scene)), runs(replicates) {
        const mir::Camera& camera = studio.scene.cameras.front();
        const float aspect = static_cast<float>(pixels.width) / static_cast<float>(pixels.height);
        settings = small_settings(pixels.width, 256);
        settings.image = pixels;
        settings.luxels_per_pixel = 4;
        settings.bounce_layers = true;
        settings.direct_samples = 1;
        settings.max_bounce = BounceMeans::last_bounce;
        settings.bound = {
            mir::BoundPolicy::Kind::fixed,
            mir::default_bound(
                visible_area(camera, aspect,
                             mir::LuxelTracer{studio.engine.ray_caster(), studio.surfaces.view()}),
                bound_vpls)};
        mir::ReferenceOptions reference;
        reference.samples = samples;
        reference.film = mir::FilmPosition::pixel;
        const auto tracer =
            studio.tracer({.max_bounce = BounceMeans::last_bounce, .bound = settings.bound.value});
        for (const auto& image : mirtest::replicates(
                 tracer, {camera, mir::luxel_grid(pixels, 1), 811}, reference, runs))
            truth.add(image);
    }

    /// `runs` renders from seed 0 on; render(settings) makes one.
    template <class Render>
    [[nodiscard]] BounceMeans rendered(mir::RenderSettings with, const Render& make) const {
        BounceMeans means;
        for (with.seed = 0; with.seed < runs; ++with.seed) means.add(make(with));
        return means;
    }
    [[nodiscard]] BounceMeans rendered(const mir::RenderSettings& with) const {
        return rendered(with, [&](const auto& s) { return render(studio.scene, s); });
    }
    /// p-value of agreement with the path tracer.
    [[nodiscard]] double p_of(const mir::RenderSettings& with) const {
        return agreement(rendered(with), truth);
    }

    Studio<mir::Lambert> studio;
    std::uint32_t runs;
    mir::RenderSettings settings;
    BounceMeans truth;
};

inline mir::RenderSettings instant_radiosity(mir::RenderSettings s, std::uint32_t vpls) {
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.vpls = vpls;
    return s;
}
inline mir::RenderSettings bidirectional(mir::RenderSettings s) {
    s.sampler = mir::SamplerKind::bidirectional;
    return s;
}
/// Short strides save time: what is recorded must have the right law whatever the stride. Fewer
/// chains than VPLs, or nothing would mutate.
inline mir::RenderSettings metropolis(mir::RenderSettings s) {
    s.sampler = mir::SamplerKind::metropolis;
    s.metropolis.chains = 128;
    s.metropolis.stride = 16;
    s.metropolis.chain.tries = 4;
    s.metropolis.bootstrap = {1.0, 1u << 15, 1u << 15};
    return s;
}

}  // namespace mirtest
