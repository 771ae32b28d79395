// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/limit_values.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace mir {

/// Product that saturates instead of wrapping.
constexpr std::uint64_t saturating_mul(std::uint64_t a, std::uint64_t b) {
    if (a != 0 && b > std::numeric_limits<std::uint64_t>::max() / a)
        return std::numeric_limits<std::uint64_t>::max();
    return a * b;
}

/// Stops before an allocation that the caller's limits forbid.
/// @throws Error(limit_exceeded) naming `what`, both numbers and the field of Limits to raise.
inline void check_limit(std::uint64_t wanted, std::uint64_t limit, const char* what,
                        Where at = Where::here()) {
    if (wanted <= limit) return;
    throw Error(ErrorCode::limit_exceeded,
                std::to_string(wanted) + " " + what + " were asked for, but Limits::" + what +
                    " allows " + std::to_string(limit) +
                    " (memory is bounded before it is taken); ask for less or raise the limit",
                at);
}

}  // namespace mir
