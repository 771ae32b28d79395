// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/film.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/stopwatch.hpp"

namespace mir {

/// Layers of the film of a render; those of the bounces, if there are any, come last.
enum FilmLayer : std::size_t { direct_layer, emission_layer, indirect_layer, first_bounce_layer };

/// Turns the film of a render into its images; the beauty is the sum of its layers.
inline void develop_layers(const Film& film, RenderResult& result) {
    const Stopwatch watch(result.statistics.seconds.film);
    result.direct = film.develop(direct_layer);
    result.emission = film.develop(emission_layer);
    result.indirect = film.develop(indirect_layer);
    for (std::size_t l = first_bounce_layer; l < film.layers(); ++l)
        result.bounces.push_back(film.develop(l));
    result.beauty = result.emission;
    for (std::size_t i = 0; i < result.beauty.pixels().size(); ++i)
        result.beauty.pixels()[i] += result.direct.pixels()[i] + result.indirect.pixels()[i];
}

}  // namespace mir
