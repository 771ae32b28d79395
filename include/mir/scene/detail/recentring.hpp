// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/detail/coarse_meshes.hpp"
#include "mir/scene/detail/far_box.hpp"
#include "mir/scene/placements.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mir::detail {

/// What recentre() does to one scene, whose meshes must not change meanwhile. What does not exist
/// or is not finite is left for WorldGeometry to refuse.
class Recentring {
 public:
    Recentring(const Scene& scene, Placements places)
        : places_(std::move(places)), shifts_(scene.meshes.size(), DVec3(0.0)) {
        for (const Mesh& mesh : scene.meshes) boxes_.push_back(box_of(mesh.positions));
        for_each_placed(scene, [&](std::size_t mesh, const DMat4& to_world) {
            world_.add(boxes_[mesh], to_world);
        });
        shift_ = shift_of(world_);
        find_far_vertices(scene);
    }

    /// True when the scene, or vertices of a mesh, do not lie near their origin.
    [[nodiscard]] bool is_needed() const {
        return shift_ != DVec3(0.0) || std::any_of(shifts_.begin(), shifts_.end(),
                                                   [](DVec3 shift) { return shift != DVec3(0.0); });
    }

    /// Sentences on meshes that are too fine for the floats that hold them. In their own
    /// coordinates, and in those of the world that apply() leads to.
    [[nodiscard]] std::vector<std::string> remarks(const Scene& scene) const {
        std::vector<double> edges;
        for (const Mesh& mesh : scene.meshes) edges.push_back(median_edge(mesh));
        std::vector<double> units(edges.size(), 0.0);
        CoarseMeshes own;
        CoarseMeshes placed;
        for_each_placed(scene, [&](std::size_t mesh, const DMat4& to_world) {
            const double scale = scale_of(to_world);
            const std::string& name = scene.meshes[mesh].name;
            if (scale > 0.0 && units[mesh] == 0.0) {
                units[mesh] = 1.0 / scale;
                own.look_at(name, boxes_[mesh].reach(), edges[mesh], units[mesh]);
            }
            FarBox box;
            box.add(boxes_[mesh], to_world);
            placed.look_at(name,
                           std::fmax(largest_coordinate(box.low - shift_),
                                     largest_coordinate(box.high - shift_)),
                           scale * edges[mesh], 1.0);
        });
        std::vector<std::string> all;
        own.append_to(all, "vertices of meshes lie far from the origin of the mesh",
                      "what was rounded away is lost; give the vertices coordinates near 0 and "
                      "put the distance into the node that places them");
        placed.append_to(all, "meshes lie far from the middle of the scene",
                         "leave out what makes the scene so large, or split it");
        return all;
    }

    /// Brings everything to the new origin and rounds it.
    void apply(Scene& scene) {
        move_vertices(scene);
        scene.origin += shift_;
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            places_.instances[i][3] -= glm::dvec4(shift_, 0.0);
            scene.instances[i].to_world = Mat4(places_.instances[i]);
        }
        const auto settle = [this](auto& things, const std::vector<DVec3>& places) {
            for (std::size_t i = 0; i < things.size(); ++i)
                things[i].position = Vec3(places[i] - shift_);
        };
        for_each_placed_list(scene, [&]<class Light>(std::vector<Light>& list) {
            settle(list, places_.lights<Light>());
        });
        settle(scene.cameras, places_.cameras);
    }

 private:
    /// Length of the longest edge that a unit cube gets.
    static double scale_of(const DMat4& m) {
        return std::fmax(glm::length(DVec3(m[0])),
                         std::fmax(glm::length(DVec3(m[1])), glm::length(DVec3(m[2]))));
    }

    template <class Visit>
    void for_each_placed(const Scene& scene, const Visit& visit) const {
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            const std::size_t mesh = scene.instances[i].mesh;
            if (mesh < boxes_.size() && boxes_[mesh].is_usable()) visit(mesh, places_.instances[i]);
        }
    }

    /// Moves vertices that lie far from the origin of their mesh. They would be rounded there once
    /// more on their way to the world: their distance is to become part of the placement.
    void find_far_vertices(const Scene& scene) {
        if (!world_.is_usable()) return;
        const double far = near_sizes * world_.size();
        for_each_placed(scene, [&](std::size_t mesh, const DMat4& to_world) {
            if (largest_coordinate(glm::dmat3(to_world) * boxes_[mesh].centre()) > far)
                shifts_[mesh] = shift_of(boxes_[mesh]);
        });
    }

    void move_vertices(Scene& scene) {
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            const std::size_t mesh = scene.instances[i].mesh;
            if (mesh >= shifts_.size() || shifts_[mesh] == DVec3(0.0)) continue;
            DMat4& to_world = places_.instances[i];
            to_world[3] += glm::dvec4(glm::dmat3(to_world) * shifts_[mesh], 0.0);
        }
        for (std::size_t mesh = 0; mesh < shifts_.size(); ++mesh)
            if (shifts_[mesh] != DVec3(0.0))
                for (Vec3& p : scene.meshes[mesh].positions) p = Vec3(DVec3(p) - shifts_[mesh]);
    }

    Placements places_;
    std::vector<FarBox> boxes_;  ///< of the meshes, in their own coordinates
    std::vector<DVec3> shifts_;  ///< to subtract from the vertices of the meshes
    FarBox world_;
    DVec3 shift_{0.0};  ///< to subtract from the placements
};

}  // namespace mir::detail
