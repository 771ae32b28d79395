// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/passes.hpp"
#include "conformance/worlds.hpp"
#include "mir/validation/bsdf.hpp"
#include "mir/validation/bsdf_samples.hpp"

// The axioms of Bsdf, for a list of parameters that should cover the corners of the model.

namespace mirtest {

using mir::validation::detail::at_angle;
using mir::validation::detail::integrate;
using mir::validation::detail::is_radiance;
using mir::validation::detail::slanted_normal;
using mir::validation::detail::usual_cosines;

/// Everything but the statistical axiom.
template <mir::Bsdf B>
void bsdf_suite(std::span<const typename B::Params> list) {
    passes(mir::validation::check_bsdf<B>(list));
}

/// The statistical axiom; hypothesis, level and seed: see check_bsdf_samples().
template <mir::Bsdf B>
void bsdf_samples_follow_pdf(const typename B::Params& p, float cosine) {
    passes(mir::validation::check_bsdf_samples<B>(p, cosine));
}

}  // namespace mirtest
