// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/instruction_set.hpp"
#include "mir/core/math.hpp"
#include "mir/core/space.hpp"
#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"

#include <concepts>
#include <cstdint>

namespace mir {

/// Answers whether two points see each other. The points are already lifted off their surfaces
/// (core/ray.hpp), so the whole closed segment is tested and no further offset is applied.
///
/// Axioms (validation/visibility.hpp):
///  1. symmetric up to rounding at grazing edges; a luxel and a VPL are always asked VPL first;
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
    static constexpr std::uint32_t width = 16;  ///< number of points
    float x[width];                             ///< metres
    float y[width];                             ///< metres
    float z[width];                             ///< metres
};

/// The packet interface of Visibility: one origin against up to sixteen points. Bit i of the result
/// is set when bit i of `active` is set and point i sees the origin.
///
/// Axiom: bit i equals visible(origin, point i). Engines of our own keep it always; Embree keeps it
/// except for segments that touch an edge or a vertex to the last bit, where its packets and its
/// single rays may decide the tie differently (docs/validation.md has the measured rate).
template <class V>
concept PacketVisibility = Visibility<V> &&
    requires(const V v, Vec3 origin, const PointPacket& points, std::uint32_t m) {
    { v.visible_packet(origin, points, m) } -> std::same_as<std::uint32_t>;
};

/// A bit for each luxel of a block of 256. Word g belongs to the packet of luxels 16 g to 16 g +
/// 15.
struct alignas(64) BlockMask {
    static constexpr std::uint32_t luxels = 256;                           ///< bits of a mask
    static constexpr std::uint32_t packets = luxels / PointPacket::width;  ///< words of a mask

    std::uint32_t packet[packets] = {};  ///< bit k of word g: luxel 16 g + k

    /// True when a bit is set.
    [[nodiscard]] bool any() const {
        std::uint32_t bits = 0;
        for (const std::uint32_t p : packet) bits |= p;
        return bits != 0;
    }
};

/// The block interface of Visibility: one origin against up to 256 luxels. Each block is asked
/// for many origins. `block(luxels, set)` prepares a block once, from its luxels in planes,
/// padded with empty ones, which must outlive it; its loops may use the instruction set `set`.
/// Then visible_block(block, origin, mask) clears the bits of luxels that do not see the
/// origin; no bit may be set of a luxel that is empty or not a number. A block may be shared by
/// threads.
///
/// Axioms (tests/conformance/block_suite.hpp):
///  1. what is left is set in the mask that was given;
///  2. a bit that was set stays if and only if visible(origin, position of the luxel), bit for bit,
///     whatever other bits are set and whatever the instruction set.
template <class V>
concept BlockVisibility = PacketVisibility<V> &&
    requires(const V v, const typename V::Block& block, const SoaView<const Hit>& luxels,
             InstructionSet set, Vec3 origin, BlockMask& mask) {
    { v.block(luxels, set) } -> std::same_as<typename V::Block>;
    { v.visible_block(block, origin, mask) } -> std::same_as<void>;
};

}  // namespace mir
