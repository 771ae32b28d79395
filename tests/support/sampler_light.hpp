// SPDX-License-Identifier: MIT
#pragma once

#include "mir/fill_gbuffer.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sampling/image_probe.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/scenes.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"

#include <vector>

namespace mirtest {

/// The light that a sampler's records bring to a small image, replicate by replicate.
class SamplerLight {
 public:
    static constexpr std::uint64_t replicates = 32;
    static constexpr std::uint32_t bounces = 5;  ///< 1 .. bounces are told apart
    static constexpr std::uint32_t luxels = 32;  ///< along either side
    static constexpr std::uint32_t tiles = 4;    ///< along either side

    /// One for each bounce, then one for each tile, all bounces in one.
    std::vector<Moments> moments{bounces + tiles * tiles};

    [[nodiscard]] const Moments& bounce(std::uint32_t b) const { return moments[b - 1]; }

    /// Adds the replicate that `records` are.
    template <mir::Bsdf B>
    void add(const PathLab<B>& lab, const mir::VplRecords& records) {
        const auto world = lab.world();
        mir::BlockedGBuffer<typename B::Params> gbuffer({luxels, luxels}, {luxels, luxels});
        const mir::CameraRays rays{lab.scene.cameras.front(), mir::luxel_grid({luxels, luxels}, 1),
                                   77};
        mir::InlineExecutor one;
        mir::fill_gbuffer<B>(gbuffer, 0, rays, world.luxels.caster, lab.surfaces, one);
        std::vector<double> values(moments.size());
        for (std::uint32_t b = 1; b <= bounces; ++b)
            add_picture(picture<B>(gbuffer, world.visibility, records, b), b, values);
        for (std::size_t i = 0; i < values.size(); ++i) moments[i].add(values[i]);
    }

 private:
    template <mir::Bsdf B, class G, class V>
    static mir::Image<mir::Rgb> picture(const G& gbuffer, const V& visibility,
                                        const mir::VplRecords& records, std::uint32_t b) {
        std::vector<mir::Vpl> vpls;
        for (const mir::VplRecord& r : records.records)
            if (r.bounce == b) vpls.push_back(r.vpl);
        mir::InlineExecutor one;
        return mir::reconstruct(mir::sched::CpuBlocks{one}, gbuffer, mir::span_of(vpls), visibility,
                                mir::VplShading<B>{});
    }
    static void add_picture(const mir::Image<mir::Rgb>& image, std::uint32_t b,
                            std::vector<double>& values) {
        constexpr std::uint32_t side = luxels / tiles;
        for (std::uint32_t y = 0; y < luxels; ++y)
            for (std::uint32_t x = 0; x < luxels; ++x) {
                const double l = luminance(image(x, y));
                values[b - 1] += l / (luxels * luxels);
                values[bounces + y / side * tiles + x / side] += l / (side * side);
            }
    }
};

/// Light of the records `sample(seed)`, one replicate for each seed from `first` on.
template <mir::Bsdf B, class Sample>
SamplerLight light_of_seeds(const PathLab<B>& lab, std::uint64_t first, const Sample& sample) {
    SamplerLight light;
    for (std::uint64_t s = first; s < first + SamplerLight::replicates; ++s)
        light.add(lab, sample(s));
    return light;
}

/// Light that instant radiosity brings, which knows neither probe nor target. Seeds from 40000 on.
template <mir::Bsdf B>
SamplerLight instant_radiosity(const PathLab<B>& lab, std::uint32_t vpls = 512) {
    const auto caster = lab.engine.ray_caster();
    mir::InlineExecutor one;
    return light_of_seeds(lab, 40'000, [&](std::uint64_t seed) {
        mir::InstantRadiosityOptions o;
        o.vpls = vpls;
        o.emitter_vpls = true;
        o.seed = seed;
        return mir::InstantRadiositySampler<B, std::remove_const_t<decltype(caster)>>(
                   {lab.geometry, lab.lights, lab.surfaces, caster}, o)
            .sample(one);
    });
}

template <mir::Bsdf B>
using ProbeOf = mir::ImageProbe<B, decltype(PathLab<B>::World::visibility)>;

/// Probe without a bound.
template <mir::Bsdf B>
ProbeOf<B> probe_of(const PathLab<B>& lab, std::uint32_t luxels = 64) {
    return {{lab.scene.cameras.front(), 1.0f, luxels, 5},
            lab.engine.ray_caster(),
            lab.surfaces,
            lab.engine.visibility(),
            {}};
}

/// p-value, after Sidak, of "both samplers bring the same light to every bounce from `first` on and
/// to every tile" (Welch's test in each).
inline double agreement(const SamplerLight& a, const SamplerLight& b, std::uint32_t first) {
    double smallest = 1.0;
    const std::size_t tests = a.moments.size() - (first - 1);
    for (std::size_t i = first - 1; i < a.moments.size(); ++i)
        smallest = std::min(smallest, welch_p_value(a.moments[i], b.moments[i]));
    return -std::expm1(static_cast<double>(tests) * std::log1p(-smallest));
}

/// Checks that in `furnace` bounce b has the mean radiance L rho^b, and that its standard error is
/// less than `relative_error` of it. Student's t over the replicates, 1 % over all bounces.
inline void check_furnace(const SamplerLight& light, double relative_error) {
    for (std::uint32_t b = 1; b <= SamplerLight::bounces; ++b) {
        const Moments& m = light.bounce(b);
        CAPTURE(b, m.mean(), m.standard_error());
        CHECK(mean_p_value(m, std::pow(0.5, b + 1)) > sidak(0.01, SamplerLight::bounces));
        CHECK(m.standard_error() < relative_error * m.mean());
    }
}

/// The Cornell box without light: its surfaces black, or its lamp put out.
inline mir::Scene dark_box(bool black) {
    mir::Scene scene = mir::builtin::make("cornell-box");
    for (mir::Material& m : scene.materials) (black ? m.base_color : m.emission) = {};
    return scene;
}

}  // namespace mirtest
