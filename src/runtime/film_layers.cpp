// SPDX-License-Identifier: MIT
#include "runtime/film_layers.hpp"

#include "mir/runtime/add_up_layers.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace mir {
namespace {

/// Filters with negative lobes leave 0..1.
void take_coverage(const Image<Rgb>& layer, RenderResult& result, AnyExecutor& executor) {
    result.coverage = Image<float>::unwritten(layer.extent());
    executor.for_each(layer.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < layer.width(); ++x)
            result.coverage(x, y) = std::clamp(layer(x, y).r, 0.0f, 1.0f);
    });
}

}  // namespace

void take_layers(std::vector<Image<Rgb>> layers, bool removed_layer, RenderResult& result,
                 AnyExecutor& executor) {
    if (removed_layer) {
        result.removed = std::move(layers.back());
        layers.pop_back();
    }
    result.direct = std::move(layers[direct_layer]);
    result.emission = std::move(layers[emission_layer]);
    result.indirect = std::move(layers[indirect_layer]);
    take_coverage(layers[coverage_layer], result, executor);
    for (std::size_t l = first_bounce_layer; l < layers.size(); ++l)
        result.bounces.push_back(std::move(layers[l]));
    add_up_layers(result, executor);
}

}  // namespace mir
