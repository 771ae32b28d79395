// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh.hpp"
#include "mir/host/backend.hpp"
#include "mir/resident/wide_builder.hpp"

namespace mir {

namespace detail {

template <Executor E>
WideBvh build_wide_bvh(const WorldGeometry& geometry, const TriangleChoice<Space::host>& chosen,
                       E& executor, const WideBvhOptions& options) {
    const host::Backend backend(executor);
    auto queue = backend.queue();
    WideBuild<host::Backend<E>> build(backend, queue, geometry, geometry.view(), chosen, options);
    std::vector<WideNode> nodes(build.nodes());
    std::vector<TriangleRows> triangles(build.references());
    std::vector<std::uint32_t> indices(build.references());
    build.write(queue, {nodes.data(), triangles.data(), indices.data()});
    return {std::move(nodes), std::move(triangles), std::move(indices), build.reach()};
}

}  // namespace detail

/// Builds the hierarchy of BackendWideBvh on the executor's threads, equal in every byte. It covers
/// all triangles of a scene.
/// @throws Error(invalid_argument) on options out of range; Error(invalid_input) on coordinates
///         beyond 1e36 metres; Error(limit_exceeded) on 2^31 triangles and more, 2^30 where
///         they are to be split.
template <Executor E>
[[nodiscard]] WideBvh build_wide_bvh(const WorldGeometry& geometry, E& executor,
                                     const WideBvhOptions& options = {}) {
    return detail::build_wide_bvh(
        geometry, TriangleChoice<Space::host>::all(geometry, geometry.view()), executor, options);
}

/// The same of some triangles alone, with the reach of the whole scene.
template <Executor E>
[[nodiscard]] WideBvh build_wide_bvh(const WorldGeometry& geometry, const ChosenTriangles& chosen,
                                     E& executor, const WideBvhOptions& options = {}) {
    return detail::build_wide_bvh(geometry, chosen.view(), executor, options);
}

}  // namespace mir
