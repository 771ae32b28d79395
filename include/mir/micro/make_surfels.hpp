// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/construction.hpp"
#include "mir/core/limits.hpp"
#include "mir/micro/detail/triangle_pieces.hpp"

#include <vector>

namespace mir {

namespace detail {

/// Most discs of a scene, whatever its limits. Nodes of a tree over them are counted by 32 bits.
inline constexpr std::uint64_t most_surfels = std::uint64_t{1} << 31;

/// Index of the first piece of each triangle; the number of all comes last.
/// @throws Error(limit_exceeded) when there are more than Limits::surfels.
inline std::vector<std::uint64_t> piece_offsets(const WorldGeometry& geometry,
                                                const SurfelOptions& options,
                                                const Limits& limits) {
    const auto triangles = static_cast<std::uint32_t>(geometry.triangles().size());
    std::vector<std::uint64_t> offsets{0};
    offsets.reserve(std::size_t{triangles} + 1);
    for (std::uint32_t t = 0; t < triangles; ++t) {
        const std::uint64_t count = pieces_of(geometry, t, options).count;
        offsets.push_back(offsets.back() + count);
        check_limit(offsets.back(), std::min(limits.surfels, most_surfels), "surfels");
    }
    return offsets;
}

}  // namespace detail

/// Cuts every triangle of a scene in four, again and again, and makes discs. Cuts go along the
/// middles of edges until no piece is larger than options.max_area; a disc lies in the middle of
/// each piece. The pieces of a triangle are equal: their areas add up, exactly, to its area rounded
/// once to single precision (unless they are below 2^-126 m^2). Triangles come in the order of the
/// geometry, the pieces of one in the order in which cutting meets them: what touches its corners,
/// then the middle. The same for any number of threads. Sources: the disc approximation of Ritschel
/// et al., "Micro-rendering for scalable, parallel final gathering", ACM Transactions on Graphics
/// 28(5), 2009, with the cut of a course on it.
/// @throws Error(invalid_argument) on options out of range; Error(limit_exceeded) before memory is
///         taken; Error(invalid_input) on triangles too large for single precision.
template <Executor E>
std::vector<Surfel> make_surfels(const WorldGeometry& geometry, const SurfelOptions& options,
                                 const Limits& limits, E& executor) {
    check(options);
    const std::vector<std::uint64_t> offsets = detail::piece_offsets(geometry, options, limits);
    std::vector<Surfel> surfels(offsets.back());
    constexpr std::size_t part = 4096;
    detail::for_each_part(surfels.size(), part, executor, [&](std::size_t first, std::size_t last) {
        const auto next = std::upper_bound(offsets.begin(), offsets.end(), first);
        auto t = static_cast<std::uint32_t>(next - offsets.begin() - 1);
        for (std::size_t i = first; i < last; ++t) {
            const detail::TrianglePieces pieces = detail::pieces_of(geometry, t, options);
            for (; i < std::min<std::size_t>(last, offsets[t + 1]); ++i)
                surfels[i] = pieces.disc(i - offsets[t], t, geometry.material_of(t));
        }
    });
    return surfels;
}

/// Area of all triangles, m^2, summed in double precision in their order.
inline double surface_area(const WorldGeometry& geometry) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t)
        sum += static_cast<double>(detail::pieces_of(geometry, t, {}).whole_area());
    return sum;
}

}  // namespace mir
