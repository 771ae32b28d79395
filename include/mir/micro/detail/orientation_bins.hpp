// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel.hpp"
#include "mir/scene/world_geometry.hpp"

#include <array>
#include <span>

namespace mir::detail {

/// What the discs of a bin, or of several, are like.
struct OrientationBin {
    Bounds box;
    Vec3 normals{0};  ///< sum, weighted by area, m^2
    float area = 0.0f;
    std::uint32_t count = 0;

    void add(const Surfel& s) {
        for (int axis = 0; axis < 3; ++axis) {
            const float cosine = s.normal[axis];
            const float reach = s.radius * std::sqrt(larger(0.0f, 1.0f - cosine * cosine));
            box.low[axis] = smaller(box.low[axis], s.position[axis] - reach);
            box.high[axis] = larger(box.high[axis], s.position[axis] + reach);
        }
        normals += s.area * s.normal;
        area += s.area;
        ++count;
    }
    void add(const OrientationBin& o) {
        box.low = glm::min(box.low, o.box.low);
        box.high = glm::max(box.high, o.box.high);
        normals += o.normals;
        area += o.area;
        count += o.count;
    }

    /// Of the box, m^2.
    [[nodiscard]] float surface() const {
        const Vec3 e = box.high - box.low;
        return 2.0f * (e.x * e.y + e.y * e.z + e.z * e.x);
    }

    /// Solid angle into which discs of this mean normal shine. Normals spread evenly over a cone:
    /// the length of the mean is (1 + cos) / 2. Source: Conty Estevez and Kulla 2018, equation 1.
    [[nodiscard]] float orientation() const {
        const float mean = smaller(glm::length(normals) / area, 1.0f);
        const float angle = std::acos(2.0f * mean - 1.0f);
        const float most = smaller(angle + 0.5f * pi, pi);
        const float sine = std::sin(angle);
        return 2.0f * pi * (1.0f - std::cos(angle)) +
               0.5f * pi *
                   (2.0f * most * sine - std::cos(angle - 2.0f * most) - 2.0f * angle * sine +
                    std::cos(angle));
    }

    [[nodiscard]] float cost() const {
        return static_cast<float>(count) * surface() * orientation();
    }
};

/// A border between two bins. `border` bins lie below it.
struct OrientationCut {
    int axis = 0;              ///< of OrientationGrid
    std::uint32_t border = 0;  ///< 0: no plane was found
    float cost = std::numeric_limits<float>::infinity();
};

/// Where a disc's bin lies on an axis. 0 to 2 are those of places, 3 to 5 those of normals. Planes
/// in space leave some discs of one wall with the other where two walls meet, at every size;
/// normals part them at once.
struct OrientationGrid {
    static constexpr int axes = 6;

    Bounds centres;
    Bounds normals;
    std::uint32_t bins = 0;

    OrientationGrid(std::span<const Surfel> surfels, std::uint32_t bin_count) : bins(bin_count) {
        for (const Surfel& s : surfels) {
            centres.add(s.position);
            normals.add(s.normal);
        }
    }

    /// True when all discs have the same bin.
    [[nodiscard]] bool is_flat(int axis) const { return !(extent(axis) > 0.0f); }

    [[nodiscard]] std::uint32_t bin(const Surfel& s, int axis) const {
        const float place =
            (along(axis, s.position, s.normal) - along(axis, centres.low, normals.low)) /
            extent(axis);
        return std::min(static_cast<std::uint32_t>(place * static_cast<float>(bins)), bins - 1);
    }

 private:
    [[nodiscard]] static float along(int axis, Vec3 place, Vec3 normal) {
        return axis < 3 ? place[axis] : normal[axis - 3];
    }
    [[nodiscard]] float extent(int axis) const {
        return along(axis, centres.high, normals.high) - along(axis, centres.low, normals.low);
    }
};

/// The border on an axis with the least cost.
inline OrientationCut best_cut(std::span<const Surfel> surfels, const OrientationGrid& grid,
                               int axis) {
    std::array<OrientationBin, 64> bins;
    for (const Surfel& s : surfels) bins[grid.bin(s, axis)].add(s);
    std::array<float, 64> above{};
    OrientationBin sum;
    for (std::uint32_t i = grid.bins; i-- > 1;) {
        sum.add(bins[i]);
        above[i] = sum.count == 0 ? -1.0f : sum.cost();
    }
    OrientationCut best{axis, 0};
    sum = {};
    for (std::uint32_t i = 1; i < grid.bins; ++i) {
        sum.add(bins[i - 1]);
        if (sum.count == 0 || above[i] < 0.0f) continue;
        const float cost = sum.cost() + above[i];
        if (cost < best.cost) best = {axis, i, cost};
    }
    return best;
}

}  // namespace mir::detail
