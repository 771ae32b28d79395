// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/passes.hpp"
#include "conformance/worlds.hpp"
#include "mir/validation/visibility.hpp"

// The axioms of Visibility. `Engine` is made from a WorldGeometry and hands out a model with
// visibility().

namespace mirtest {

template <class Engine>
void visibility_suite() {
    namespace validation = mir::validation;
    static_assert(mir::Visibility<decltype(std::declval<const Engine&>().visibility())>);
    const auto [scale, x] = GENERATE(table<float, float>(
        {{1.0f, 0.0f}, {0.01f, 0.5f}, {1e-3f, 0.0f}, {1e4f, 0.0f}, {1.0f, 100.0f}}));
    INFO("scale " << scale << ", moved by " << x);
    const World world = triangle_soup(150, 1, scale, {x, 0.3f * x, -x});
    const Engine engine(world.geometry);
    const auto visibility = engine.visibility();
    SECTION("agrees with brute force") {
        passes(validation::check_visibility_by_brute_force(visibility, world.geometry));
    }
    SECTION("is symmetric") {
        passes(validation::check_visibility_symmetry(visibility, world.geometry));
    }
    SECTION("lifted points are not hidden by their own surface") {
        passes(validation::check_lifted_points(visibility, world.geometry));
    }
    SECTION("may be asked concurrently") {
        passes(validation::check_concurrent_visibility(visibility, world.geometry));
    }
}

}  // namespace mirtest
