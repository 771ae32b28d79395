// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/random.hpp"
#include "mir/data/luxel.hpp"
#include "mir/scene/light_table.hpp"

namespace mir {

/// f cos for light from the unit direction `wi`; black when either side of the surface disagrees.
template <Bsdf B>
Rgb reflected(const Hit& hit, const Surface<typename B::Params>& s, Vec3 wi) {
    const float cosine = glm::dot(wi, s.normal);
    if (cosine <= 0.0f || glm::dot(wi, hit.normal) <= 0.0f) return {};
    return B::eval(s.bsdf, s.normal, wi, s.wo) * cosine;
}

/// How the luxels of a pixel share one well-spread set of samples.
struct SharedSamples {
    std::uint32_t shares = 1;  ///< luxels of the pixel
    std::uint32_t share = 0;   ///< which of them asks
};

/// Light of the emissive triangles at a luxel, estimated from `samples` points chosen by power:
/// f L_e cos cos / (d^2 p) averaged over the samples. The samples of all luxels of a pixel are one
/// Kronecker sequence with a random shift per pixel: each point is uniform, so the estimate is
/// unbiased, and together they are spread evenly over the lamps. Source of the sequence: Roberts,
/// "The unreasonable effectiveness of quasirandom sequences", 2018.
template <Bsdf B, Visibility V>
class EmitterLight {
 public:
    EmitterLight(const LightTable& lights, V visibility, std::uint32_t samples, float ray_offset)
        : lights_(&lights), visibility_(visibility), samples_(samples), offset_(ray_offset) {}

    /// W m^-2 sr^-1 towards the viewer. `random` must be the same for all luxels that share.
    /// Safe to call from any thread.
    [[nodiscard]] Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                 SharedSamples shared, Random random) const {
        Rgb sum;
        if (!lights_->has_emitters() || samples_ == 0) return sum;
        const Shift shift{random.next(), random.next_2d()};
        for (std::uint32_t first = 0; first < samples_; first += PointPacket::width)
            sum += packet(hit, s, shift, shared, first);
        return sum * (1.0f / static_cast<float>(samples_));
    }

 private:
    struct Shift {
        float pick;
        Vec2 uv;
    };

    /// Sample `k` of the luxel: its lamps interleave with those of the pixel's other luxels.
    [[nodiscard]] EmitterSample sample(Shift shift, SharedSamples shared, std::uint32_t k) const {
        const auto i = static_cast<float>(k * shared.shares + shared.share);
        const auto n = static_cast<float>(samples_ * shared.shares);
        const Vec2 uv = glm::fract(shift.uv + i * Vec2(0.7548776662f, 0.5698402910f));
        return lights_->sample_emitter(std::min((i + shift.pick) / n, 0x1.fffffep-1f), uv);
    }

    [[nodiscard]] Rgb packet(const Hit& hit, const Surface<typename B::Params>& s, Shift shift,
                             SharedSamples shared, std::uint32_t first) const {
        PointPacket points{};
        Rgb light[PointPacket::width];
        std::uint32_t active = 0;
        const std::uint32_t count = std::min(samples_ - first, PointPacket::width);
        for (std::uint32_t k = 0; k < count; ++k) {
            Vec3 target{0};
            light[k] = unshadowed(hit, s, sample(shift, shared, first + k), target);
            if (is_black(light[k])) continue;
            points.x[k] = target.x;
            points.y[k] = target.y;
            points.z[k] = target.z;
            active |= 1u << k;
        }
        return sum_of_visible(hit.position, points, light, active);
    }

    [[nodiscard]] Rgb unshadowed(const Hit& hit, const Surface<typename B::Params>& s,
                                 const EmitterSample& e, Vec3& target) const {
        const bool from_back = e.both_sides && glm::dot(hit.position - e.position, e.normal) < 0;
        const Vec3 normal = from_back ? -e.normal : e.normal;
        target = lift(e.position, normal, offset_);
        const Vec3 d = target - hit.position;
        const float d2 = length_squared(d);
        const Vec3 wi = d * (1.0f / std::sqrt(d2));
        const float cosine = -glm::dot(wi, normal);
        if (!(cosine > 0.0f)) return {};
        return reflected<B>(hit, s, wi) * e.radiance * (cosine / (d2 * e.pdf_area));
    }

    [[nodiscard]] Rgb sum_of_visible(Vec3 origin, const PointPacket& points, const Rgb* light,
                                     std::uint32_t active) const {
        std::uint32_t seen = active;
        if constexpr (PacketVisibility<V>) {
            if (active != 0) seen = visibility_.visible_packet(origin, points, active);
        } else {
            for (std::uint32_t k = 0; k < PointPacket::width; ++k)
                if ((active >> k & 1u) != 0 &&
                    !visibility_.visible(origin, {points.x[k], points.y[k], points.z[k]}))
                    seen &= ~(1u << k);
        }
        Rgb sum;
        for (std::uint32_t k = 0; k < PointPacket::width; ++k)
            if ((seen >> k & 1u) != 0) sum += light[k];
        return sum;
    }

    const LightTable* lights_;
    V visibility_;
    std::uint32_t samples_;
    float offset_;
};

/// Light of point, spot and directional lights at a luxel, exact. They have no extent, so they are
/// never VPLs (docs/method.md, 5.2). A light at the luxel itself, or so near that its radiance is
/// no float, adds nothing: 1/d^2 has no value there, and one luxel must not spoil its neighbours.
template <Bsdf B, Visibility V>
class DeltaLight {
 public:
    DeltaLight(const LightTable& lights, V visibility)
        : lights_(&lights), visibility_(visibility) {}

    /// W m^-2 sr^-1 towards the viewer. Safe to call from any thread.
    [[nodiscard]] Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s) const {
        Rgb sum;
        for (const PointLight& l : lights_->point_lights())
            sum += from_point(hit, s, l.position, l.intensity);
        for (const SpotLight& l : lights_->spot_lights()) {
            const Vec3 w = glm::normalize(hit.position - l.position);
            sum += from_point(hit, s, l.position, l.intensity * spot_falloff(l, w));
        }
        for (const DirectionalLight& l : lights_->directional_lights())
            sum += from_direction(hit, s, l);
        return sum;
    }

 private:
    [[nodiscard]] Rgb from_point(const Hit& hit, const Surface<typename B::Params>& s,
                                 Vec3 position, Rgb intensity) const {
        const Vec3 d = position - hit.position;
        const float d2 = length_squared(d);
        const Rgb light = reflected<B>(hit, s, d * (1.0f / std::sqrt(d2))) * intensity * (1 / d2);
        if (is_black(light) || !is_finite(light)) return {};
        return visibility_.visible(position, hit.position) ? light : Rgb{};
    }

    [[nodiscard]] Rgb from_direction(const Hit& hit, const Surface<typename B::Params>& s,
                                     const DirectionalLight& l) const {
        const Rgb light = reflected<B>(hit, s, -l.direction) * l.irradiance;
        const Vec3 outside = hit.position - 4.0f * lights_->radius() * l.direction;
        if (is_black(light) || !visibility_.visible(outside, hit.position)) return {};
        return light;
    }

    const LightTable* lights_;
    V visibility_;
};

}  // namespace mir
