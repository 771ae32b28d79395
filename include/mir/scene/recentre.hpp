// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/scene/detail/recentring.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// Places the things of `scene` at `places`, near the origin of its coordinates. It moves a scene
/// that does not lie near its origin, and adds to Scene::origin what it subtracted. A scene is near
/// while each coordinate of its middle is at most eight times its longest side; what is near moves
/// by nothing, so that calling it twice changes nothing. Vertices that lie so far from the origin
/// of their own mesh move too, and their placements against them. Depends on the scene alone.
///
/// Returns sentences on meshes too fine for 32-bit numbers where they lie: those whose median edge
/// is shorter than 1000 steps of the floats there. Call it when the scene is finished, before
/// WorldGeometry and CameraRays are made. For one thread at a time.
/// @throws Error(invalid_argument) when `places` has not one element for each thing.
inline std::vector<std::string> recentre(Scene& scene, Placements places) {
    bool complete = places.instances.size() == scene.instances.size() &&
                    places.cameras.size() == scene.cameras.size();
    for_each_placed_list(scene, [&]<class Light>(const std::vector<Light>& list) {
        complete = complete && places.lights<Light>().size() == list.size();
    });
    expects(complete,
            "recentre: the scene has not as many things as places were given for; give one each");
    detail::Recentring recentring(scene, std::move(places));
    std::vector<std::string> remarks = recentring.remarks(scene);
    recentring.apply(scene);
    return remarks;
}

/// The same for a scene whose things stand where it says.
inline std::vector<std::string> recentre(Scene& scene) {
    return recentre(scene, placements_of(scene));
}

/// A scene near the origin of its coordinates. It is the given one, or else a copy of it after
/// recentre(). The given one must outlive it. Const use from any thread.
class NearScene {
 public:
    /// Reads all vertices once; copies only what lies far away.
    explicit NearScene(const Scene& scene) : given_(&scene) {
        if (!detail::Recentring(scene, placements_of(scene)).is_needed()) return;
        moved_ = scene;
        remarks_ = recentre(*moved_);
    }

    /// Valid until this object ends.
    [[nodiscard]] const Scene& scene() const { return moved_ ? *moved_ : *given_; }

    /// Sentences of recentre(); none when nothing moved.
    [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
    const Scene* given_;
    std::optional<Scene> moved_;
    std::vector<std::string> remarks_;
};

}  // namespace mir
