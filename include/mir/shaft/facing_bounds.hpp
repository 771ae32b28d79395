// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/vpl.hpp"
#include "mir/shaft/segment_forms.hpp"

#include <limits>

namespace mir {

namespace detail {

/// A constant, because device code may not ask numeric_limits.
inline constexpr float infinite = std::numeric_limits<float>::infinity();

}  // namespace detail

/// What faces() says of a VPL and all luxels of a cluster that are not empty.
enum class Facing : std::uint8_t {
    none,  ///< true of no luxel
    some,  ///< neither is shown
    all    ///< true of every luxel
};

/// Ranges of the luxels of a cluster, for facing_of(). Those that are empty do not count.
struct FacingBounds {
    Vec3 centre{0};               ///< any point, best one amid the luxels, metres
    Vec3 half{0};                 ///< no coordinate is farther from the centre's, metres
    Vec3 normal{0};               ///< amid the luxels' normals
    Vec3 spread{0};               ///< no component of a normal is farther from that
    float offset = 0.0f;          ///< amid (p - centre) . n of all luxels, metres
    float offset_spread = 0.0f;   ///< none is farther from that, metres
    float half_sum = 0.0f;        ///< sum of the half edges, metres
    float largest_normal = 0.0f;  ///< no component of a normal is larger; infinite: nothing is sure
    std::uint32_t luxels = 0;     ///< bit k: luxel k is not empty
};

/// Numbers by which facing_of() keeps away from zero. docs/shafts.md derives 29 e of `relative`.
struct FacingMargins {
    static constexpr float relative = 0x1p-18f;  ///< 64 e, of the sum of absolute products
    static constexpr float absolute = 1e-30f;    ///< for products that vanish, metres
    static constexpr float reach = 1e18f;        ///< metres; no product overflows within it
    static constexpr float normal = 2.0f;        ///< no sum of a normal's components is larger
};

namespace detail {

MIR_HD inline Vec3 absolute(Vec3 v) { return {fabsf(v.x), fabsf(v.y), fabsf(v.z)}; }

MIR_HD inline float sum_abs(Vec3 v) { return fabsf(v.x) + fabsf(v.y) + fabsf(v.z); }

/// False where a coordinate is no number, too.
MIR_HD inline bool is_within_facing_margins(const Hit& hit) {
    return sum_abs(hit.position) <= FacingMargins::reach &&
           sum_abs(hit.normal) <= FacingMargins::normal;
}

/// A number of each lane as the middle of their range and the largest distance from it.
struct MiddleOfLanes {
    float middle = 0.0f;
    float distance = 0.0f;
};

/// Of the lanes whose bit is set; any is.
MIR_HD inline MiddleOfLanes middle_of(const LaneGroup& group, std::uint32_t lanes,
                                      const LaneGroup::PerLane<float>& values) {
    LaneGroup::PerLane<float> low, high;
    group.each([&](std::uint32_t lane) {
        const bool counts = (lanes >> lane & 1u) != 0;
        low[lane] = counts ? values[lane] : infinite;
        high[lane] = counts ? values[lane] : -infinite;
    });
    const float least = group.combined(low, [](float a, float b) { return smaller(a, b); });
    const float most = group.combined(high, [](float a, float b) { return larger(a, b); });
    const float middle = 0.5f * (least + most);
    return {middle, larger(most - middle, middle - least)};
}

}  // namespace detail

/// Bounds of 32 luxels, one of each lane.
[[nodiscard]] MIR_HD inline FacingBounds facing_bounds(const LaneGroup& group,
                                                       const LaneGroup::PerLane<Hit>& luxels) {
    FacingBounds bounds;
    bounds.luxels = group.ballot([&](std::uint32_t lane) { return !is_empty(luxels[lane]); });
    if (bounds.luxels == 0) return bounds;
    LaneGroup::PerLane<float> values;
    for (int axis = 0; axis < 3; ++axis) {
        group.each([&](std::uint32_t lane) { values[lane] = luxels[lane].position[axis]; });
        const detail::MiddleOfLanes place = detail::middle_of(group, bounds.luxels, values);
        bounds.centre[axis] = place.middle;
        bounds.half[axis] = place.distance;
        group.each([&](std::uint32_t lane) { values[lane] = luxels[lane].normal[axis]; });
        const detail::MiddleOfLanes normal = detail::middle_of(group, bounds.luxels, values);
        bounds.normal[axis] = normal.middle;
        bounds.spread[axis] = normal.distance;
    }
    group.each([&](std::uint32_t lane) {
        values[lane] =
            detail::loose_dot(luxels[lane].position - bounds.centre, luxels[lane].normal);
    });
    const detail::MiddleOfLanes offset = detail::middle_of(group, bounds.luxels, values);
    bounds.offset = offset.middle;
    bounds.offset_spread = offset.distance;
    bounds.half_sum = detail::sum_abs(bounds.half);
    const std::uint32_t regular = group.ballot(
        [&](std::uint32_t lane) { return detail::is_within_facing_margins(luxels[lane]); });
    bounds.largest_normal = (bounds.luxels & ~regular) == 0
                                ? max_abs(detail::absolute(bounds.normal) + bounds.spread)
                                : detail::infinite;
    return bounds;
}

/// What can be said of all luxels and a VPL at once; host and device may differ in how often that
/// is nothing. With m = q - centre the two numbers that faces() compares with zero are
///   (q - p) . n = m . n - (p - centre) . n  and  (q - p) . n_q = m . n_q - (p - centre) . n_q,
/// of which the bounds know the ranges.
[[nodiscard]] MIR_HD inline Facing facing_of(const FacingBounds& luxels, const Vpl& vpl) {
    if (luxels.luxels == 0) return Facing::none;
    const Vec3 m = vpl.position - luxels.centre;
    const float sum = detail::sum_abs(m) + luxels.half_sum;
    if (!(sum <= FacingMargins::reach)) return Facing::some;
    if (!(detail::sum_abs(vpl.normal) <= FacingMargins::normal)) return Facing::some;
    const auto margin = [sum](float largest) {
        return FacingMargins::relative * sum * largest + FacingMargins::absolute;
    };
    const float there = detail::loose_dot(m, luxels.normal) - luxels.offset;
    const float there_differs = detail::loose_dot(detail::absolute(m), luxels.spread) +
                                luxels.offset_spread + margin(luxels.largest_normal);
    const float back = detail::loose_dot(m, vpl.normal);
    const float back_differs =
        detail::loose_dot(luxels.half, detail::absolute(vpl.normal)) + margin(max_abs(vpl.normal));
    if (there < -there_differs || back > back_differs) return Facing::none;
    return there > there_differs && back < -back_differs ? Facing::all : Facing::some;
}

}  // namespace mir
