// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"
#include "mir/core/number_text.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "mir/validation/detail/shaded_places.hpp"
#include "mir/validation/detail/worse.hpp"
#include "mir/validation/report.hpp"

#include <string>

namespace mir::validation {

/// Makes the surfaces of check_shading() for shadings that read mir's own surfaces. They have these
/// parameters of a Bsdf.
template <class Params>
auto surfaces_with(const Params& params) {
    return [params](Vec3 normal, Vec3 wo) { return Surface<Params>{normal, wo, {}, params}; };
}

namespace detail {

/// Axioms that ask for one value at a time.
template <Shading F, class MakeSurface>
void expect_radiances(const F& shade, const MakeSurface& surface, Report& report) {
    constexpr std::size_t count = 20000;
    Random random = numbers(61);
    std::size_t lit = 0;
    std::size_t unsound = 0;
    std::size_t from_below = 0;
    std::size_t from_nothing = 0;
    std::size_t otherwise = 0;
    for (std::size_t i = 0; i < count; ++i) {
        ShadedPlace at = random_shaded_place(random);
        const auto s = surface(at.normal, at.wo);
        const Rgb c = shade(at.hit, s, at.vpl);
        lit += is_black(c) ? 0 : 1;
        unsound += is_radiance(c) ? 0 : 1;
        from_below += at.is_below_horizon() && !is_black(c) ? 1 : 0;
        otherwise += bits_of(shade(at.hit, s, at.vpl)) == bits_of(c) ? 0 : 1;
        at.vpl.intensity = {};
        from_nothing += is_black(shade(at.hit, s, at.vpl)) ? 0 : 1;
    }
    const auto expect_none = [&](std::size_t bad, const char* axiom) {
        report.expect(bad == 0, axiom,
                      std::to_string(bad) + " of " + std::to_string(count) + " values are not so");
    };
    report.expect(lit > count / 200, "VPLs light the luxels",
                  std::to_string(lit) + " of " + std::to_string(count) + " do");
    expect_none(unsound, "values are finite and not negative");
    expect_none(from_below, "nothing comes from below either horizon");
    expect_none(from_nothing, "a VPL of no intensity adds nothing");
    expect_none(otherwise, "the same question has the same answer");
}

/// The VPL's colour multiplies the effect of one of 1 W sr^-1. It does so channel by channel, to a
/// relative 1e-5.
template <Shading F, class MakeSurface>
void expect_linear(const F& shade, const MakeSurface& surface, Report& report) {
    Random random = numbers(62);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        ShadedPlace at = random_shaded_place(random);
        const auto s = surface(at.normal, at.wo);
        const Rgb j = at.vpl.intensity;
        const Rgb found = shade(at.hit, s, at.vpl);
        at.vpl.intensity = {1.0f, 1.0f, 1.0f};
        const Rgb wanted = shade(at.hit, s, at.vpl) * j;
        worst = worse(worst, relative_difference(found, wanted));
    }
    report.expect(worst < 1e-5, "light is linear in the VPL's intensity, channel by channel",
                  "it differs by up to " + number_text(worst) + " of it");
}

/// What schedulers may skip is black: surfaces that reflect nothing, VPLs beyond the reach.
template <Shading F, class MakeSurface>
void expect_nothing_skipped(const F& shade, const MakeSurface& surface, Report& report) {
    Random random = numbers(63);
    std::size_t denied = 0;
    std::size_t out_of_reach = 0;
    for (int i = 0; i < 20000; ++i) {
        const ShadedPlace at = random_shaded_place(random);
        const auto s = surface(at.normal, at.wo);
        if (is_black(shade(at.hit, s, at.vpl))) continue;
        if constexpr (SurfaceSelectiveShading<F>) denied += shade.reflects(s) ? 0 : 1;
        if constexpr (ReachLimitedShading<F>) {
            const float d2 = length_squared(at.vpl.position - at.hit.position);
            out_of_reach += d2 > shade.reach_squared() * (1.0f + 0x1p-16f) ? 1 : 0;
        }
    }
    if constexpr (SurfaceSelectiveShading<F>)
        report.expect(denied == 0, "what reflects() denies is black",
                      std::to_string(denied) + " of 20000 values are not");
    if constexpr (ReachLimitedShading<F>)
        report.expect(out_of_reach == 0, "what lies out of reach is black",
                      std::to_string(out_of_reach) + " of 20000 values are not");
}

/// Given offset and distance, it answers as if it had computed them.
template <DistanceShading F, class MakeSurface>
void expect_same_at_distance(const F& shade, const MakeSurface& surface, Report& report) {
    Random random = numbers(67);
    std::size_t different = 0;
    for (int i = 0; i < 20000; ++i) {
        const ShadedPlace at = random_shaded_place(random);
        const auto s = surface(at.normal, at.wo);
        const Vec3 offset = at.vpl.position - at.hit.position;
        const Rgb told = shade.at_distance(at.hit, s, at.vpl, offset, F::inverse_distance(offset));
        different += bits_of(told) == bits_of(shade(at.hit, s, at.vpl)) ? 0 : 1;
    }
    report.expect(different == 0, "at_distance() is the same in every bit",
                  std::to_string(different) + " of 20000 values are not");
}

/// Given what it prepared, it answers as if it had not.
template <PreparedShading F, class MakeSurface>
void expect_same_when_prepared(const F& shade, const MakeSurface& surface, Report& report) {
    Random random = numbers(68);
    std::size_t different = 0;
    for (int i = 0; i < 20000; ++i) {
        const ShadedPlace at = random_shaded_place(random);
        const auto s = surface(at.normal, at.wo);
        const Rgb prepared = shade(shade.prepared(at.hit, s), at.vpl);
        different += bits_of(prepared) == bits_of(shade(at.hit, s, at.vpl)) ? 0 : 1;
    }
    report.expect(different == 0, "prepared() changes no bit",
                  std::to_string(different) + " of 20000 values are not the same");
}

}  // namespace detail

