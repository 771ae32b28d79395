// SPDX-License-Identifier: MIT
#pragma once

#include "mir/validation/detail/same_records.hpp"

namespace mirtest {

using mir::validation::detail::bits_of;
using mir::validation::detail::same_record;
using mir::validation::detail::same_records;

inline bool same(const mir::PathLuminance& a, const mir::PathLuminance& b) {
    return a.mean == b.mean && a.standard_error == b.standard_error && a.paths == b.paths &&
           a.contributing == b.contributing;
}
inline bool same(const mir::MutationCount& a, const mir::MutationCount& b) {
    return a.proposed == b.proposed && a.accepted == b.accepted;
}

/// Whether chains say the same about themselves.
inline bool same_health(const mir::ChainHealth& a, const mir::ChainHealth& b) {
    return a.chains == b.chains && a.mutations == b.mutations && same(a.large, b.large) &&
           same(a.small, b.small) && same(a.bidirectional, b.bidirectional) &&
           same(a.suffix, b.suffix) && a.longest_stay == b.longest_stay &&
           a.recorded_states == b.recorded_states && a.distinct_vpls == b.distinct_vpls &&
           a.effective_samples == b.effective_samples && a.split_r_hat == b.split_r_hat &&
           same(a.luminance, b.luminance) && same(a.large_step_luminance, b.large_step_luminance) &&
           a.capped == b.capped;
}

}  // namespace mirtest
