// SPDX-License-Identifier: MIT
#include "mir/io/gltf_writer.hpp"

#include "io/gltf_fixture.hpp"
#include "mir/io/gltf_reader.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace mirtest;
using mir::Vec3;

namespace {

void check_same(const mir::Material& a, const mir::Material& b) {
    CHECK(a.name == b.name);
    CHECK(a.base_color == b.base_color);
    CHECK(a.metallic == b.metallic);
    CHECK(a.roughness == b.roughness);
    CHECK(a.specular == b.specular);
    CHECK(a.ior == b.ior);
    CHECK(a.emission == b.emission);
    CHECK(a.emits_from_both_sides == b.emits_from_both_sides);
    CHECK(a.light_group == b.light_group);
    CHECK(a.alpha == b.alpha);
    CHECK(a.alpha_cutoff == b.alpha_cutoff);
}

void check_same(const mir::Mesh& a, const mir::Mesh& b) {
    CHECK(a.name == b.name);
    CHECK((a.positions == b.positions));
    CHECK((a.normals == b.normals));
    CHECK((a.triangles == b.triangles));
    CHECK(a.material == b.material);
}

void check_same(const mir::Instance& a, const mir::Instance& b) {
    CHECK(a.mesh == b.mesh);
    CHECK((a.to_world == b.to_world));
}

void check_same(const mir::PointLight& a, const mir::PointLight& b) {
    CHECK(a.name == b.name);
    CHECK((a.position == b.position));
    CHECK(a.intensity == b.intensity);
    CHECK(a.light_group == b.light_group);
}

void check_same(const mir::SpotLight& a, const mir::SpotLight& b) {
    CHECK(a.name == b.name);
    CHECK((a.position == b.position));
    CHECK((a.direction == b.direction));
    CHECK(a.intensity == b.intensity);
    CHECK(a.cos_inner == b.cos_inner);
    CHECK(a.cos_outer == b.cos_outer);
    CHECK(a.light_group == b.light_group);
}

void check_same(const mir::DirectionalLight& a, const mir::DirectionalLight& b) {
    CHECK(a.name == b.name);
    CHECK((a.direction == b.direction));
    CHECK(a.irradiance == b.irradiance);
    CHECK(a.light_group == b.light_group);
}

void check_same(const mir::Camera& a, const mir::Camera& b) {
    CHECK(a.name == b.name);
    CHECK((a.position == b.position));
    CHECK((a.right == b.right));
    CHECK((a.up == b.up));
    CHECK((a.back == b.back));
    CHECK(a.vertical_fov == b.vertical_fov);
    CHECK(a.aspect_ratio == b.aspect_ratio);
    CHECK(a.lens_radius == b.lens_radius);
    CHECK(a.focus_distance == b.focus_distance);
}

template <class T>
void check_same_list(const std::vector<T>& a, const std::vector<T>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) check_same(a[i], b[i]);
}

void check_same_scene(const mir::Scene& a, const mir::Scene& b) {
    CHECK(a.name == b.name);
    check_same_list(a.meshes, b.meshes);
    check_same_list(a.instances, b.instances);
    check_same_list(a.materials, b.materials);
    check_same_list(a.point_lights, b.point_lights);
    check_same_list(a.spot_lights, b.spot_lights);
    check_same_list(a.directional_lights, b.directional_lights);
    check_same_list(a.cameras, b.cameras);
}

mir::Mesh some_mesh(const std::string& name, std::uint32_t material, bool smooth) {
    mir::Mesh mesh;
    mesh.name = name;
    mesh.positions = {{0.1f, 0.2f, 0.3f}, {1.0f / 3, 0, 0}, {0, 1e-20f, 0}, {1e20f, 1, 1}};
    if (smooth) mesh.normals.assign(4, glm::normalize(Vec3(0.3f, -0.7f, 0.2f)));
    mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
    mesh.material = material;
    return mesh;
}

