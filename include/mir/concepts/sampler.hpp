// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/vpl_record.hpp"

#include <concepts>

namespace mir {

/// Places VPLs. All samplers yield the same records; `normalisation` says what is left to do to
/// make intensities of them.
///
/// Axioms (validation/sampler.hpp):
///  1. same sampler, same records, for any executor;
///  2. intensities are finite, not negative and not black;
///  3. the mean over seeds converges to the light of the scene (statistical).
template <class S>
concept Sampler = requires(const S s, InlineExecutor& executor) {
    { S::normalisation } -> std::convertible_to<Normalisation>;
    { s.sample(executor) } -> std::same_as<VplRecords>;
};

}  // namespace mir
