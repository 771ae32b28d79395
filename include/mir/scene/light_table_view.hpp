// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/discrete_distribution.hpp"
#include "mir/scene/light_kinds.hpp"
#include "mir/scene/lights/environment_source.hpp"
#include "mir/scene/lights/lamp.hpp"
#include "mir/scene/lights/light_tree_view.hpp"

namespace mir {

/// What kernels read of a LightTable. Lights are counted as there: first emissive triangles, then
/// what the scene lists, then the environment if it shines. A view; thread-safe.
template <Space S>
struct LightTableView {
    static constexpr Space space = S;  ///< where the arrays lie

    LampView<S> lamps;                     ///< emissive triangles
    const ListedSource* listed = nullptr;  ///< in the order of ListedLights
    std::uint32_t listed_count = 0;        ///< of `listed`
    DiscreteDistributionView<S> by_power;  ///< of all lights
    BoundingSphere sphere;                 ///< of the scene
    EnvironmentView<S> environment;        ///< light from all around; empty: none
    LightTreeView<S> tree;                 ///< emissive triangles, and what is listed if...
    bool is_listed_in_tree = false;        ///< ...it is: all TreeLight of `listed`

    /// True when nothing emits power: sample_light() has no answer.
    [[nodiscard]] MIR_HD bool empty() const { return by_power.empty(); }
    /// Luminance of the power emitted by everything, W.
    [[nodiscard]] MIR_HD double power() const { return by_power.total; }

    /// Any light by power, as an index. The table must not be empty.
    [[nodiscard]] MIR_HD std::uint32_t sample_light(float u) const { return by_power.sample(u); }
    /// Probability with which sample_light() picks `light`; sums to 1.
    [[nodiscard]] MIR_HD float light_probability(std::uint32_t light) const {
        return by_power.probability(light);
    }

    /// f(source) of a light as the LightSource that it is. The same type for all kinds. `geometry`
    /// is that of the scene. All that is done with any light goes through here.
    template <class F>
    [[nodiscard]] MIR_HD auto visit(const GeometryView<S>& geometry, std::uint32_t light,
                                    const F& f) const {
        if (light < lamps.count) return f(LampSource<S>{lamps, geometry, light});
        if (light < lamps.count + listed_count) return listed[light - lamps.count].visit(f);
        return f(EnvironmentSource<S>{{sphere}, environment});
    }
};

}  // namespace mir
