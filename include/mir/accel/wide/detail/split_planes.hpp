// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/triangle_parts.hpp"

namespace mir::detail {

/// A plane at which a box is cut.
struct SplitPlane {
    int axis = -1;        ///< -1: there is none
    double at = 0.0;      ///< metres
    float weight = 0.0f;  ///< 1 in the middle of the scene, half of that for each level below

    [[nodiscard]] MIR_HD bool exists() const { return axis >= 0; }
};

/// The planes between cells of Morton's curve through a scene. All triangles are cut at the same
/// ones, so that their parts lie in the same boxes.
struct SplitPlanes {
    static constexpr std::uint32_t cells = 1u << 21;  ///< per axis, as fine_morton_code()

    Double3 low{0};      ///< of the scene, metres
    double cell = 0.0;   ///< metres
    double scale = 0.0;  ///< 1 / cell; 0 if the scene has no extent

    /// The coarsest plane that cuts the box, of several that across its longest side.
    [[nodiscard]] MIR_HD SplitPlane coarsest_in(const PartBox& box) const {
        SplitPlane best;
        std::uint32_t best_bits = 0;
        double longest = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint32_t last = cell_of(box.high[axis], axis);
            const std::uint32_t below = below_top(cell_of(box.low[axis], axis) ^ last);
            const double at =
                strict::add(low[axis], strict::mul(static_cast<double>(last & ~below), cell));
            const double length = strict::sub(box.high[axis], box.low[axis]);
            if (!(box.low[axis] < at && at < box.high[axis])) continue;
            if (best.exists() && (below < best_bits || (below == best_bits && length <= longest)))
                continue;
            best = {axis, at, static_cast<float>(below + 1) * (2.0f / cells)};
            best_bits = below;
            longest = length;
        }
        return best;
    }

 private:
    [[nodiscard]] MIR_HD std::uint32_t cell_of(double x, int axis) const {
        const double place = strict::mul(strict::sub(x, low[axis]), scale);
        if (!(place > 0.0)) return 0;
        return place < cells ? static_cast<std::uint32_t>(place) : cells - 1;
    }

    /// All bits below the highest one.
    [[nodiscard]] MIR_HD static std::uint32_t below_top(std::uint32_t bits) {
        for (std::uint32_t step = 1; step < 32; step *= 2) bits |= bits >> step;
        return bits >> 1;
    }
};

/// Planes of a scene from `low` on, with this longest extent, metres.
inline SplitPlanes split_planes(Vec3 low, float widest) {
    const double cell = static_cast<double>(widest) / SplitPlanes::cells;
    return {Double3(low), cell, cell > 0.0 ? 1.0 / cell : 0.0};
}

}  // namespace mir::detail
