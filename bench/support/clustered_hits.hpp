// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/tbb_executor.hpp"
#include "support/shafts/cluster_order.hpp"

#include <vector>

namespace mirbench {

/// Planes of `count` hits in cluster order: those of a tile, and empty ones behind them.
inline std::vector<std::uint32_t> clustered_hits(const mir::SoaView<const mir::Hit>& hits,
                                                 std::uint32_t count, mir::TbbExecutor& executor) {
    std::vector<std::uint32_t> unordered(std::size_t{count} * mir::SoaView<mir::Hit>::words);
    std::vector<std::uint32_t> planes(unordered.size());
    const mir::SoaView<mir::Hit> given{unordered.data(), count};
    for (std::uint32_t i = 0; i < hits.stride; ++i) given.store(i, hits.load(i));
    const auto order = mir::cluster_order({unordered.data(), count}, {}, executor);
    const mir::SoaView<mir::Hit> ordered{planes.data(), count};
    for (std::uint32_t i = 0; i < count; ++i) ordered.store(i, given.load(order[i]));
    return planes;
}

}  // namespace mirbench
