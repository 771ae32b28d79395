// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/vpl_record.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace mirtest {

inline auto bits_of(const mir::Vpl& v) { return std::bit_cast<std::array<std::uint32_t, 9>>(v); }

/// Whether two records agree in every bit of every member.
inline bool same_record(const mir::VplRecord& a, const mir::VplRecord& b) {
    return bits_of(a.vpl) == bits_of(b.vpl) && mir::same_place(a.origin, b.origin) &&
           a.origin.multiplicity == b.origin.multiplicity && a.bounce == b.bounce &&
           a.light_group == b.light_group && a.weight == b.weight && a.lambertian == b.lambertian;
}

/// Whether two samplers' results are the same in every bit, health left aside.
inline bool same_records(const mir::VplRecords& a, const mir::VplRecords& b) {
    return std::equal(a.records.begin(), a.records.end(), b.records.begin(), b.records.end(),
                      same_record) &&
           a.paths == b.paths && a.emitted_power == b.emitted_power &&
           a.non_lambertian_share == b.non_lambertian_share &&
           a.path_luminance == b.path_luminance && a.states == b.states;
}

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