/// A scene in which no two values are alike.
mir::Scene full_scene() {
    mir::Scene scene;
    scene.name = "h\xc3\xb6me \"1\"";
    const auto plain = scene.add(mir::lambertian("grey", {0.1f, 0.2f, 0.3f}));
    mir::Material lamp = mir::emitter("lamp", {1, 1, 1}, {17.3f, 1.1f / 3, 1e-6f});
    lamp.emits_from_both_sides = true;
    lamp.light_group = 7;
    lamp.ior = 1.33f;
    lamp.metallic = 0.9f;
    lamp.roughness = 0.123f;
    lamp.specular = 0.77f;
    lamp.alpha = 0.9f;
    lamp.alpha_cutoff = 0.1f;
    const auto glowing = scene.add(lamp);
    scene.add(mir::emitter("dim", {0, 0, 0}, {0, 1e-30f, 0}));
    mir::Mat4 mirrored(1.0f);
    mirrored[0] = {-1.5f, 0.1f, 0, 0};
    mirrored[3] = {3.3f, 4.4f, 5.5f, 1};
    scene.place(some_mesh("flat", plain, false));
    const auto smooth = scene.place(some_mesh("smooth", glowing, true), mirrored);
    scene.instances.push_back({smooth, mir::Mat4(1.0f)});
    scene.meshes.push_back(some_mesh("nowhere", plain, false));
    const Vec3 aslant = glm::normalize(Vec3(0.3f, -0.9f, 0.1f));
    scene.point_lights.push_back({"bulb", {1, 2, 3}, {0.1f, 20.0f, 3.0f}, 1});
    scene.point_lights.push_back({"off", {1, 2, 3}, {0, 0, 0}, 0});
    scene.spot_lights.push_back({"spot", {4, 5, 6}, aslant, {1, 2, 3}, 0.987f, 0.654f, 2});
    scene.spot_lights.push_back({"wide", {4, 5, 6}, {0, 1, 0}, {1, 2, 3}, 1.0f, 0.0f, 0});
    scene.directional_lights.push_back({"sun", aslant, {5, 4, 3}, 65535});
    mir::Camera camera = mir::Camera::look_at({1, 2, 3}, {0.3f, 0.1f, -7}, {0, 1, 0}, 0.7f);
    camera.name = "front";
    camera.aspect_ratio = 1.7f;
    camera.lens_radius = 0.01f;
    camera.focus_distance = 3.7f;
    scene.cameras = {camera, mir::Camera{}};
    return scene;
}

std::string bytes_of_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a scene comes back from its file with the same values") {
    const TemporaryFolder folder("gltf_writer");
    const mir::Scene scene = full_scene();
    mir::write_glb(scene, folder / "scene.glb");
    const auto loaded = mir::read_gltf(folder / "scene.glb");
    check_same_scene(loaded.scene, scene);
    CHECK(loaded.report.ignored.empty());
    CHECK(folder.files() == 1);
}

TEST_CASE("an empty scene can be written and read") {
    const TemporaryFolder folder("gltf_writer");
    mir::write_glb({}, folder / "empty.glb");
    check_same_scene(mir::read_gltf(folder / "empty.glb").scene, {});
}

TEST_CASE("equal scenes give equal bytes") {
    const TemporaryFolder folder("gltf_writer");
    mir::write_glb(full_scene(), folder / "a.glb");
    mir::write_glb(full_scene(), folder / "b.glb");
    CHECK(bytes_of_file(folder / "a.glb") == bytes_of_file(folder / "b.glb"));
}

TEST_CASE("a scene that cannot be written leaves no file and says why") {
    const TemporaryFolder folder("gltf_writer");
    mir::Scene scene = full_scene();
    scene.meshes[0].triangles.clear();
    const auto write = [&] { mir::write_glb(scene, folder / "scene.glb"); };
    CHECK(message_of(write).find("mesh 'flat': it has no triangles") != std::string::npos);
    scene = full_scene();
    scene.meshes[1].triangles[0][2] = 4;
    CHECK(message_of(write).find("uses vertex 4 of 4") != std::string::npos);
    scene = full_scene();
    scene.instances[0].mesh = 9;
    CHECK(message_of(write).find("names mesh 9") != std::string::npos);
    scene = full_scene();
    scene.cameras[0].name = "\xff";
    mir::ErrorCode code = mir::ErrorCode::internal;
    CHECK(message_of(write, &code).find("scene.glb: ") != std::string::npos);
    CHECK(code == mir::ErrorCode::invalid_argument);
    CHECK(folder.files() == 0);
}

TEST_CASE("a scene whose environment glTF would lose is not written") {
    const TemporaryFolder folder("gltf_environment");
    mir::Scene scene;
    scene.environment.emplace();
    mir::ErrorCode code{};
    const auto write = [&] { mir::write_glb(scene, folder / "scene.glb"); };
    CHECK(message_of(write, &code).find("environment") != std::string::npos);
    CHECK(code == mir::ErrorCode::unsupported);
    CHECK(folder.files() == 0);
}

TEST_CASE("every shared scene survives being read, written and read again") {
    const auto shared = shared_scenes();
    if (!shared) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    const TemporaryFolder folder("gltf_writer");
    for (const char* file : {"cornell-box/cornell-box.glb", "bmw-m6/bmw-m6.glb",
                             "veach-mis/veach-mis.glb", "gltf-features/Lights.glb"}) {
        INFO(file);
        const auto first = mir::read_gltf(*shared / file);
        mir::write_glb(first.scene, folder / "again.glb");
        check_same_scene(mir::read_gltf(folder / "again.glb").scene, first.scene);
    }
}
