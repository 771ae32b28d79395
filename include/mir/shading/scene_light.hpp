// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/scene/lights/lamp_along_ray.hpp"
#include "mir/shading/lobe_samples.hpp"
#include "mir/shading/sampled_light.hpp"

namespace mir {

/// Chooses lamps by a LightTree.
struct PickByTree {
    /// The lamp that a number in [0, 1) means for a receiver. The tree must not be empty.
    template <Space S>
    [[nodiscard]] MIR_HD static LightPick pick(const LightTableView<S>& lights,
                                               const LightReceiver& at, double u) {
        return lights.tree.pick(at, u);
    }
};

/// Light of the lamps of a LightTree at a luxel, from `samples` points. `Pick` chooses the lamp: f
/// L_e cos cos / (d^2 p) averaged over the samples. The samples of all luxels of a pixel are one
/// Kronecker sequence with a random shift per pixel: each point is uniform, so the estimate is
/// unbiased, and together they are spread evenly over the lamps. Surfaces with a lobe look for the
/// lamps along LobeSamples, too. Host and device.
template <Bsdf B, Visibility V, class Pick = PickByTree>
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

    /// W m^-2 sr^-1 towards the viewer. `random` must be the same for all luxels that share; its
    /// first three numbers are used. Safe to call from any thread.
    [[nodiscard]] MIR_HD Rgb operator()(const Hit& hit, const Surface<typename B::Params>& s,
                                        SharedSamples shared, const Random& random) const {
        if (lights_.tree.empty() || samples_ == 0) return {};
        const Shift shift(random.block(0));
        const LightReceiver at{hit.position, s.normal, hit.normal};
        const auto by_lamps = [&](std::uint32_t k) { return sample(at, shift, shared, k); };
        if constexpr (samples_lobes)
            if (lights_.lamps.count > 0 && LobeSamples<B>::are_for(s)) {
                const LobeSamples<B> lobe(s, shared, random);
                return mean(hit, s, lobe, by_lamps) + mean(hit, s, lobe, [&](std::uint32_t k) {
                           return met(at, lobe.direction(k));
                       });
            }
        return mean(hit, s, NoLobe{}, by_lamps);
    }

 private:
    struct Shift {
        double pick;
        Vec2 uv;

        /// The first three numbers. What floats leave of their bits makes the first one finer:
        /// among many lamps some have less than 2^-24 of it.
        MIR_HD explicit Shift(const Bits128& bits)
            : pick(static_cast<double>(bits.word[0]) * 0x1p-32 +
                   static_cast<double>((bits.word[1] & 0xFFu) << 8 | (bits.word[2] & 0xFFu)) *
                       0x1p-48),
              uv(to_unit_float(bits.word[1]), to_unit_float(bits.word[2])) {}
    };

    /// What shading reads of a point of a lamp, in whole words.
    struct LampPoint {
        Vec3 position{0};
        float offset = 0.0f;
        Vec3 normal{0};
        Rgb radiance;      ///< of a lamp without surface what leaves towards the luxel, W sr^-1
        float pdf = 1.0f;  ///< of the samples of lamps, m^-2
        std::uint32_t both_sides = 0;  ///< 0 or 1
        std::uint32_t is_place = 0;    ///< 0 or 1; 1: without surface
    };

    /// LobeSamples are weighed against the probabilities of the tree.
    static constexpr bool samples_lobes = LobedBsdf<B> && std::is_same_v<Pick, PickByTree>;

    template <class Lobe, class Draw>
    [[nodiscard]] MIR_HD Rgb mean(const Hit& hit, const Surface<typename B::Params>& s,
                                  const Lobe& lobe, const Draw& draw) const {
        return mean_of_samples(
            hit.position, visibility_, samples_, draw,
            [hit, s, lobe](const LampPoint& from) { return unshadowed(hit, s, lobe, from); });
    }

    /// No light, at a place that can be computed with.
    [[nodiscard]] MIR_HD static LampPoint nothing(const LightReceiver& at) {
        LampPoint point;
        point.position = at.position + at.geometric;
        return point;
    }

    /// Sample `k` of the luxel: its lamps interleave with those of the pixel's other luxels. The
    /// shift goes over all lamps: a share of its own for each luxel would light one corner of every
    /// pixel by the same lamps.
    [[nodiscard]] MIR_HD LampPoint sample(const LightReceiver& at, const Shift& shift,
                                          SharedSamples shared, std::uint32_t k) const {
        const std::uint32_t i = k * shared.shares + shared.share;
        const auto n = static_cast<double>(samples_ * shared.shares);
        const double sum = static_cast<double>(i) / n + shift.pick;
        const LightPick pick = Pick::pick(lights_, at, sum < 1.0 ? sum : sum - 1.0);
        const Vec2 uv = kronecker_point(shift.uv, i);
        if (!pick.is_found()) return nothing(at);
        const auto probability = static_cast<float>(pick.probability);
        if (pick.light >= lights_.lamps.count)
            return lights_.listed[pick.light - lights_.lamps.count].visit(
                [&](const auto& source) { return point_of(source, at.position, uv, probability); });
        return lamp_point(pick.light, probability, uv);
    }

