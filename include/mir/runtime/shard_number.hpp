// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/runtime/settings.hpp"

#include <cstdint>
#include <string>

namespace mir {

/// Most parts that a picture can be made in.
inline constexpr std::uint32_t max_shards = 65536;

/// Which part of a picture one of several jobs makes.
struct ShardNumber {
    std::uint32_t number = 1;  ///< 1..count, from top to bottom
    std::uint32_t count = 1;   ///< parts of the picture
};

/// "2 of 5".
inline std::string to_string(ShardNumber shard) {
    return std::to_string(shard.number) + " of " + std::to_string(shard.count);
}

/// Rows of pixels of a shard of an image that has `height` rows. Shards together have each row
/// once; their heights differ by one row at most.
/// @throws Error(invalid_argument) for a number beyond the count, or more shards than rows.
inline PixelRows rows_of(ShardNumber shard, std::uint32_t height) {
    expects(shard.count >= 1 && shard.count <= max_shards && shard.number >= 1 &&
                shard.number <= shard.count,
            "shards count from 1 to their number, 65536 at most (no other has a part of the "
            "picture); give 1/8, 2/8 and so on");
    expects(shard.count <= height,
            "a picture was split into more shards than it has rows of pixels (some would have "
            "none); split it into fewer");
    const auto first = [&](std::uint64_t k) {
        return static_cast<std::uint32_t>(k * height / shard.count);
    };
    return {first(shard.number - 1), first(shard.number) - first(shard.number - 1)};
}

}  // namespace mir
