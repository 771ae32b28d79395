// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/light_source.hpp"
#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

// The axioms of LightSource. A light is asked about where it can be seen from `LightView::from`.

namespace mirtest {

/// What is known of a light beforehand, and a receiver in front of it.
struct LightView {
    double power = 0.0;             ///< luminance, W
    mir::Vec3 from{0};              ///< a place that it lights, metres
    mir::Vec3 normal{0, 1, 0};      ///< unit, of the receiver there
    std::uint64_t seed = 0;         ///< of the suite's numbers
    double level = 1e-3;            ///< of each of its three tests
    std::uint32_t samples = 20000;  ///< of each estimate
};

namespace detail {

/// Irradiance that one point brings to the receiver, luminance, W m^-2, over its density.
template <mir::LightSource L>
double irradiance(const L& source, const mir::LightPoint& p, float pdf, const LightView& view) {
    mir::Vec3 wi = -p.normal;
    float d2 = 1.0f;
    if (L::origin != mir::LightOrigin::outside) {
        d2 = mir::length_squared(p.position - view.from);
        wi = (p.position - view.from) * (1.0f / std::sqrt(d2));
    }
    const float cosine = mir::larger(glm::dot(wi, view.normal), 0.0f);
    return static_cast<double>(mir::luminance(p.emission) * source.share(p.normal, -wi) * cosine) /
           static_cast<double>(d2 * pdf);
}

}  // namespace detail

/// flux() is emission and share over all densities, and its mean is the light's power.
template <mir::LightSource L>
void flux_is_light_over_density(const L& source, const LightView& view) {
    mir::Random random(view.seed, mir::Stream::test, 1);
    Moments power;
    for (std::uint32_t i = 0; i < view.samples; ++i) {
        const mir::Vec2 on_light = random.next_2d();
        const mir::LightPoint p = source.start(on_light, random.next());
        const mir::Vec3 w = source.ray(p.position, p.normal, random.next_2d()).direction;
        const double flux = mir::luminance(source.flux(p, w, 1.0f));
        const double density =
            static_cast<double>(p.pdf_start()) * source.ray_density(p.normal, w, 1.0f, 1.0f);
        const double wanted = static_cast<double>(mir::luminance(p.emission)) *
                              static_cast<double>(source.share(p.normal, w)) / density;
        if (density > 1e-3) CHECK(flux == Approx(wanted).epsilon(1e-3).margin(1e-6));
        CHECK(static_cast<double>(mir::luminance(source.flux(p, w, 0.25f))) ==
              Approx(4.0 * flux).epsilon(1e-5));
        power.add(flux);
    }
    CHECK(mean_p_value(power, view.power, 1e-5 * view.power) > view.level);
}

/// Rays that leave a point have the density that ray_density() tells; it integrates to 1.
template <mir::LightSource L>
void rays_follow_their_density(const L& source, const LightView& view) {
    mir::Random random(view.seed, mir::Stream::test, 2);
    const mir::Vec3 axis = mir::square_to_sphere(random.next_2d());
    const mir::LightPoint p = source.start(random.next_2d(), random.next());
    // A function of directions that is no constant.
    const auto bump = [&](mir::Vec3 w) { return std::exp(static_cast<double>(glm::dot(w, axis))); };
    Moments drawn;
    Moments told;
    Moments all;
    for (std::uint32_t i = 0; i < view.samples; ++i) {
        const mir::Ray ray = source.ray(p.position, p.normal, random.next_2d());
        CHECK(std::fabs(glm::length(ray.direction) - 1.0f) < 1e-5f);
        if (L::origin == mir::LightOrigin::outside) {
            CHECK(ray.direction == p.normal);
            continue;
        }
        CHECK(ray.origin == p.position);
        drawn.add(bump(ray.direction));
        const mir::Vec3 w = mir::square_to_sphere(random.next_2d());
        const double density = source.ray_density(p.normal, w, 1.0f, 1.0f) / mir::sphere_pdf();
        told.add(density * bump(w));
        all.add(density);
    }
    if (L::origin == mir::LightOrigin::outside) return;
    CHECK(welch_p_value(drawn, told) > view.level);
    CHECK(mean_p_value(all, 1.0, 1e-5) > view.level);
}

/// Points for a receiver and points for light paths are of the same light.
template <mir::LightSource L>
void samples_and_starts_agree(const L& source, const LightView& view) {
    mir::Random random(view.seed, mir::Stream::test, 3);
    Moments sampled;
    Moments started;
    for (std::uint32_t i = 0; i < view.samples; ++i) {
        const mir::Vec2 u = random.next_2d();
        const mir::LightPoint p = source.sample(u, view.from);
        CHECK(p.position == source.sample(u, view.from).position);
        sampled.add(detail::irradiance(source, p, p.pdf, view));
        const mir::Vec2 v = random.next_2d();
        const mir::LightPoint q = source.start(v, random.next());
        started.add(detail::irradiance(source, q, q.pdf_start(), view));
    }
    CHECK(sampled.mean() > 0.0);
    if (L::has_extent)
        CHECK(welch_p_value(sampled, started) > view.level);
    else
        CHECK(sampled.mean() == Approx(started.mean()));
}

/// All axioms of LightSource.
template <mir::LightSource L>
void check_light_source(const L& source, const LightView& view) {
    flux_is_light_over_density(source, view);
    rays_follow_their_density(source, view);
    samples_and_starts_agree(source, view);
}

}  // namespace mirtest
