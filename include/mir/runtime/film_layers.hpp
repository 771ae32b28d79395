// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/film.hpp"
#include "mir/runtime/render_context.hpp"

namespace mir {

/// Layers of the film of a render; those of the bounces, if there are any, come last.
enum FilmLayer : std::size_t { direct_layer, emission_layer, indirect_layer, first_bounce_layer };

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

/// Turns the film of a render into its images.
template <Bsdf B, class Engine, Executor E>
void develop_layers(const Film& film, const RenderContext<B, Engine, E>& context,
                    RenderResult& result) {
    const auto stage = context.clock.measure(&StageSeconds::film);
    result.direct = film.develop(context.executor, direct_layer);
    result.emission = film.develop(context.executor, emission_layer);
    result.indirect = film.develop(context.executor, indirect_layer);
    for (std::size_t l = first_bounce_layer; l < film.layers(); ++l)
        result.bounces.push_back(film.develop(context.executor, l));
    add_up_layers(result, context.executor);
}

}  // namespace mir
