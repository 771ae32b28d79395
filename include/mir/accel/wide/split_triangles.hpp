// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/cluster_plan.hpp"
#include "mir/accel/wide/detail/split_planes.hpp"
#include "mir/scene/geometry_view.hpp"

namespace mir::detail {

/// A triangle in the form that is cut.
struct CutTriangle {
    AcceptTriangle accept;
    PartBox box;
};

template <Space S>
MIR_HD CutTriangle whole_triangle(const GeometryView<S>& geometry, std::uint32_t i,
                                  float magnitude) {
    CutTriangle t;
    t.accept = accept_triangle(geometry.corner(i, 0), geometry.corner(i, 1), geometry.corner(i, 2),
                               magnitude);
    t.box = box_of(t.accept);
    return t;
}

/// Most splits of one triangle.
inline constexpr std::uint32_t most_splits = 1023;

/// Cuts a triangle `splits` times and calls part(box) for each part. There are fewer where no plane
/// is left; returns their number. Splits of a part are shared by the lengths of what a plane makes
/// of it. No more than log2 of `most_splits` parts wait: the one with more splits does. Source:
/// Karras and Aila, "Fast parallel construction of high-quality bounding volume hierarchies", High
/// Performance Graphics 2013.
template <class Part>
MIR_HD std::uint32_t cut_into_parts(const CutTriangle& t, std::uint32_t splits,
                                    const SplitPlanes& planes, const Part& part) {
    struct Waiting {
        PartBox box;
        std::uint32_t splits;
    };
    Waiting waiting[10];
    std::uint32_t count = 0;
    std::uint32_t parts = 0;
    Waiting now{t.box, splits};
    for (;;) {
        const SplitPlane plane = now.splits > 0 ? planes.coarsest_in(now.box) : SplitPlane{};
        if (!plane.exists()) {
            part(parts++, now.box);
            if (count == 0) return parts;
            now = waiting[--count];
            continue;
        }
        const PartPair pair = cut_part(t.accept, now.box, plane.axis, plane.at);
        const double below = longest_side(pair.below);
        const double share = strict::div(below, strict::add(below, longest_side(pair.above)));
        const std::uint32_t left = now.splits - 1;
        const auto to_below = static_cast<std::uint32_t>(
            strict::add(strict::mul(share, static_cast<double>(left)), 0.5));
        const Waiting a{pair.below, to_below};
        const Waiting b{pair.above, left - to_below};
        waiting[count++] = a.splits < b.splits ? b : a;
        now = a.splits < b.splits ? a : b;
    }
}

/// Kernel over triangles. How much each gains by splits, as a number that is multiplied by a
/// common density to get its number of splits; 0 where there is nothing to gain. What counts is
/// the part of the box's surface that the triangle does not need, and how coarse the plane is that
/// cuts it; after Karras and Aila, with a fourth root, which all machines round alike, instead of
/// the third.
template <Space S>
struct RateTriangles {
    GeometryView<S> geometry;
    ClusterPlan plan;
    float* gains = nullptr;

    MIR_HD void operator()(std::uint32_t i) const {
        gains[i] = gain(whole_triangle(geometry, i, plan.magnitude));
    }

 private:
    [[nodiscard]] MIR_HD float gain(const CutTriangle& t) const {
        if (!is_within(t.box, static_cast<double>(plan.reach))) return 0.0f;
        const SplitPlane plane = plan.planes.coarsest_in(t.box);
        if (!plane.exists()) return 0.0f;
        const auto scale = static_cast<double>(plan.area_scale);
        const double full = strict::mul(well_filled, least_half_area(t.accept, scale));
        const double empty = strict::sub(half_area(t.box, scale), full);
        if (!(empty > 0.0)) return 0.0f;
        const double weighed = strict::mul(static_cast<double>(plane.weight), empty);
        return static_cast<float>(strict::sqrt(strict::sqrt(weighed)));
    }

    /// How many times its shadows a triangle's box may be before splits pay. A right triangle along
    /// two axes, as walls are made of, has 2.
    static constexpr double well_filled = 4.0;
};

/// Kernel over triangles: how many splits each gets at that density. One index more makes sums of
/// what it writes include all.
struct SplitCounts {
    const float* gains = nullptr;
    std::uint32_t* splits = nullptr;
    std::uint32_t triangles = 0;
    std::uint32_t most = 0;  ///< of one triangle
    float density = 0.0f;

    MIR_HD void operator()(std::uint32_t i) const { splits[i] = i < triangles ? of(i) : 0; }

    [[nodiscard]] MIR_HD std::uint32_t of(std::uint32_t i) const {
        const float wanted = strict::mul(density, gains[i]);
        return wanted < static_cast<float>(most) ? static_cast<std::uint32_t>(wanted) : most;
    }
};

/// Kernel over triangles and one index more: how many parts they become.
template <Space S>
struct CountParts {
    GeometryView<S> geometry;
    ClusterPlan plan;
    SplitCounts splits;
    std::uint32_t* parts = nullptr;

    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t count = i < splits.triangles ? splits.of(i) : 0;
        parts[i] = i < splits.triangles ? 1 : 0;
        if (count > 0)
            parts[i] = cut_into_parts(whole_triangle(geometry, i, plan.magnitude), count,
                                      plan.planes, [](std::uint32_t, const PartBox&) {});
    }
};

/// Kernel over one index.
struct CopyWord {
    const std::uint32_t* from = nullptr;
    std::uint32_t* to = nullptr;

    MIR_HD void operator()(std::uint32_t /*i*/) const { *to = *from; }
};

}  // namespace mir::detail
