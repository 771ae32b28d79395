// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_rays.hpp"
#include "mir/resident/backend_metropolis.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/uploaded_trees.hpp"

namespace mirtest {

/// What a backend needs of a scene that chains run through. nvcc compiles this, but no builder of
/// kd-trees.
template <mir::Bsdf F>
struct ChainParts {
    const mir::WorldGeometry& geometry;
    const mir::LightTable& lights;
    const mir::SurfaceTable<F>& surfaces;
    const mir::KdTree& tree;
    mir::CameraOptics camera;
    float aspect;
    float bound;
};

/// Copies the scene into the backend's memory and runs the chains there.
template <mir::Backend B, mir::Bsdf F>
mir::VplRecords chains_on(const B& backend, const ChainParts<F>& parts,
                          const mir::MetropolisOptions& options,
                          const mir::ChainPortions& portions = {}) {
    auto queue = backend.queue();
    const mir::UploadedGeometry<B> geometry(backend, queue, parts.geometry);
    const mir::UploadedLights<B> lights(backend, queue, parts.lights);
    const mir::UploadedSurfaces<B, F> surfaces(backend, queue, parts.surfaces);
    const mir::UploadedKdTree<B> tree(backend, queue, parts.tree);
    using Caster = mir::KdRayCaster<B::space>;
    using Sight = mir::KdTreeVisibility<B::space>;
    const mir::PathWorld<F, Caster, Sight, B::space> world(
        geometry.view(), lights.view(), surfaces.view(), Caster(geometry.view(), tree.view()),
        Sight{tree.view()}, parts.camera, parts.aspect, parts.bound);
    return mir::BackendMetropolis(backend, world, options, {}, portions).sample(queue);
}

}  // namespace mirtest
