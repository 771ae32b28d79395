// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/printable.hpp"
#include "mir/scene/light_kinds.hpp"
#include "mir/scene/world_geometry.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// A camera of a scene file, usable or not.
struct CameraReport {
    std::string name;                    ///< as in the file, printable(); may be empty
    std::string kind;                    ///< "perspective", or the kind that cannot be used
    std::optional<std::uint32_t> index;  ///< into Scene::cameras; none: not supported
    std::uint32_t width = 0;             ///< pixels that the file asks for; 0: not given
    std::uint32_t height = 0;            ///< as width
};

/// What a scene file holds and which parts of it are not used. Plain values, texts printable().
struct SceneReport {
    std::uint64_t triangles = 0;           ///< after instancing
    std::uint64_t vertices = 0;            ///< after instancing
    std::uint64_t stored_triangles = 0;    ///< each mesh once
    std::uint64_t emitting_triangles = 0;  ///< after instancing
    std::uint64_t meshes = 0;              ///< each once, however often it is placed
    std::uint64_t instances = 0;           ///< placed meshes
    std::uint64_t materials = 0;           ///< used by a mesh or not
    std::uint64_t emitting_materials = 0;  ///< those of them whose emission is not black
    std::array<std::uint64_t, ListedLights::size> listed_lights{};  ///< by kind of light
    std::uint64_t environments = 0;                                 ///< 0 or 1
    std::vector<CameraReport> cameras;  ///< usable or not, as the reader met them
    Bounds bounds;                      ///< of all instances, metres, from Scene::origin on

    /// Features that change the picture and are not supported, with the number of their uses.
    /// Nothing is dropped without an entry here. visible_effect() says how that looks.
    std::map<std::string, std::uint64_t> ignored;
    std::vector<std::string> notes;  ///< sentences on choices that the reader made
    /// Sentences of recentre(): what is too fine for 32-bit numbers where it lies. The picture may
    /// be wrong there.
    std::vector<std::string> remarks;

    /// True when nothing in the scene shines.
    [[nodiscard]] bool is_dark() const {
        return std::accumulate(listed_lights.begin(), listed_lights.end(),
                               emitting_triangles + environments) == 0;
    }
};

namespace detail {

/// Note on a scene that is_dark().
inline constexpr const char* no_light_note =
    "no light: no material emits and there is no light source";

inline void count_instance(const Scene& scene, const Instance& instance, SceneReport& report) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    report.triangles += mesh.triangles.size();
    report.vertices += mesh.positions.size();
    if (scene.materials[mesh.material].emits()) report.emitting_triangles += mesh.triangles.size();
    for (Vec3 p : mesh.positions) report.bounds.add(Vec3(instance.to_world * Vec4(p, 1.0f)));
}

inline void note_absences(const Scene& scene, SceneReport& report) {
    if (report.triangles == 0) report.notes.emplace_back("no triangles: there is nothing to see");
    if (report.is_dark()) report.notes.emplace_back(no_light_note);
    if (scene.cameras.empty())
        report.notes.emplace_back("no usable camera: one is chosen, or given by --eye");
}

/// Texts of a report quote names of the file: extensions, types, whatever they are called.
inline void make_printable(SceneReport& report) {
    for (CameraReport& camera : report.cameras) {
        camera.name = printable(camera.name);
        camera.kind = printable(camera.kind);
    }
    std::map<std::string, std::uint64_t> ignored;
    for (const auto& [what, times] : report.ignored) ignored[printable(what, 300)] += times;
    report.ignored = std::move(ignored);
    for (std::string& note : report.notes) note = printable(note, 1000);
    for (std::string& remark : report.remarks) remark = printable(remark, 1000);
}

}  // namespace detail

/// Fills counts and bounds of `report` from a checked scene and notes what is missing. Cameras,
/// `ignored` and earlier notes stay, made printable().
/// @pre every index of `scene` is valid (the readers check this).
inline void count_scene(const Scene& scene, SceneReport& report) {
    report.meshes = scene.meshes.size();
    report.instances = scene.instances.size();
    report.materials = scene.materials.size();
    ListedLights::for_each_list(scene, [&report]<class Light>(const std::vector<Light>& list) {
        report.listed_lights[ListedLights::index_of<Light>()] = list.size();
    });
    report.environments = scene.environment ? 1 : 0;
    for (const Mesh& mesh : scene.meshes) report.stored_triangles += mesh.triangles.size();
    for (const Material& material : scene.materials)
        if (material.emits()) ++report.emitting_materials;
    for (const Instance& instance : scene.instances)
        detail::count_instance(scene, instance, report);
    detail::note_absences(scene, report);
    detail::make_printable(report);
}

/// Gives a counted scene the light of `environment`, which no scene file holds. It replaces the
/// scene's own, the note that the scene is dark, and the one that a file's sky was ignored.
inline void put_around(Scene& scene, Environment environment, SceneReport& report) {
    scene.environment = std::move(environment);
    report.environments = 1;
    std::erase(report.notes, detail::no_light_note);
    report.ignored.erase("environment");
}

}  // namespace mir
