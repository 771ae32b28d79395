// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/accept_box.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/core/stopwatch.hpp"

#include <algorithm>

namespace mir::detail {

// What the builders of all trees share.

/// Sizes and areas of such scenes, and the margins around them, stay finite.
/// @throws Error(invalid_input) otherwise.
inline void check_coordinates(const WorldGeometry& geometry) {
    if (magnitude_of(geometry.bounds()) <= 1e36f) return;
    throw Error(ErrorCode::invalid_input,
                "the scene has a coordinate beyond 1e36 metres (sizes of boxes around it would "
                "not be finite numbers); scale the scene");
}

/// Runs a stage and adds the time it took.
template <class Stage>
void timed(double& seconds, const Stage& stage) {
    const Stopwatch watch(seconds);
    stage();
}

/// Calls body(first, last) for the parts of [0, n), at the same time.
template <Executor E, class Body>
void for_each_part(std::size_t n, std::size_t part, E& executor, const Body& body) {
    executor.for_each((n + part - 1) / part,
                      [&](std::size_t i) { body(i * part, std::min(n, (i + 1) * part)); });
}

}  // namespace mir::detail
