// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/passes.hpp"
#include "mir/validation/sampler.hpp"
#include "support/catch.hpp"
#include "support/same_records.hpp"

// The axioms of Sampler. `make(seed)` gives the sampler to be tested; the third axiom, that the
// mean converges to the light of the scene, needs a scene of known light and stands where one is.

namespace mirtest {

/// Records are places that send out finite light.
inline void records_are_sound(const mir::VplRecords& from) {
    mir::validation::Report report;
    mir::validation::detail::expect_sound_records(from, report);
    passes(report);
}

/// Axioms 1 and 2. `others` are executors that run loops in other ways than InlineExecutor.
template <class Make, mir::Executor... Others>
void sampler_suite(const Make& make, Others&... others) {
    passes(mir::validation::check_sampler_records(make, others...));
}

}  // namespace mirtest