    /// The point of a lamp in a direction, for all that lie there.
    [[nodiscard]] MIR_HD LampPoint met(const LightReceiver& at, Vec3 direction) const {
        const LampAlongRay lamp = lamp_along(lights_, geometry_, at, direction);
        if (!lamp.is_found()) return nothing(at);
        LampPoint point = lamp_point(lamp.lamp, lamp.probability, lamp.barycentrics);
        point.radiance = point.radiance * (1.0f / lamp.chance);
        return point;
    }

    [[nodiscard]] MIR_HD LampPoint lamp_point(std::uint32_t lamp, float probability,
                                              Vec2 uv) const {
        const EmitterSample e = lights_.lamps.point_on(geometry_, lamp, uv);
        return {e.position,
                e.offset,
                e.normal,
                e.radiance,
                e.pdf_area * probability,
                e.both_sides ? 1u : 0u,
                0u};
    }

    template <LightSource L>
    [[nodiscard]] MIR_HD static LampPoint point_of(const L& source, Vec3 from, Vec2 uv,
                                                   float probability) {
        const LightPoint p = source.sample(uv, from);
        const Vec3 d = p.position - from;
        const float share = source.share(p.normal, d * (-1.0f / std::sqrt(length_squared(d))));
        return {p.position, 0.0f, p.normal, p.emission * share, p.pdf * probability, 0u, 1u};
    }

    // Inlined by force, as VplShading.
    template <class Lobe>
    [[nodiscard, gnu::always_inline]] MIR_HD static LitPoint unshadowed(
        const Hit& hit, const Surface<typename B::Params>& s, const Lobe& lobe,
        const LampPoint& e) {
        const bool is_behind = glm::dot(hit.position - e.position, e.normal) < 0.0f;
        const bool from_back = (e.both_sides & static_cast<std::uint32_t>(is_behind)) != 0;
        const Vec3 normal = e.normal * (from_back ? -1.0f : 1.0f);
        const Vec3 place = lift(e.position, normal, e.offset);
        const Vec3 d = place - hit.position;
        const float d2 = length_squared(d);
        const Vec3 wi = d * (1.0f / std::sqrt(d2));
        const float cosine = e.is_place != 0 ? 1.0f : -glm::dot(wi, normal);
        float density = d2 * e.pdf;
        if constexpr (!std::is_same_v<Lobe, NoLobe>)
            density += e.is_place != 0 ? 0.0f : lobe.density(wi) * cosine;
        const Rgb light = reflected<B>(hit, s, wi) * e.radiance * (cosine / density);
        // At the lamp itself 1/d^2 has no value.
        const float y = luminance(light);
        const bool is_light =
            (static_cast<int>(cosine > 0.0f) & static_cast<int>(y - y == 0.0f)) != 0;
        return {place, kept_if(is_light, light)};
    }

    LightTableView<space> lights_;
    GeometryView<space> geometry_;
    V visibility_;
    std::uint32_t samples_;
};

/// Which of the lights that a scene lists are summed one by one.
enum class ListedPart : std::uint8_t {
    all,         ///< as where nothing is drawn from a LightTree
    beside_tree  ///< those that the LightTree does not hold
};

/// What is left to ListedLight beside an EmitterLight of so many samples.
template <Space S>
[[nodiscard]] ListedPart part_beside(const LightTableView<S>& lights, std::uint32_t samples) {
    return lights.is_listed_in_tree && samples > 0 ? ListedPart::beside_tree : ListedPart::all;
}

/// Light of what the scene lists at a luxel. Exact where it has no extent, by one sample where it
/// has. No ray meets these lights, so they are never VPLs (docs/method.md, 5.2). A light at the
/// luxel itself, or so near that its radiance is no float, adds nothing: 1/d^2 has no value there,
/// and one luxel must not spoil its neighbours. Host and device.
template <Bsdf B, Visibility V>
class ListedLight {
 public:
    static constexpr Space space = space_of_lights<V>;  ///< memory that the lights lie in

    /// What the view reads must outlive it.
    ListedLight(const LightTableView<space>& lights, V visibility,
                ListedPart part = ListedPart::all)
        : lights_(lights), visibility_(visibility), part_(part) {}
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
                using Source = std::remove_cvref_t<decltype(source)>;
                if (TreeLight<Source> && part_ == ListedPart::beside_tree) return Rgb{};
                Vec2 u{0};
                if constexpr (Source::has_extent) u = place(i);
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
    ListedPart part_;
};

}  // namespace mir
