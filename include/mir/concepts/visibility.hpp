// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/space.hpp"

#include <concepts>
#include <cstdint>

namespace mir {

/// Answers whether two points see each other. The points are already lifted off their surfaces
/// (core/ray.hpp), so the whole closed segment is tested and no further offset is applied.
///
/// Axioms (tests/conformance/visibility_suite.hpp):
///  1. symmetric up to rounding at grazing edges; a pair is always asked VPL first;
///  2. points lifted off a surface are not hidden by it;
///  3. callable from many threads at once;
///  4. agrees with brute force on random triangles.
template <class V>
concept Visibility = DeviceCopyable<V> && requires(const V v, Vec3 a, Vec3 b) {
    { V::space } -> std::convertible_to<Space>;
    { v.visible(a, b) } -> std::same_as<bool>;
};

/// Sixteen points in structure-of-arrays order, as vector units read them.
struct alignas(64) PointPacket {
    static constexpr std::uint32_t width = 16;
    float x[width];
    float y[width];
    float z[width];
};

/// The block face of Visibility: one origin against up to sixteen points. Bit i of the result is
/// set when bit i of `active` is set and point i sees the origin.
///
/// Axiom: bit i equals visible(origin, point i). Engines of our own keep it always; Embree keeps it
/// but for segments that touch an edge or a vertex to the last bit, where its packets and its
/// single rays may decide the tie differently (docs/validation.md has the measured rate).
template <class V>
concept PacketVisibility = Visibility<V> &&
    requires(const V v, Vec3 origin, const PointPacket& points, std::uint32_t m) {
    { v.visible_packet(origin, points, m) } -> std::same_as<std::uint32_t>;
};

}  // namespace mir
