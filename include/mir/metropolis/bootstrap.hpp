// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/path_luminance.hpp"
#include "mir/metropolis/bootstrap_options.hpp"
#include "mir/metropolis/bootstrap_paths.hpp"
#include "mir/metropolis/systematic_resampling.hpp"

#include <functional>

namespace mir {

/// Fills in weights and places of paths from `first` on: the `draw` of grow_bootstrap().
using PathDraw = std::function<void(std::uint64_t first, std::span<double> weights,
                                    std::span<std::uint32_t> places)>;

/// Does the work of a PathDraw, perhaps with others. It calls `draw` for some of the paths, and has
/// the rest from elsewhere.
using SharedDraw = std::function<void(std::uint64_t first, std::span<double> weights,
                                      std::span<std::uint32_t> places, const PathDraw& draw)>;

/// Independent paths that estimate P_c and seed the chains. That both come from one set is what
/// makes chains unbiased from their first state on, without burn-in (Veach 1997, section 11.3.1).
struct Bootstrap {
    PathLuminance luminance;      ///< P_c as the weights estimate it
    std::vector<double> weights;  ///< of path i, drawn from Random(seed, Stream::bootstrap, i)
    std::vector<std::uint32_t> places;  ///< place_of_vpl() of path i, 0 without light
};

namespace detail {

/// Paths to draw in all. What the error so far makes likely to suffice, but between a tenth more
/// and four times as many, because that error is an estimate too.
inline std::uint64_t next_bootstrap_size(const PathLuminance& p, const BootstrapOptions& options) {
    const double ratio = p.contributing > 0 ? p.relative_error() / options.relative_error : 2.0;
    const double growth = std::clamp(1.1 * ratio * ratio, 1.1, 4.0);
    const auto wanted =
        static_cast<std::uint64_t>(std::ceil(static_cast<double>(p.paths) * growth));
    return std::min(wanted, options.max_paths);
}

}  // namespace detail

/// Draws paths, more each time, until the relative error is reached. Some hundred paths must carry
/// light; max_paths is the limit. All weights are 0 only when none of a million paths (or of
/// max_paths) carries any. `draw(first, weights, places)` fills in paths from `first` on, on
/// whatever machine.
template <class Draw>
Bootstrap grow_bootstrap(const BootstrapOptions& options, const Draw& draw) {
    constexpr std::uint64_t enough_contributing = 256;
    constexpr std::uint64_t enough_dark = 1u << 20;
    Bootstrap b;
    std::uint64_t wanted = options.min_paths;
    do {
        const std::uint64_t first = b.weights.size();
        b.weights.resize(wanted);
        b.places.resize(wanted);
        draw(first, std::span(b.weights).subspan(first), std::span(b.places).subspan(first));
        b.luminance = path_luminance(b.weights);
        if (b.luminance.contributing >= enough_contributing &&
            b.luminance.relative_error() <= options.relative_error)
            break;
        if (b.luminance.contributing == 0 && b.weights.size() >= enough_dark) break;
        wanted = detail::next_bootstrap_size(b.luminance, options);
    } while (b.weights.size() < wanted);
    return b;
}

/// The `draw` of grow_bootstrap() on the executor's threads.
template <class Generator, Executor E>
void draw_paths(const Generator& generator, std::uint64_t seed, std::uint64_t first,
                std::span<double> weights, std::span<std::uint32_t> places, E& executor) {
    constexpr std::size_t batch = 256;
    const BootstrapPaths<Generator> paths{generator, seed, first, weights.data(), places.data()};
    executor.for_each((weights.size() + batch - 1) / batch, [&](std::size_t b) {
        WeightedPath path;
        for (std::size_t i = b * batch; i < std::min((b + 1) * batch, weights.size()); ++i)
            paths.draw(static_cast<std::uint32_t>(i), path);
    });
}

/// grow_bootstrap() on the executor's threads.
template <class Generator, Executor E>
Bootstrap bootstrap(const Generator& generator, const BootstrapOptions& options, std::uint64_t seed,
                    E& executor) {
    return grow_bootstrap(options, [&](std::uint64_t first, std::span<double> weights,
                                       std::span<std::uint32_t> places) {
        draw_paths(generator, seed, first, weights, places, executor);
    });
}

/// Paths of the bootstrap that start `count` chains, each drawn in proportion to its weight. They
/// are spread over the scene: neighbours are drawn about as often as they should be, not by chance.
/// `u` is uniform in [0, 1). Some weight must be positive.
inline std::vector<std::uint32_t> chain_starts(const Bootstrap& b, std::uint32_t count, double u) {
    std::vector<std::uint32_t> lit;
    for (std::uint32_t i = 0; i < b.weights.size(); ++i)
        if (b.weights[i] > 0.0) lit.push_back(i);
    std::sort(lit.begin(), lit.end(), [&](std::uint32_t i, std::uint32_t j) {
        return b.places[i] != b.places[j] ? b.places[i] < b.places[j] : i < j;
    });
    std::vector<double> weights;
    weights.reserve(lit.size());
    for (std::uint32_t i : lit) weights.push_back(b.weights[i]);
    std::vector<std::uint32_t> starts = systematic_resampling(weights, count, u);
    for (std::uint32_t& s : starts) s = lit[s];
    return starts;
}

}  // namespace mir
