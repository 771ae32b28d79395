// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// VPLs first .. first + count - 1 of a set: what the kernels of shafts take at a time, so that
/// their queues have room for all pairs.
struct VplBatch {
    std::uint32_t first = 0;  ///< its place in the set
    std::uint32_t count = 0;  ///< at least 1
};

}  // namespace mir
