// SPDX-License-Identifier: MIT
#pragma once

// Pictures by frames of the host and by frames in a backend's memory, which is the host's here.

#include "conformance/stage.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/host/backend.hpp"
#include "runtime/backend_frame/caustics.hpp"
#include "runtime/backend_frame/chains.hpp"
#include "runtime/backend_frame/chains_through.hpp"
#include "runtime/backend_frame/cuts.hpp"
#include "runtime/backend_frame/direct.hpp"
#include "runtime/backend_frame/film.hpp"
#include "runtime/backend_frame/light.hpp"
#include "runtime/backend_frame/light_paths.hpp"
#include "runtime/backend_frame/luxels.hpp"
#include "runtime/backend_frame/residual.hpp"
#include "runtime/backend_frame/response.hpp"
#include "runtime/backend_frame/scene.hpp"
#include "runtime/backend_frame/visibility.hpp"
#include "runtime/host_frame.hpp"
#include "runtime/render_vpls.hpp"
#include "runtime/split_frame.hpp"
#include "support/catch.hpp"

#include <memory>
#include <vector>

namespace mirtest {

/// Frames in the memory of a backend that is the host.
using HostBackend = mir::host::Backend<mir::InlineExecutor>;
using FrameThere = mir::BackendFrame<HostBackend, mir::CookTorrance>;

/// By the host alone.
inline mir::RenderResult draw_on_host(const mir::Scene& scene,
                                      const mir::RenderSettings& settings) {
    const mir::WorldGeometry geometry(scene);
    mir::InlineExecutor executor;
    mir::StageClock clock;
    mir::RenderJob job({scene, geometry, mir::AnyExecutor(executor), nullptr, clock}, settings);
    const mir::TracedScene traced(std::make_unique<const mir::KdTreeScene>(geometry));
    return mir::render_vpls(*mir::host_frame(job, traced, mir::HostScheduler::cpu));
}

/// By one frame in a backend's memory, which makes a tree for the host where it must and only
/// there.
inline mir::RenderResult draw_on_backend(const mir::Scene& scene,
                                         const mir::RenderSettings& settings,
                                         const mir::BackendFrameOptions& options) {
    const mir::WorldGeometry geometry(scene);
    mir::InlineExecutor executor;
    mir::StageClock clock;
    mir::RenderJob job({scene, geometry, mir::AnyExecutor(executor), nullptr, clock}, settings);
    int trees = 0;
    const auto make_tree = [&] {
        ++trees;
        return std::make_shared<const mir::KdTree>(geometry, mir::KdTreeOptions{}, executor);
    };
    FrameThere frame(job, HostBackend(executor), make_tree, options);
    mir::RenderResult result = mir::render_vpls(frame);
    // Chains, light paths and all that follows need no rays of the host. Samplers do that look at
    // the image before.
    const bool on_host = options.scheduler == mir::BackendScheduler::os ||
                         settings.sampler == mir::SamplerKind::bidirectional ||
                         settings.vpl_roulette;
    CHECK(trees == (options.kd_tree || on_host ? 1 : 0));
    return result;
}

/// By frames in the memory of as many backends as there are options, and by one of the host
/// besides if wanted.
inline mir::RenderResult draw_split(const mir::Scene& scene, const mir::RenderSettings& settings,
                                    const std::vector<mir::BackendFrameOptions>& options,
                                    bool with_host) {
    const mir::WorldGeometry geometry(scene);
    mir::InlineExecutor executor;
    mir::StageClock clock;
    mir::RenderJob job({scene, geometry, mir::AnyExecutor(executor), nullptr, clock}, settings);
    const mir::TracedScene traced(std::make_unique<const mir::KdTreeScene>(geometry));
    std::vector<std::unique_ptr<mir::RenderFrame>> parts;
    for (const mir::BackendFrameOptions& of : options)
        parts.push_back(std::make_unique<FrameThere>(
            job, HostBackend(executor),
            [&] {
                return std::make_shared<const mir::KdTree>(geometry, mir::KdTreeOptions{},
                                                           executor);
            },
            of));
    if (with_host) parts.push_back(mir::host_frame(job, traced, mir::HostScheduler::cpu_blocks));
    mir::SplitFrame frame(job, std::move(parts));
    return mir::render_vpls(frame);
}

/// A room with lamps of every kind.
inline mir::Scene lit_room() {
    mir::Scene scene = glossy_box();
    scene.point_lights.push_back({"point", {0.1f, 0.6f, 0.2f}, {0.3f, 0.2f, 0.1f}});
    mir::SpotLight spot;
    spot.position = {-0.3f, 0.7f, 0.1f};
    spot.direction = {0.0f, -1.0f, 0.0f};
    spot.intensity = {1.0f, 2.0f, 3.0f};
    scene.spot_lights.push_back(spot);
    scene.directional_lights.push_back({"sun", {0.0f, 0.0f, -1.0f}, {0.5f, 0.5f, 0.5f}});
    return scene;
}

/// Settings of a picture of a moment.
inline mir::RenderSettings small_picture() {
    mir::RenderSettings s;
    s.image = {45, 35};
    s.luxels_per_pixel = 1;
    s.vpls = 24;
    s.tile = {32, 16};
    s.metropolis.bootstrap.min_paths = s.metropolis.bootstrap.max_paths = 4096;
    return s;
}

}  // namespace mirtest
