// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/film.hpp"
#include "mir/runtime/film_layer.hpp"
#include "mir/runtime/render_context.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

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

/// Makes the coverage of a result from its filtered layer. Filters with negative lobes leave 0..1.
template <Executor E>
void take_coverage(const Image<Rgb>& layer, RenderResult& result, E& executor) {
    result.coverage = Image<float>::unwritten(layer.extent());
    executor.for_each(layer.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < layer.width(); ++x)
            result.coverage(x, y) = std::clamp(layer(x, y).r, 0.0f, 1.0f);
    });
}

/// Moves the images of all layers of a film to their places in a result.
template <Executor E>
void take_layers(std::vector<Image<Rgb>> layers, bool removed_layer, RenderResult& result,
                 E& executor) {
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

/// Turns the film of a render into its images.
template <Bsdf B, class Engine, Executor E>
void develop_layers(const Film& film, const RenderContext<B, Engine, E>& context,
                    RenderResult& result) {
    const auto stage = context.clock.measure(&StageSeconds::film);
    std::vector<Image<Rgb>> layers;
    for (std::size_t l = 0; l < film.layers(); ++l)
        layers.push_back(film.develop(context.executor, l));
    take_layers(std::move(layers), context.settings.removed_layer, result, context.executor);
}

}  // namespace mir
