// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/micro/gather_options.hpp"

#include <cmath>

namespace mir {

/// Checks the options of a micro-buffer.
/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const BufferGatherOptions& options) {
    expects(options.side >= 1 && options.side <= BufferGatherOptions::largest_side,
            "the side of a micro-buffer must be 1 to 24 texels; 16 are usual");
    expects(options.threshold >= 0.0f && std::isfinite(options.threshold),
            "the threshold of a micro-buffer must be a finite number, not below 0; 0 is exact, 1 "
            "usual");
    expects(options.warp == BufferWarp::hemisphere || options.warp == BufferWarp::importance,
            "the warp of a micro-buffer must be hemisphere or importance");
}

/// Checks the options of a gather by rays.
/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const GatherOptions& options) {
    expects(options.rays >= 1 && options.rays <= 65536,
            "the rays of a gather must be 1 to 65536; 128 are usual");
    expects(options.threshold >= 0.0f && std::isfinite(options.threshold),
            "the threshold of a gather must be a finite number, not below 0 (it is the solid angle "
            "at which rays stop, in units of their own); 0 is exact, 1 usual");
}

}  // namespace mir
