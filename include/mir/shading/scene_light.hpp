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
MIR_HD Rgb reflected(const Hit& hit, const Surface<typename B::Params>& s, Vec3 wi) {
    const float cosine = glm::dot(wi, s.normal);
    if (cosine <= 0.0f || glm::dot(wi, hit.normal) <= 0.0f) return {};
    return B::eval(s.bsdf, s.normal, wi, s.wo) * cosine;
}

/// Memory that lights lie in for a visibility to be asked about them.
template <Visibility V>
inline constexpr Space space_of_lights = V::space == Space::device ? Space::device : Space::host;

/// How the luxels of a pixel share one well-spread set of samples.
struct SharedSamples {
    std::uint32_t shares = 1;  ///< luxels of the pixel
    std::uint32_t share = 0;   ///< which of them asks
};

/// Light of the emissive triangles at a luxel, estimated from `samples` points chosen by power:
/// f L_e cos cos / (d^2 p) averaged over the samples. The samples of all luxels of a pixel are one
/// Kronecker sequence with a random shift per pixel: each point is uniform, so the estimate is
/// unbiased, and together they are spread evenly over the lamps. Source of the sequence: Roberts,
/// "The unreasonable effectiveness of quasirandom sequences", 2018. Host and device.
template <Bsdf B, Visibility V>
class EmitterLight {
 public:
    static constexpr Space space = space_of_lights<V>;

    EmitterLight(const LightTableView<space>& lights, const GeometryView<space>& geometry,
                 V visibility, std::uint32_t samples)
        : lights_(lights), geometry_(geometry), visibility_(visibility), samples_(samples) {}
    EmitterLight(const LightTable& lights, V visibility,
                 std::uint32_t samples) requires(space == Space::host)
        : EmitterLight(lights.view(), lights.geometry().view(), visibility, samples) {}

    /// W m^-2 sr^-1 towards the viewer. `random` must be the same for all luxels that share.
    /// Safe to call from any thread.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                        SharedSamples shared, Random random) const {
        Rgb sum;
        if (!lights_.has_emitters() || samples_ == 0) return sum;
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
    [[nodiscard]] MIR_HD EmitterSample sample(Shift shift, SharedSamples shared,
                                              std::uint32_t k) const {
        const auto i = static_cast<float>(k * shared.shares + shared.share);
        const auto n = static_cast<float>(samples_ * shared.shares);
        const Vec2 uv = glm::fract(shift.uv + i * Vec2(0.7548776662f, 0.5698402910f));
        return lights_.sample_emitter(geometry_, smaller((i + shift.pick) / n, 0x1.fffffep-1f), uv);
    }

    [[nodiscard]] MIR_HD Rgb packet(const Hit& hit, const Surface<typename B::Params>& s,
                                    Shift shift, SharedSamples shared, std::uint32_t first) const {
        PointPacket points{};
        Rgb light[PointPacket::width];
        std::uint32_t active = 0;
        const std::uint32_t rest = samples_ - first;
        const std::uint32_t count = rest < PointPacket::width ? rest : PointPacket::width;
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

    [[nodiscard]] MIR_HD Rgb unshadowed(const Hit& hit, const Surface<typename B::Params>& s,
                                        const EmitterSample& e, Vec3& target) const {
        const bool from_back = e.both_sides && glm::dot(hit.position - e.position, e.normal) < 0;
        const Vec3 normal = from_back ? -e.normal : e.normal;
        target = lift(e.position, normal, geometry_.ray_offset);
        const Vec3 d = target - hit.position;
        const float d2 = length_squared(d);
        const Vec3 wi = d * (1.0f / std::sqrt(d2));
        const float cosine = -glm::dot(wi, normal);
        if (!(cosine > 0.0f)) return {};
        return reflected<B>(hit, s, wi) * e.radiance * (cosine / (d2 * e.pdf_area));
    }

    [[nodiscard]] MIR_HD Rgb sum_of_visible(Vec3 origin, const PointPacket& points,
                                            const Rgb* light, std::uint32_t active) const {
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
    static constexpr Space space = space_of_lights<V>;

    DeltaLight(const LightTableView<space>& lights, V visibility)
        : lights_(lights), visibility_(visibility) {}
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
