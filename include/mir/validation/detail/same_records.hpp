// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_record.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace mir::validation::detail {

inline auto bits_of(const Vpl& v) { return std::bit_cast<std::array<std::uint32_t, 9>>(v); }

/// Whether two records agree in every bit of every member.
inline bool same_record(const VplRecord& a, const VplRecord& b) {
    return bits_of(a.vpl) == bits_of(b.vpl) && same_place(a.origin, b.origin) &&
           a.origin.multiplicity == b.origin.multiplicity && a.bounce == b.bounce &&
           a.light_group == b.light_group && a.weight == b.weight && a.lobe_share == b.lobe_share;
}

/// Whether light arrives at two VPLs in the same way, bit for bit.
inline bool same_arrival(const VplArrival& a, const VplArrival& b) {
    return a.towards_light == b.towards_light && a.shading_normal == b.shading_normal &&
           a.power == b.power && a.material == b.material && a.is_front == b.is_front &&
           a.attributes.texture_coordinates == b.attributes.texture_coordinates &&
           a.attributes.color == b.attributes.color;
}

/// Whether two samplers' results are the same in every bit, health and seconds left aside.
inline bool same_records(const VplRecords& a, const VplRecords& b) {
    return std::equal(a.records.begin(), a.records.end(), b.records.begin(), b.records.end(),
                      same_record) &&
           std::equal(a.arrivals.begin(), a.arrivals.end(), b.arrivals.begin(), b.arrivals.end(),
                      same_arrival) &&
           a.paths == b.paths && a.emitted_power == b.emitted_power &&
           a.non_lambertian_share == b.non_lambertian_share &&
           a.path_luminance == b.path_luminance && a.states == b.states;
}

}  // namespace mir::validation::detail
