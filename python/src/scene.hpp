// SPDX-License-Identifier: MIT
#pragma once

#include "load_scene.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/scene/world_geometry.hpp"

#include <nanobind/nanobind.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace mirpy {

/// What rays of the parts go through: triangles in world space and a kd-tree over them.
struct Tracing {
    /// Builds the tree; the scene is not needed any more.
    explicit Tracing(const mir::Scene& scene) : geometry(scene), tree(geometry) {}

    mir::WorldGeometry geometry;
    mir::KdTreeScene tree;
    /// Copies of the tree by number of their GPU, made and read with the GIL held.
    mutable std::map<int, std::shared_ptr<const void>> on_gpus;
};

/// A scene as Python holds it. All but what a Hold gives is for whoever holds the GIL.
class PyScene {
 public:
    using Loaded = mirtool::SceneAndReport;

    PyScene() : loaded_(std::make_shared<Loaded>()) {}
    explicit PyScene(Loaded loaded)
        : loaded_(std::make_shared<Loaded>(std::move(loaded))), is_edited_(false) {}

    /// Keeps a scene from being edited. To be made and to end with the GIL held.
    class Hold {
     public:
        explicit Hold(PyScene& scene) : loaded_(scene.counted()), holders_(scene.holders_) {
            ++*holders_;
        }
        Hold(const Hold&) = delete;
        Hold& operator=(const Hold&) = delete;
        ~Hold() { --*holders_; }

        [[nodiscard]] const std::shared_ptr<Loaded>& loaded() const { return loaded_; }

     private:
        std::shared_ptr<Loaded> loaded_;
        std::shared_ptr<int> holders_;
    };

    /// To change it.
    /// @throws mir::Error(invalid_argument) while it is held.
    [[nodiscard]] mir::Scene& edit();
    /// To read it.
    [[nodiscard]] const mir::Scene& scene() const { return loaded_->scene; }
    /// What it holds, up to date.
    [[nodiscard]] const mir::SceneReport& report() { return counted()->report; }
    /// Adds a camera and says so in the report; returns its index.
    std::uint32_t add_camera(const mir::Camera& camera);
    /// What its rays go through, built when it is first asked for. Releases the GIL meanwhile.
    [[nodiscard]] std::shared_ptr<const Tracing> tracing();

 private:
    [[nodiscard]] const std::shared_ptr<Loaded>& counted();

    std::shared_ptr<Loaded> loaded_;
    std::shared_ptr<int> holders_ = std::make_shared<int>(0);
    std::shared_ptr<const Tracing> tracing_;
    bool is_edited_ = true;
};

/// Declares the class Scene, load() and what is added to scenes.
void bind_scene(nanobind::module_& m);
/// Declares what adds materials and images.
void bind_materials(nanobind::class_<PyScene>& scene);
/// Declares what adds meshes and instances.
void bind_meshes(nanobind::class_<PyScene>& scene);
/// Declares what adds lights and cameras.
void bind_lights(nanobind::class_<PyScene>& scene);

}  // namespace mirpy
