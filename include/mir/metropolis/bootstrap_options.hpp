// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// How exactly P_c is to be known, and at what cost.
struct BootstrapOptions {
    double relative_error = 0.03;        ///< standard error of P_c asked for, over P_c
    std::uint64_t min_paths = 1u << 14;  ///< always drawn, > 0
    std::uint64_t max_paths = 1u << 22;  ///< never passed
};

}  // namespace mir
