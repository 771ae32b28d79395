// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/surfel_radiance.hpp"

namespace mir {

/// Kernel over the sides of all discs, 2 k the front of disc k and 2 k + 1 its back: asks
/// `light(face, number)` what leaves them, as light_surfels() does.
template <Space S, class Light>
struct SurfelLightPass {
    SurfelTreeView<S> tree;
    const std::uint32_t* leaves = nullptr;  ///< node of each disc
    Light light;
    float ray_offset = 0.0f;        ///< WorldGeometry::ray_offset(), metres
    SurfelRadiance* out = nullptr;  ///< of nodes

    MIR_HD void operator()(std::uint32_t side) const {
        const std::uint32_t index = leaves[side / 2];
        const bool front = side % 2 == 0;
        Rgb sent;
        if (!is_black(tree.albedo[index]))
            sent = light(surfel_face(tree, index, front, ray_offset), std::uint64_t{side});
        (front ? out[index].front : out[index].back) = sent;
    }
};
template <Space S, class Light>
SurfelLightPass(SurfelTreeView<S>, const std::uint32_t*, Light, float, SurfelRadiance*)
    -> SurfelLightPass<S, Light>;

/// Kernel over inner nodes whose children have their light: fills them as average_radiance() does.
template <Space S>
struct SurfelMeanPass {
    SurfelTreeView<S> tree;
    const std::uint32_t* inner = nullptr;  ///< nodes that are to be filled
    SurfelRadiance* radiance = nullptr;    ///< of nodes

    MIR_HD void operator()(std::uint32_t i) const {
        radiance[inner[i]] = mean_of_children(tree, inner[i], radiance);
    }
};
template <Space S>
SurfelMeanPass(SurfelTreeView<S>, const std::uint32_t*, SurfelRadiance*) -> SurfelMeanPass<S>;

/// Kernel over nodes: sum += light.
struct AddSurfelRadiance {
    const SurfelRadiance* light = nullptr;
    SurfelRadiance* sum = nullptr;

    MIR_HD void operator()(std::uint32_t i) const {
        sum[i].front += light[i].front;
        sum[i].back += light[i].back;
    }
};

}  // namespace mir