/// The axioms of Shading, and of ReachLimitedShading, SurfaceSelectiveShading, DistanceShading and
/// PreparedShading where `shade` is one. `surface(normal, wo)` makes the surface data of a luxel of
/// some material that reflects, from its unit shading normal and the unit direction towards the
/// viewer; surfaces_with() does so for mir's own. Luxels and VPLs stand on all sides of each other,
/// 0.1 mm to 1 km apart.
template <Shading F, class MakeSurface>
Report check_shading(const F& shade, const MakeSurface& surface) {
    Report report;
    detail::expect_radiances(shade, surface, report);
    detail::expect_linear(shade, surface, report);
    detail::expect_nothing_skipped(shade, surface, report);
    if constexpr (DistanceShading<F>) detail::expect_same_at_distance(shade, surface, report);
    if constexpr (PreparedShading<F>) detail::expect_same_when_prepared(shade, surface, report);
    return report;
}

/// Closed form of shading by points without bound: J f cos cos / d^2. In double precision, to a
/// relative `tolerance`; `reflect(normal, wi, wo)` is f of the surfaces that `surface` makes,
/// sr^-1. Pairs whose cosines are below 0.01, where directions of single precision are too coarse,
/// are left out; so must be lobes that are narrower than the tolerance.
template <Shading F, class MakeSurface, class Reflect>
Report check_shading_by_closed_form(const F& shade, const MakeSurface& surface,
                                    const Reflect& reflect, double tolerance = 1e-4) {
    Random random = detail::numbers(64);
    std::size_t asked = 0;
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const detail::ShadedPlace at = detail::random_shaded_place(random);
        if (at.cos_luxel() < 0.01 || at.cos_vpl() < 0.01) continue;
        ++asked;
        const Rgb found = shade(at.hit, surface(at.normal, at.wo), at.vpl);
        const double g = at.cos_luxel() * at.cos_vpl() / at.distance_squared();
        const Rgb unit = reflect(at.normal, at.wi(), at.wo) * at.vpl.intensity;
        worst =
            detail::worse(worst, detail::relative_difference(found, unit * static_cast<float>(g)));
    }
    Report report;
    report.expect(asked > 1000, "pairs face each other", std::to_string(asked) + " of 20000 do");
    report.expect(worst <= tolerance, "light is J f cos cos / d^2",
                  "it differs by up to " + number_text(worst) + " of it");
    return report;
}

