// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "mir/core/number_text.hpp"
#include "mir/validation/detail/image_light.hpp"
#include "mir/validation/detail/same_records.hpp"
#include "mir/validation/known_light.hpp"
#include "mir/validation/referee.hpp"
#include "mir/validation/report.hpp"

#include <cmath>
#include <string>

namespace mir::validation {

namespace detail {

/// "12 of 34 do not".
inline std::string so_many(std::size_t bad, std::size_t all) {
    return std::to_string(bad) + " of " + std::to_string(all) + " do not";
}

/// Axiom 2 of Sampler, and what every reader of records relies on.
inline void expect_sound_records(const VplRecords& from, Report& report) {
    std::size_t dull = 0;
    std::size_t bent = 0;
    std::size_t uncounted = 0;
    for (const VplRecord& r : from.records) {
        const bool radiant = is_finite(r.vpl.intensity) && r.vpl.intensity.r >= 0.0f &&
                             r.vpl.intensity.g >= 0.0f && r.vpl.intensity.b >= 0.0f;
        dull += radiant && !is_black(r.vpl.intensity) ? 0 : 1;
        const bool placed =
            is_finite(r.vpl.position) && std::fabs(glm::length(r.vpl.normal) - 1.0f) < 1e-4f;
        bent += placed ? 0 : 1;
        const bool counts = r.bounce >= 1 && std::isfinite(r.weight) && r.weight > 0.0f;
        uncounted += counts ? 0 : 1;
    }
    const std::size_t all = from.records.size();
    report.expect(dull == 0, "records send out finite light", so_many(dull, all));
    report.expect(bent == 0, "records have a place and a unit normal", so_many(bent, all));
    report.expect(uncounted == 0, "records have a bounce and a positive weight",
                  so_many(uncounted, all));
    report.expect(std::isfinite(from.emitted_power) && from.emitted_power >= 0.0f,
                  "the emitted power is finite and not negative",
                  number_text(from.emitted_power) + " W");
    const float share = from.non_lambertian_share;
    report.expect(share >= 0.0f && share <= 1.0f, "the non-Lambertian share is 0 to 1",
                  number_text(share));
}

/// What normalisation by the image relies on.
inline void expect_counted_states(const VplRecords& from, Report& report) {
    double weights = 0.0;
    for (const VplRecord& r : from.records) weights += static_cast<double>(r.weight);
    report.expect(std::fabs(weights - from.states) <= 1e-4 * from.states,
                  "weights add up to the recorded states",
                  std::to_string(weights) + " of " + std::to_string(from.states));
    report.expect(std::isfinite(from.path_luminance) && from.path_luminance >= 0.0,
                  "P_c is finite and not negative", number_text(from.path_luminance));
}

/// Whether a VPL lies within `reach` metres of a triangle. It must lie above the side that its
/// normal names.
inline bool lies_on_surface(const WorldGeometry& geometry, const Vpl& vpl, float reach) {
    const Referee referee(geometry);
    for (std::uint32_t i = 0; i < geometry.triangles().size(); ++i) {
        const Vec3 front = geometry.front_normal(i);
        const auto foot = referee.line(i, Referee::Double3(vpl.position), Referee::Double3(front));
        if (!foot || foot->inside() < -1e-3) continue;
        const double height = foot->t < 0.0 ? -foot->t : foot->t;
        const float side = foot->t < 0.0 ? 1.0f : -1.0f;
        if (height > 0.0 && height <= static_cast<double>(reach) &&
            side * glm::dot(front, vpl.normal) > 0.999f)
            return true;
    }
    return false;
}

}  // namespace detail

/// Axioms 1 and 2 of Sampler: records are sound and repeatable. They are the same for any executor
/// and each time, and others for another seed. `make(seed)` gives the sampler; `others` are
/// executors that run loops in other ways than InlineExecutor. The scene must have light to place
/// VPLs for.
template <class Make, Executor... Others>
Report check_sampler_records(const Make& make, Others&... others) {
    const auto sampler = make(std::uint64_t{7});
    using S = std::remove_cv_t<decltype(sampler)>;
    static_assert(Sampler<S>, "mir: what make(seed) gives is not a model of Sampler");
    InlineExecutor one;
    Report report;
    const VplRecords wanted = sampler.sample(one);
    report.expect(!wanted.records.empty(), "there are records", "none");
    detail::expect_sound_records(wanted, report);
    if constexpr (S::normalisation == Normalisation::image_response)
        detail::expect_counted_states(wanted, report);
    const auto expect_same = [&](const VplRecords& found, const char* axiom) {
        report.expect(detail::same_records(found, wanted), axiom, "they differ");
    };
    expect_same(sampler.sample(one), "a sampler makes the same records each time");
    expect_same(make(std::uint64_t{7}).sample(one), "the same seed makes the same records");
    (expect_same(sampler.sample(others), "any executor makes the same records"), ...);
    report.expect(!detail::same_records(make(std::uint64_t{8}).sample(one), wanted),
                  "another seed makes other records", "they are the same");
    return report;
}

/// Every VPL lies within `reach` metres of a triangle. It is lifted to the side that its normal
/// names; `reach` is a thousandth of the scene's size by default. Takes time in proportion to VPLs
/// times triangles.
template <Sampler S>
Report check_vpl_places(const S& sampler, const WorldGeometry& geometry, float reach = 0.0f) {
    if (reach == 0.0f) reach = 1e-3f * geometry.bounds().diagonal();
    InlineExecutor executor;
    const VplRecords from = sampler.sample(executor);
    std::size_t astray = 0;
    for (const VplRecord& r : from.records)
        astray += detail::lies_on_surface(geometry, r.vpl, reach) ? 0 : 1;
    Report report;
    report.expect(astray == 0, "VPLs lie on surfaces, on the side of their normal",
                  detail::so_many(astray, from.records.size()));
    return report;
}

/// Axiom 3 of Sampler: the mean over seeds is the light of the scene. `make(seed)` gives the
/// sampler for `room`, which brings the light of `bounces`. Hypotheses: the first three of its
/// bounces, and all of them together, have the radiance that the room knows, in each quarter of the
/// image and in all of it, channel by channel; P_c, of samplers that leave normalisation to the
/// image, is the luminance of all. Student's t over seeds 0 to 31, each at level 1e-6; 1e-3 of the
/// value is allowed for means over luxels. The standard error of the whole must stay below 3 %:
/// light that is a fourth too bright or too dark is then found. VPLs of bounces that have no light
/// must bring none.
template <class Make>
Report check_sampler_light(const Make& make, const KnownLight& room, Bounces bounces = {}) {
    Report report;
    detail::ImageLight light(room, bounces);
    VplRecords from;
    InlineExecutor executor;
    for (std::uint64_t seed = 0; seed < 32; ++seed) {
        const auto sampler = make(seed);
        from = sampler.sample(executor);
        light.add<std::remove_cv_t<decltype(sampler)>::normalisation>(from);
    }
    const double power = static_cast<double>(from.emitted_power);
    report.expect(std::fabs(power / room.emitted_power() - 1.0) < 1e-4,
                  "the emitted power is that of the lamps",
                  number_text(power) + " instead of " + number_text(room.emitted_power()) + " W");
    light.judge(report);
    return report;
}

/// All axioms of Sampler, in a scene of known light. known_furnace() makes it or, for samplers that
/// bring direct light, known_squares(). Takes the time of 32 images of 16 x 16 luxels.
template <class Make, Executor... Others>
Report check_sampler(const Make& make, const KnownLight& room, Bounces bounces = {},
                     Others&... others) {
    Report report;
    report.add("records", check_sampler_records(make, others...));
    report.add("places", check_vpl_places(make(std::uint64_t{0}), room.geometry()));
    report.add("light", check_sampler_light(make, room, bounces));
    return report;
}

}  // namespace mir::validation
