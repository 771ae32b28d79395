// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/surface_table.hpp"

#include <utility>

namespace mirtest {

/// A scene with all that light is traced by, the rays by a kd-tree.
struct KdLab {
    explicit KdLab(mir::Scene of)
        : scene(std::move(of)),
          geometry(scene),
          lights(scene, geometry),
          surfaces(scene),
          tree(geometry) {}
    KdLab(const KdLab&) = delete;
    KdLab& operator=(const KdLab&) = delete;
    ~KdLab() = default;

    mir::Scene scene;
    mir::WorldGeometry geometry;
    mir::LightTable lights;
    mir::SurfaceTable<mir::CookTorrance> surfaces;
    mir::KdTreeScene tree;
};

}  // namespace mirtest
