// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/shading/sampled_light.hpp"

namespace mir {

/// Light of the emissive triangles at a luxel, estimated from `samples` points chosen by power:
/// f L_e cos cos / (d^2 p) averaged over the samples. The samples of all luxels of a pixel are one
/// Kronecker sequence with a random shift per pixel: each point is uniform, so the estimate is
/// unbiased, and together they are spread evenly over the lamps. Host and device.
template <Bsdf B, Visibility V>
class EmitterLight {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the lights lie in

    /// `samples` per luxel, 0 for no light. What the views read must outlive it.
    EmitterLight(const LightTableView<space>& lights, const GeometryView<space>& geometry,
                 V visibility, std::uint32_t samples)
        : lights_(lights), geometry_(geometry), visibility_(visibility), samples_(samples) {}
    /// The lights of the host and their geometry, which must outlive it.
    EmitterLight(const LightTable& lights, V visibility,
                 std::uint32_t samples) requires(space == Space::host)
        : EmitterLight(lights.view(), lights.geometry().view(), visibility, samples) {}

    /// W m^-2 sr^-1 towards the viewer. `random` must be the same for all luxels that share.
    /// Safe to call from any thread.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                        SharedSamples shared, Random random) const {
        if (!lights_.has_emitters() || samples_ == 0) return {};
        const Shift shift{random.next(), random.next_2d()};
        return mean_of_samples(
            hit.position, visibility_, samples_,
            [&](std::uint32_t k) { return sample(shift, shared, k); },
            [hit, s](const LampPoint& from) { return unshadowed(hit, s, from); });
    }

 private:
    struct Shift {
        float pick;
        Vec2 uv;
    };

    /// What shading reads of an EmitterSample, in whole words.
    struct LampPoint {
        Vec3 position;
        float offset;
        Vec3 normal;
        Rgb radiance;
        float pdf_area;
        std::uint32_t both_sides;  ///< 0 or 1
    };

    /// Sample `k` of the luxel: its lamps interleave with those of the pixel's other luxels. The
    /// shift goes over all lamps: a share of its own for each luxel would light one corner of every
    /// pixel by the same lamps.
    [[nodiscard]] MIR_HD LampPoint sample(Shift shift, SharedSamples shared,
                                          std::uint32_t k) const {
        const std::uint32_t i = k * shared.shares + shared.share;
        const auto n = static_cast<float>(samples_ * shared.shares);
        const float lamp = wrapped(static_cast<float>(i) / n + shift.pick);
        const EmitterSample e =
            lights_.sample_emitter(geometry_, lamp, kronecker_point(shift.uv, i));
        return {e.position, e.offset, e.normal, e.radiance, e.pdf_area, e.both_sides ? 1u : 0u};
    }

    // Inlined by force, as VplShading.
    [[nodiscard, gnu::always_inline]] MIR_HD static LitPoint unshadowed(
        const Hit& hit, const Surface<typename B::Params>& s, const LampPoint& e) {
        const bool is_behind = glm::dot(hit.position - e.position, e.normal) < 0.0f;
        const bool from_back = (e.both_sides & static_cast<std::uint32_t>(is_behind)) != 0;
        const Vec3 normal = e.normal * (from_back ? -1.0f : 1.0f);
        const Vec3 place = lift(e.position, normal, e.offset);
        const Vec3 d = place - hit.position;
        const float d2 = length_squared(d);
        const Vec3 wi = d * (1.0f / std::sqrt(d2));
        const float cosine = -glm::dot(wi, normal);
        const Rgb light = reflected<B>(hit, s, wi) * e.radiance * (cosine / (d2 * e.pdf_area));
        return {place, kept_if(cosine > 0.0f, light)};
    }

    LightTableView<space> lights_;
    GeometryView<space> geometry_;
    V visibility_;
    std::uint32_t samples_;
};

/// Light of point, spot and directional lights at a luxel, exact. They have no extent, so they are
/// never VPLs (docs/method.md, 5.2). A light at the luxel itself, or so near that its radiance is
/// no float, adds nothing: 1/d^2 has no value there, and one luxel must not spoil its neighbours.
/// Host and device.
template <Bsdf B, Visibility V>
class DeltaLight {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the lights lie in

    /// What the view reads must outlive it.
    DeltaLight(const LightTableView<space>& lights, V visibility)
        : lights_(lights), visibility_(visibility) {}
    /// The lights of the host, which must outlive it.
    DeltaLight(const LightTable& lights, V visibility) requires(space == Space::host)
        : DeltaLight(lights.view(), visibility) {}

    /// W m^-2 sr^-1 towards the viewer. Safe to call from any thread.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit,
                                        const Surface<typename B::Params>& s) const {
        Rgb sum;
        for (std::uint32_t i = 0; i < lights_.delta_count; ++i)
            sum += from(hit, s, lights_.delta_sources[i]);
        return sum;
    }

 private:
    [[nodiscard]] MIR_HD Rgb from(const Hit& hit, const Surface<typename B::Params>& s,
                                  const DeltaSource& l) const {
        if (l.kind == LightEndKind::directional) return from_direction(hit, s, l);
        if (l.kind == LightEndKind::point) return from_point(hit, s, l.position, l.emission);
        const Vec3 w = glm::normalize(hit.position - l.position);
        return from_point(hit, s, l.position, l.emission * spot_falloff(l, w));
    }

    [[nodiscard]] MIR_HD Rgb from_point(const Hit& hit, const Surface<typename B::Params>& s,
                                        Vec3 position, Rgb intensity) const {
        const Vec3 d = position - hit.position;
        const float d2 = length_squared(d);
        const Rgb light = reflected<B>(hit, s, d * (1.0f / std::sqrt(d2))) * intensity * (1 / d2);
        if (is_black(light) || !is_finite(light)) return {};
        return visibility_.visible(position, hit.position) ? light : Rgb{};
    }

    [[nodiscard]] MIR_HD Rgb from_direction(const Hit& hit, const Surface<typename B::Params>& s,
                                            const DeltaSource& l) const {
        const Rgb light = reflected<B>(hit, s, -l.direction) * l.emission;
        const Vec3 outside = hit.position - 4.0f * lights_.radius * l.direction;
        if (is_black(light) || !visibility_.visible(outside, hit.position)) return {};
        return light;
    }

    LightTableView<space> lights_;
    V visibility_;
};

}  // namespace mir