/// Reciprocity of shading by points, for surfaces that are reciprocal. When viewer and VPL change
/// places, what arrives per cosine stays the same, to a relative `tolerance`. The VPL is `distance`
/// metres away, where neither a bound nor a VPL's extent may matter.
template <Shading F, class MakeSurface>
Report check_shading_reciprocity(const F& shade, const MakeSurface& surface, float distance = 1.0f,
                                 double tolerance = 1e-4) {
    Random random = detail::numbers(65);
    double worst = 0.0;
    std::size_t lit = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 n = detail::direction(random);
        const Frame frame = Frame::around(n);
        const Vec3 a = frame.to_world(square_to_cosine_hemisphere(random.next_2d()));
        const Vec3 b = frame.to_world(square_to_cosine_hemisphere(random.next_2d()));
        if (glm::dot(n, a) < 0.01f || glm::dot(n, b) < 0.01f) continue;
        const auto seen = [&](Vec3 wi, Vec3 wo) {
            const Hit hit{Vec3(0.0f), n};
            return shade(hit, surface(n, wo), {distance * wi, -wi, {1.0f, 1.0f, 1.0f}}) *
                   (1.0f / glm::dot(n, wi));
        };
        const Rgb there = seen(a, b);
        lit += is_black(there) ? 0 : 1;
        worst = detail::worse(worst, detail::relative_difference(there, seen(b, a)));
    }
    Report report;
    report.expect(lit > 1000, "VPLs light the luxels", std::to_string(lit) + " of 5000 do");
    report.expect(worst <= tolerance, "viewer and VPL may change places",
                  "light differs by up to " + number_text(worst) + " of it");
    return report;
}

/// Shading under a bound is never brighter than without. In no channel by more than a relative
/// 1e-6; it is the same for some pairs and darker for others.
template <Shading F, Shading U, class MakeSurface>
Report check_shading_bound(const F& bounded, const U& unbounded, const MakeSurface& surface) {
    Random random = detail::numbers(66);
    std::size_t brighter = 0;
    std::size_t same = 0;
    std::size_t darker = 0;
    for (int i = 0; i < 20000; ++i) {
        const detail::ShadedPlace at = detail::random_shaded_place(random);
        const auto s = surface(at.normal, at.wo);
        const Rgb kept = bounded(at.hit, s, at.vpl);
        const Rgb whole = unbounded(at.hit, s, at.vpl);
        if (is_black(whole) && is_black(kept)) continue;
        const Rgb most = whole * (1.0f + 1e-6f);
        if (!(kept.r <= most.r && kept.g <= most.g && kept.b <= most.b))
            ++brighter;
        else
            ++(detail::relative_difference(kept, whole) < 1e-5 ? same : darker);
    }
    Report report;
    report.expect(brighter == 0, "the bound adds no light",
                  std::to_string(brighter) + " of 20000 values are brighter");
    report.expect(same > 100, "the bound leaves some pairs alone",
                  std::to_string(same) + " of 20000 values are the same");
    report.expect(darker > 100, "the bound takes light from some pairs",
                  std::to_string(darker) + " of 20000 values are darker");
    return report;
}

/// All axioms of Shading, its closed form and its reciprocity. For shading by points without bound.
template <Shading F, class MakeSurface, class Reflect>
Report check_shading(const F& shade, const MakeSurface& surface, const Reflect& reflect) {
    Report report;
    report.add("axioms", check_shading(shade, surface));
    report.add("closed form", check_shading_by_closed_form(shade, surface, reflect));
    report.add("reciprocity", check_shading_reciprocity(shade, surface));
    return report;
}

}  // namespace mir::validation
