// SPDX-License-Identifier: MIT
#include "mir/scene/scene_hash.hpp"

#include "mir/scenes.hpp"
#include "support/catch.hpp"
#include "support/test_sky.hpp"

#include <functional>
#include <set>

namespace {

using mir::Scene;

std::string hash(const Scene& s) { return mir::SceneHash(s).hex(); }

/// A scene in which every kind of thing occurs.
Scene full() {
    Scene s = mir::builtin::make("cornell-box");
    s.place(mir::builtin::sphere("ball", 0, {0, 1, 0}, 0.2f, 6, 4));
    s.point_lights.emplace_back();
    s.spot_lights.emplace_back();
    s.directional_lights.emplace_back();
    return s;
}

using Change = std::function<void(Scene&)>;

}  // namespace

TEST_CASE("a hash is sixteen hexadecimal digits and depends on nothing but the scene") {
    const std::string h = hash(full());
    CHECK(h.size() == 16);
    CHECK(h.find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(h == hash(full()));
}

TEST_CASE("a hash does not depend on names") {
    Scene s = full();
    s.name = "other";
    s.meshes[0].name = s.materials[0].name = s.cameras[0].name = "other";
    s.point_lights[0].name = s.spot_lights[0].name = s.directional_lights[0].name = "other";
    CHECK(hash(s) == hash(full()));
}

TEST_CASE("a hash does not depend on where in the world the scene lies") {
    Scene s = full();
    s.origin = {1e5, 0, -1e7};
    CHECK(hash(s) == hash(full()));
}

TEST_CASE("a hash changes with everything that changes the picture") {
    const std::vector<std::pair<const char*, Change>> changes{
        {"position", [](Scene& s) { s.meshes[0].positions[0].x += 1e-6f; }},
        {"triangle",
         [](Scene& s) { std::swap(s.meshes[0].triangles[0][0], s.meshes[0].triangles[0][1]); }},
        {"normal", [](Scene& s) { s.meshes.back().normals[0].y -= 0.1f; }},
        {"no normals", [](Scene& s) { s.meshes.back().normals.clear(); }},
        {"material index", [](Scene& s) { s.meshes[0].material = 1; }},
        {"instance transform", [](Scene& s) { s.instances[0].to_world[3][0] += 1.0f; }},
        {"instance mesh", [](Scene& s) { s.instances[0].mesh = 1; }},
        {"instance removed", [](Scene& s) { s.instances.pop_back(); }},
        {"base colour", [](Scene& s) { s.materials[0].base_color.g = 0.1f; }},
        {"metallic", [](Scene& s) { s.materials[0].metallic = 0.5f; }},
        {"roughness", [](Scene& s) { s.materials[0].roughness = 0.5f; }},
        {"specular", [](Scene& s) { s.materials[0].specular = 0.5f; }},
        {"ior", [](Scene& s) { s.materials[0].ior = 1.6f; }},
        {"emission", [](Scene& s) { s.materials[3].emission.b += 1.0f; }},
        {"both sides", [](Scene& s) { s.materials[3].emits_from_both_sides = true; }},
        {"material group", [](Scene& s) { s.materials[3].light_group = 1; }},
        {"point position", [](Scene& s) { s.point_lights[0].position.x = 1; }},
        {"point intensity", [](Scene& s) { s.point_lights[0].intensity.r = 1; }},
        {"point group", [](Scene& s) { s.point_lights[0].light_group = 1; }},
        {"spot position", [](Scene& s) { s.spot_lights[0].position.x = 1; }},
        {"spot direction",
         [](Scene& s) {
             s.spot_lights[0].direction = {1, 0, 0};
         }},
        {"spot intensity", [](Scene& s) { s.spot_lights[0].intensity.r = 1; }},
        {"spot inner", [](Scene& s) { s.spot_lights[0].cos_inner = 0.9f; }},
        {"spot outer", [](Scene& s) { s.spot_lights[0].cos_outer = 0.1f; }},
        {"spot group", [](Scene& s) { s.spot_lights[0].light_group = 1; }},
        {"sun direction",
         [](Scene& s) {
             s.directional_lights[0].direction = {1, 0, 0};
         }},
        {"sun irradiance", [](Scene& s) { s.directional_lights[0].irradiance.r = 1; }},
        {"sun group", [](Scene& s) { s.directional_lights[0].light_group = 1; }},
        {"environment", [](Scene& s) { s.environment = mirtest::test_sky(); }},
        {"its light",
         [](Scene& s) {
             s.environment = mirtest::test_sky();
             s.environment->radiance(1, 1).b = 7;
         }},
        {"its scale",
         [](Scene& s) {
             s.environment = mirtest::test_sky();
             s.environment->scale = 2;
         }},
        {"its rotation",
         [](Scene& s) {
             s.environment = mirtest::test_sky();
             s.environment->rotation = 2;
         }},
        {"its group",
         [](Scene& s) {
             s.environment = mirtest::test_sky();
             s.environment->light_group = 2;
         }},
        {"camera position", [](Scene& s) { s.cameras[0].position.x += 1; }},
        {"camera right", [](Scene& s) { s.cameras[0].right = -s.cameras[0].right; }},
        {"camera up", [](Scene& s) { s.cameras[0].up = -s.cameras[0].up; }},
        {"camera back", [](Scene& s) { s.cameras[0].back = -s.cameras[0].back; }},
        {"field of view", [](Scene& s) { s.cameras[0].vertical_fov += 0.1f; }},
        {"camera aspect", [](Scene& s) { s.cameras[0].aspect_ratio = 2.0f; }},
        {"lens radius", [](Scene& s) { s.cameras[0].lens_radius = 0.1f; }},
        {"focus distance", [](Scene& s) { s.cameras[0].focus_distance = 2.0f; }},
    };
    std::set<std::string> seen{hash(full())};
    for (const auto& [what, change] : changes) {
        Scene s = full();
        change(s);
        CAPTURE(what);
        CHECK(seen.insert(hash(s)).second);
    }
}

TEST_CASE("moving a thing from one list to the next changes the hash") {
    // Equal bytes in different lists: a point light and a directional light are both six numbers.
    Scene point, sun;
    point.point_lights.push_back({"", {0, -1, 0}, {1, 2, 3}});
    sun.directional_lights.push_back({"", {0, -1, 0}, {1, 2, 3}});
    CHECK(hash(point) != hash(sun));
}
