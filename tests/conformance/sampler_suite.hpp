// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "support/catch.hpp"
#include "support/same_records.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

// The axioms of Sampler. `make(seed)` gives the sampler to be tested; the third axiom, that the
// mean converges to the light of the scene, needs a scene of known light and stands where one is.

namespace mirtest {

/// Records are places on surfaces that send out finite light.
inline void records_are_sound(const mir::VplRecords& from) {
    std::size_t bad = 0;
    for (const mir::VplRecord& r : from.records) {
        const mir::Rgb j = r.vpl.intensity;
        const bool radiant =
            mir::is_finite(j) && j.r >= 0.0f && j.g >= 0.0f && j.b >= 0.0f && !mir::is_black(j);
        const bool placed =
            mir::is_finite(r.vpl.position) && std::fabs(glm::length(r.vpl.normal) - 1.0f) < 1e-4f;
        bad += radiant && placed && r.bounce >= 1 && r.weight > 0.0f ? 0 : 1;
    }
    CHECK(bad == 0);
    CHECK(std::isfinite(from.emitted_power));
    CHECK(from.emitted_power >= 0.0f);
    CHECK(from.non_lambertian_share >= 0.0f);
    CHECK(from.non_lambertian_share <= 1.0f);
}

/// Axioms 1 and 2. `others` are executors that run loops in other ways than InlineExecutor.
template <class Make, mir::Executor... Others>
void sampler_suite(const Make& make, Others&... others) {
    static_assert(mir::Sampler<decltype(make(std::uint64_t{}))>);
    mir::InlineExecutor one;
    const auto sampler = make(std::uint64_t{7});
    const mir::VplRecords wanted = sampler.sample(one);
    CHECK(!wanted.records.empty());
    records_are_sound(wanted);
    CHECK(same_records(sampler.sample(one), wanted));
    CHECK(same_records(make(std::uint64_t{7}).sample(one), wanted));
    const bool executors_agree = (same_records(sampler.sample(others), wanted) && ...);
    CHECK(executors_agree);
    CHECK_FALSE(same_records(make(std::uint64_t{8}).sample(one), wanted));
}

}  // namespace mirtest
