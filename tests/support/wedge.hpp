// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/scene.hpp"
#include "mir/scene/shapes.hpp"
#include "support/test_sky.hpp"

namespace mirtest {

/// What lights a wedge.
enum class WedgeLights { ceiling, two_sided, point, spot, directional, environment };

/// A floor and a slanted ceiling that do not touch, with a slanted board between them: light always
/// travels at least 0.2 m, so every way to sample a path has a bounded weight and means of weights
/// are nearly normal. Nothing is parallel, so every cosine has its own value; the floor's shading
/// normals are bent by up to 20 degrees.
class Wedge {
 public:
    explicit Wedge(WedgeLights lights, float specular = 0.0f)
        : floor_(material("floor", {0.9f, 0.8f, 0.7f}, specular)),
          ceiling_(material("ceiling", {0.7f, 0.8f, 0.9f}, specular)),
          board_(material("board", {0.6f, 0.6f, 0.6f}, 0.0f)) {
        place_surfaces();
        add(lights);
        scene_.cameras.push_back(
            mir::Camera::look_at({0.4f, 0.4f, 1}, {0, 0.25f, 0}, {0, 1, 0}, 1.0f));
    }
    [[nodiscard]] mir::Scene scene() const { return scene_; }

 private:
    std::uint32_t material(const char* name, mir::Rgb colour, float specular) {
        mir::Material m = mir::lambertian(name, colour);
        m.specular = specular;
        m.roughness = 0.6f;
        return scene_.add(m);
    }
    void place_surfaces() {
        namespace b = mir::builtin;
        mir::Mesh floor = b::quad("floor", floor_, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
        for (mir::Vec3 p : floor.positions)
            floor.normals.push_back(glm::normalize(mir::Vec3(0.25f * p.z, 1, -0.25f * p.x)));
        scene_.place(floor);
        scene_.place(b::quad("ceiling", ceiling_, {-1, 0.4f, -1}, {2, 0.8f, 0}, {0, 0.1f, 2}));
        scene_.place(
            b::quad("board", board_, {-0.1f, 0.25f, 0.2f}, {0.5f, 0.15f, 0}, {0, 0, -0.5f}));
    }
    void add(WedgeLights lights) {
        const mir::Rgb light{3, 2, 1};
        if (lights == WedgeLights::ceiling) scene_.materials[ceiling_].emission = light;
        if (lights == WedgeLights::two_sided) {
            scene_.materials[board_].emission = light;
            scene_.materials[board_].emits_from_both_sides = true;
        }
        if (lights == WedgeLights::point)
            scene_.point_lights.push_back({"point", {0.3f, 0.65f, 0.4f}, light});
        if (lights == WedgeLights::spot)
            scene_.spot_lights.push_back(
                {"spot", {0.5f, 0.7f, 0.4f}, glm::normalize(mir::Vec3(-0.5f, -1, 0)), light});
        if (lights == WedgeLights::directional)
            scene_.directional_lights.push_back(
                {"sun", glm::normalize(mir::Vec3(-1, -0.7f, 0.1f)), light});
        if (lights == WedgeLights::environment) scene_.environment = test_sky();
    }

    mir::Scene scene_;
    std::uint32_t floor_ = 0;
    std::uint32_t ceiling_ = 0;
    std::uint32_t board_ = 0;
};

}  // namespace mirtest
