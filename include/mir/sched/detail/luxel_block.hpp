// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"

#include <limits>

namespace mir::sched::detail {

/// Sixteen neighbouring luxels: one vector register, one ray packet.
inline constexpr std::uint32_t group_size = PointPacket::width;
inline constexpr std::uint32_t groups_per_block = BlockedLayout::block_size / group_size;

/// Radiance of one block while VPLs are added to it, structure of arrays.
struct alignas(64) BlockRadiance {
    float r[BlockedLayout::block_size] = {};
    float g[BlockedLayout::block_size] = {};
    float b[BlockedLayout::block_size] = {};
};

/// Box around the luxels of a block that see something.
struct BlockBounds {
    Vec3 low{std::numeric_limits<float>::max()};
    Vec3 high{std::numeric_limits<float>::lowest()};
    bool empty = true;

    void add(Vec3 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
        empty = false;
    }

    /// True when no point of the box lies in front of the VPL: not even the farthest corner along
    /// its normal. The margin covers the rounding of both this test and faces(), so that no pair
    /// that faces() accepts is ever lost.
    [[nodiscard]] bool behind(const Vpl& vpl) const {
        const Vec3 centre = 0.5f * (low + high);
        const Vec3 half = 0.5f * (high - low);
        const float reach = glm::dot(glm::abs(vpl.normal), half);
        const float magnitude = max_abs(low) + max_abs(high) + max_abs(vpl.position);
        return glm::dot(centre - vpl.position, vpl.normal) + reach < -32.0f * 0x1p-24f * magnitude;
    }

    /// Squared distance from a point to the box.
    [[nodiscard]] float distance_squared(Vec3 p) const {
        return length_squared(glm::max(glm::max(low - p, p - high), Vec3(0.0f)));
    }
};

/// Positions of a group as the packet face of Visibility wants them.
inline void load_points(SoaView<const Hit> group, PointPacket& points) {
    for (std::uint32_t k = 0; k < group_size; ++k) {
        const Vec3 p = group.load(k).position;
        points.x[k] = p.x;
        points.y[k] = p.y;
        points.z[k] = p.z;
    }
}

/// Bit k: luxel k of the group faces the VPL. The arithmetic is that of faces(), bit for bit;
/// empty luxels have a zero normal and never face anything.
[[gnu::always_inline]] inline std::uint32_t facing_mask(SoaView<const Hit> group, Vpl vpl) {
    std::uint32_t mask = 0;
    for (std::uint32_t k = 0; k < group_size; ++k) {
        const Hit hit = group.load(k);
        const Vec3 d = vpl.position - hit.position;
        const std::uint32_t above_luxel = glm::dot(d, hit.normal) > 0.0f ? 1u << k : 0u;
        const std::uint32_t above_vpl = glm::dot(d, vpl.normal) < 0.0f ? 1u << k : 0u;
        mask |= above_luxel & above_vpl;
    }
    return mask;
}

/// Adds the VPL to the luxels of a group whose bit is set in `lit`. Every lane is computed and
/// unlit ones add zero: the loop becomes one pass over vector registers.
template <Shading F>
[[gnu::always_inline]] inline void add_shaded(SoaView<const Hit> hits,
                                              SoaView<const typename F::Surface> surfaces,
                                              Vpl vpl, F shade, std::uint32_t lit, float* r,
                                              float* g, float* b) {
    // Own arrays first: stores that might alias the inputs would forbid vectorising.
    float red[group_size];
    float green[group_size];
    float blue[group_size];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::uint32_t k = 0; k < group_size; ++k) {
        const Rgb c = shade(hits.load(k), surfaces.load(k), vpl);
        const bool on = (lit & (1u << k)) != 0;
        red[k] = on ? c.r : 0.0f;
        green[k] = on ? c.g : 0.0f;
        blue[k] = on ? c.b : 0.0f;
    }
    for (std::uint32_t k = 0; k < group_size; ++k) r[k] += red[k];
    for (std::uint32_t k = 0; k < group_size; ++k) g[k] += green[k];
    for (std::uint32_t k = 0; k < group_size; ++k) b[k] += blue[k];
}

/// The luxels from `first` on, in the same planes.
template <class T>
SoaView<T> starting_at(SoaView<T> view, std::uint32_t first) {
    return {view.planes + first, view.stride};
}

}  // namespace mir::sched::detail
