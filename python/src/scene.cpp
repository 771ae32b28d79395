// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include "errors.hpp"
#include "mir/io/gltf_writer.hpp"
#include "mir/scenes.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;

namespace mirpy {

mir::Scene& PyScene::edit() {
    mir::expects(*holders_ == 0,
                 "the scene is being rendered (it must not change meanwhile); wait for the end, or "
                 "close the iterator of progressive()");
    is_edited_ = true;
    tracing_.reset();
    return loaded_->scene;
}

const std::shared_ptr<PyScene::Loaded>& PyScene::counted() {
    if (!is_edited_) return loaded_;
    mir::SceneReport fresh;
    fresh.cameras = std::move(loaded_->report.cameras);
    fresh.ignored = std::move(loaded_->report.ignored);
    fresh.remarks = std::move(loaded_->report.remarks);
    mir::count_scene(loaded_->scene, fresh);
    loaded_->report = std::move(fresh);
    is_edited_ = false;
    return loaded_;
}

std::uint32_t PyScene::add_camera(const mir::Camera& camera) {
    mir::Scene& scene = edit();
    scene.cameras.push_back(camera);
    const auto index = static_cast<std::uint32_t>(scene.cameras.size() - 1);
    loaded_->report.cameras.push_back({camera.name, "perspective", index});
    return index;
}

std::shared_ptr<const Tracing> PyScene::tracing() {
    if (tracing_) return tracing_;
    const Hold hold(*this);
    const nb::gil_scoped_release release;
    auto built = std::make_shared<const Tracing>(scene());
    const nb::gil_scoped_acquire acquire;
    return tracing_ = std::move(built);
}

namespace {

std::unique_ptr<PyScene> load(nb::handle name, bool allow_outside) {
    const auto path = nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(name));
    mir::Limits limits;
    limits.allow_outside = allow_outside;
    PyScene::Loaded loaded = [&] {
        const nb::gil_scoped_release release;
        return mirtool::load_scene(path, limits);
    }();
    return std::make_unique<PyScene>(std::move(loaded));
}

void save(PyScene& self, const std::filesystem::path& path) {
    const PyScene::Hold hold(self);
    const nb::gil_scoped_release release;
    mir::write_glb(self.scene(), path);
}

using Corner = std::tuple<float, float, float>;

std::pair<Corner, Corner> bounds_of(PyScene& self) {
    const mir::Bounds& b = self.report().bounds;
    return {{b.low.x, b.low.y, b.low.z}, {b.high.x, b.high.y, b.high.z}};
}

std::vector<std::string> names_of_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : mir::builtin::scenes) names.emplace_back(entry.name);
    return names;
}

std::vector<std::string> cameras_of(PyScene& self) {
    std::vector<std::string> names;
    for (const mir::CameraReport& camera : self.report().cameras) names.push_back(camera.name);
    return names;
}

std::string shown(PyScene& self) {
    const mir::SceneReport& r = self.report();
    return "<mir.Scene " + self.scene().name + ": " + std::to_string(r.triangles) + " triangles, " +
           std::to_string(r.materials) + " materials, " + std::to_string(r.cameras.size()) +
           " cameras>";
}

void bind_facts(nb::class_<PyScene>& scene) {
    scene
        .def_prop_rw(
            "name", [](PyScene& s) { return s.scene().name; },
            [](PyScene& s, const std::string& name) { s.edit().name = name; },
            "For messages and files.")
        .def_prop_ro(
            "triangles", [](PyScene& s) { return s.report().triangles; },
            "Number of triangles, of all instances.")
        .def_prop_ro(
            "meshes", [](PyScene& s) { return s.scene().meshes.size(); }, "Number of meshes.")
        .def_prop_ro(
            "materials", [](PyScene& s) { return s.scene().materials.size(); },
            "Number of materials.")
        .def_prop_ro("cameras", cameras_of, "Names of the cameras, in their order.")
        .def_prop_ro("bounds", bounds_of, "Lowest and highest corner, metres.")
        .def_prop_ro(
            "ignored", [](PyScene& s) { return s.report().ignored; },
            "What the file holds and mir does not read, with the number of its uses.")
        .def_prop_ro(
            "notes", [](PyScene& s) { return s.report().notes; },
            "Sentences on choices that the reader made.")
        .def_prop_ro(
            "ray_offset", [](PyScene& s) { return s.tracing()->geometry.ray_offset(); },
            "Metres by which rays are lifted off surfaces; of reshade().")
        .def_prop_ro(
            "origin",
            [](PyScene& s) {
                const mir::DVec3 o = s.scene().origin;
                return std::tuple(o.x, o.y, o.z);
            },
            "Place, in the file's coordinates, from which all others are counted; metres.");
}

}  // namespace

void bind_scene(nb::module_& m) {
    nb::class_<PyScene> scene(m, "Scene",
                              "Everything to render. Metres, +y up; radiance in W m^-2 sr^-1.");
    scene
        .def(
            "__init__",
            [](PyScene* self, const std::string& name) {
                (new (self) PyScene())->edit().name = name;
            },
            nb::arg("name") = "", "An empty scene.")
        .def("save", save, nb::arg("path"), "Writes it as binary glTF (.glb).")
        .def("__repr__", shown);
    bind_facts(scene);
    bind_materials(scene);
    bind_meshes(scene);
    bind_lights(scene);
    m.def("load", load, nb::arg("path").none(), nb::arg("allow_outside") = false,
          "The scene of a file (.gltf, .glb, .obj, .ply), or a built-in one, \"builtin:NAME\".\n\n"
          "allow_outside: the file may name others outside of its folder.");
    m.def("builtin_scenes", names_of_scenes, "Names of the built-in scenes.");
}

}  // namespace mirpy
