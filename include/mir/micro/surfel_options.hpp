// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cmath>

namespace mir {

/// How far a disc reaches. Light is never counted by it: that is what Surfel::area is for.
enum class DiscExtent {
    /// To the farthest corner of its piece, but not over its edges. Together the discs of a
    /// triangle are the triangle.
    piece,
    /// To the farthest corner of its piece. Discs leave no gap, and stick out of the borders of
    /// their surface by at most a diameter of a piece, which becomes smaller with the pieces.
    cover,
    /// As large in area as its piece. A share of all rays passes between such discs, however small
    /// they are: a tenth to a fifth of those that meet a wall head-on.
    equal_area
};

/// How a scene is cut into discs.
struct SurfelOptions {
    float max_area = 0.01f;                 ///< m^2; no piece is larger, none is cut that is not
    DiscExtent extent = DiscExtent::piece;  ///< how far a disc reaches
};

/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const SurfelOptions& options) {
    expects(options.max_area > 0.0f && std::isfinite(options.max_area),
            "the largest area of a surfel must be positive and finite (square metres), or there "
            "would be no end of cutting; give one that suits the scene");
}

}  // namespace mir
