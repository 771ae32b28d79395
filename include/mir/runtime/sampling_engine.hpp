// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/scene/camera.hpp"

#include <concepts>
#include <limits>

namespace mir {

/// How the image of a render looks at the scene.
struct PathView {
    CameraOptics camera;                              ///< makes the rays of the film
    float aspect = 1.0f;                              ///< width / height of the film
    float bound = std::numeric_limits<float>::max();  ///< see PathWorld::bound
};

/// An engine that runs MetropolisSampler where it keeps the scene, as GPUs do:
/// sample_metropolis(lights, view, options, limits, monitor) returns the sampler's records, for
/// lights of the scene that the engine was made for. Other engines leave that to the executor.
/// Const and for one thread at a time.
template <class N>
concept SamplingEngine = requires(const N n, const LightTable& lights, const PathView& view,
                                  const MetropolisOptions& options, const Limits& limits,
                                  Monitor* monitor) {
    { n.sample_metropolis(lights, view, options, limits, monitor) } -> std::same_as<VplRecords>;
};

/// MetropolisSampler as an engine runs it. Model of Sampler. What is referred to must outlive it.
template <SamplingEngine N>
struct EngineMetropolis {
    /// As of MetropolisSampler: records hold radiance.
    static constexpr Normalisation normalisation = Normalisation::image_response;

    const N& engine;             ///< runs the chains
    const LightTable& lights;    ///< of the scene that the engine was made for
    PathView view;               ///< of the image that VPLs are to light
    MetropolisOptions options;   ///< of the chains
    Limits limits;               ///< checked before memory is taken
    Monitor* monitor = nullptr;  ///< may be null

    /// The engine has threads of its own; those of the executor are left alone.
    template <Executor E>
    [[nodiscard]] VplRecords sample(E& /*executor*/) const {
        return engine.sample_metropolis(lights, view, options, limits, monitor);
    }
};

}  // namespace mir
