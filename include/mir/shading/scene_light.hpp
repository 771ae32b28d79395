// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/shading/sampled_light.hpp"

namespace mir {

/// Light of the emissive triangles at a luxel, from `samples` points. They are chosen by power: f
/// L_e cos cos / (d^2 p) averaged over the samples. The samples of all luxels of a pixel are one
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
        if (lights_.lamps.by_power.empty() || samples_ == 0) return {};
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
        const EmitterSample e = lights_.lamps.sample(geometry_, lamp, kronecker_point(shift.uv, i));
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

/// Light of what the scene lists at a luxel. Exact where it has no extent, by one sample where it
/// has. No ray meets these lights, so they are never VPLs (docs/method.md, 5.2). A light at the
/// luxel itself, or so near that its radiance is no float, adds nothing: 1/d^2 has no value there,
/// and one luxel must not spoil its neighbours. Host and device.
template <Bsdf B, Visibility V>
class ListedLight {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the lights lie in

    /// What the view reads must outlive it.
    ListedLight(const LightTableView<space>& lights, V visibility)
        : lights_(lights), visibility_(visibility) {}
    /// The lights of the host, which must outlive it.
    ListedLight(const LightTable& lights, V visibility) requires(space == Space::host)
        : ListedLight(lights.view(), visibility) {}

    /// W m^-2 sr^-1 towards the viewer. `place(i)` lies in the unit square; it is asked for each
    /// light i with extent. Safe to call from any thread.
    template <class Place>
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                        const Place& place) const {
        Rgb sum;
        for (std::uint32_t i = 0; i < lights_.listed_count; ++i)
            sum += lights_.listed[i].visit([&](const auto& source) {
                Vec2 u{0};
                if constexpr (std::remove_cvref_t<decltype(source)>::has_extent) u = place(i);
                return from(hit, s, source, u);
            });
        return sum;
    }

 private:
    template <LightSource L>
    [[nodiscard]] MIR_HD Rgb from(const Hit& hit, const Surface<typename B::Params>& s,
                                  const L& source, Vec2 u) const {
        const LightPoint p = source.sample(u, hit.position);
        Vec3 wi = -p.normal;
        float d2 = 1.0f;
        Vec3 end = lights_.sphere.outside(hit.position, wi);
        if (L::origin != LightOrigin::outside) {
            const Vec3 d = p.position - hit.position;
            d2 = length_squared(d);
            wi = d * (1.0f / std::sqrt(d2));
            end = p.position;
        }
        const Rgb light = reflected<B>(hit, s, wi) * (p.emission * source.share(p.normal, -wi)) *
                          (1.0f / (d2 * p.pdf));
        if (is_black(light) || !is_finite(light)) return {};
        return visibility_.visible(end, hit.position) ? light : Rgb{};
    }

    LightTableView<space> lights_;
    V visibility_;
};

}  // namespace mir
