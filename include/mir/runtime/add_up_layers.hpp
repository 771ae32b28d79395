// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/runtime/result.hpp"

#include <cstddef>
#include <cstdint>

namespace mir {

/// Makes the beauty of a result: emission + direct + indirect.
template <Executor E>
void add_up_layers(RenderResult& result, E& executor) {
    result.beauty = Image<Rgb>::unwritten(result.emission.extent());
    executor.for_each(result.beauty.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < result.beauty.width(); ++x)
            result.beauty(x, y) =
                result.emission(x, y) + (result.direct(x, y) + result.indirect(x, y));
    });
}

}  // namespace mir
