// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/gltf_file.hpp"
#include "mir/io/gltf_writer.hpp"

#include <string>

namespace mirtest::features {

inline Features gltf_nodes() {
    const Build parts = [](Gltf& g) {
        g.node() = {{"translation", {0, 0, 1}}, {"scale", {-1, 2, 3}}, {"children", {1}}};
        g.file["nodes"].push_back({{"mesh", 0}, {"translation", {1, 1, 1}}});
    };
    const Build matrix = [](Gltf& g) {
        g.node()["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 2, 4, 1};
    };
    return {
        feature("trees of nodes, mirrored and uneven scale, matrices",
                "`translation`, `rotation`, `scale`, `matrix`, `children`", {parts, matrix},
                read(first_vertex({-1, 2, 4}))),
        feature("meshes shared by nodes", "`mesh`", {[](Gltf& g) {
                    g.file["nodes"].push_back(g.node());
                    g.file["scenes"][0]["nodes"] = {0, 1};
                }},
                read([](const mir::LoadedScene& loaded) {
                    CHECK(loaded.report.stored_triangles == 1);
                    CHECK(loaded.report.triangles == 2);
                }),
                "stored once, expanded for rendering"),
        feature("nodes in a circle", "`children`", {[](Gltf& g) { g.node()["children"] = {0}; }},
                refused("it is its own ancestor or below such a node")),
        feature("several scenes", "`scenes`, `scene`", {[](Gltf& g) {
                    g.file["scenes"].insert(g.file["scenes"].begin(), json::object());
                    g.file["scene"] = 1;
                }},
                noted("the file has 2 scenes: scene 1 was read", triangles(1)),
                "the default, else the first"),
        feature("no scene", "no `scenes`", {[](Gltf& g) {
                    g.file.erase("scenes");
                    g.file.erase("scene");
                }},
                noted("the file has no scene: every root node was placed", triangles(1))),
        feature("animations", "`animations`",
                {[](Gltf& g) { g.file["animations"] = json::array({json::object()}); }},
                counted({"animation"}, triangles(1)), "as stored at rest"),
        feature("an environment", "`environment` in `extras` of a scene",
                {[](Gltf& g) { g.file["scenes"][0]["extras"]["environment"] = "sky.hdr"; }},
                counted({"environment"}), "one is given as a [picture](#environment)"),
    };
}

inline Features gltf_cameras() {
    const json lens = {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 2}};
    json finite = lens;
    finite["zfar"] = 10;
    return {
        feature("perspective cameras, with a far plane and without", "`perspective`",
                {with_camera({{"type", "perspective"}, {"perspective", lens}}),
                 with_camera({{"type", "perspective"}, {"perspective", finite}})},
                read([](const mir::LoadedScene& loaded) {
                    CHECK(loaded.scene.cameras.at(0).vertical_fov == 0.5f);
                    CHECK(loaded.scene.cameras.at(0).aspect_ratio == 2.0f);
                }),
                "planes cut nothing away; see [Scale](#scale-of-lights-and-cameras)"),
        feature("orthographic cameras", "`orthographic`",
                {with_camera(
                    {{"type", "orthographic"},
                     {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 2}, {"znear", 1}}}})},
                counted({"camera of type 'orthographic'"},
                        [](const mir::LoadedScene& loaded) {
                            CHECK(loaded.scene.cameras.empty());
                            CHECK(loaded.report.cameras.size() == 1);
                        }),
                "listed, not usable"),
    };
}

inline std::string small_glb() {
    const TemporaryFolder folder("features");
    mir::Scene scene;
    scene.add({});
    mir::Mesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    m.triangles = {{{0, 1, 2}}};
    scene.place(m);
    mir::write_glb(scene, folder / "a.glb");
    std::ifstream in(folder / "a.glb", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A .glb file of these bytes.
inline Feature glb(const std::string& name, const std::string& bytes, Outcome outcome,
                   const std::string& words = "") {
    return {name, "`.glb`", {{{{"scene.glb", bytes}}, "scene.glb"}}, std::move(outcome), words};
}

/// The triangle's buffer under this URI; its file has the name `file`.
inline Build with_buffer(const std::string& uri, const std::string& file = "") {
    return [=](Gltf& g) {
        g.file["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        if (!file.empty()) g.beside[file] = g.bytes();
    };
}

inline Features gltf_containers() {
    const std::string base64 =
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    const std::string file = small_glb();
    return {
        glb("binary files", file, read(triangles(1))),
        glb("bytes behind the end of a binary file", file + "more",
            noted("the file has 4 bytes behind the end that its header announces: they were not "
                  "read",
                  triangles(1))),
        glb("binary files that are cut short", file.substr(0, file.size() - 4),
            refused("the file is cut short")),
        feature("buffers in files", "`uri`", {with_buffer("a%20b.bin", "a b.bin")},
                read(triangles(1)), "see [Files](#files-beside-the-scene)"),
        feature("buffers in the JSON", "`uri` with `data:`", {with_buffer(base64)},
                read(triangles(1))),
        feature("buffers that are missing", "`uri`", {with_buffer("none.bin")},
                refused("File not found : none.bin")),
        feature("buffers outside of the folder", "`uri`",
                {with_buffer("../secret.bin", "../secret.bin")},
                refused("lies outside of the scene's folder"),
                "see [Files](#files-beside-the-scene)"),
        feature("buffers elsewhere", "`uri` with `http:`, `file:`",
                {with_buffer("http://example.com/a.bin"), with_buffer("file:///a.bin")},
                refused("this reader opens files beside the scene")),
        feature("glTF 1.0", "`asset`", {[](Gltf& g) { g.file["asset"]["version"] = "1.0"; }},
                refused("it is glTF 1.0", mir::ErrorCode::unsupported)),
        feature("later versions", "`minVersion`",
                {[](Gltf& g) { g.file["asset"]["minVersion"] = "2.1"; }},
                refused("it is glTF 2.1", mir::ErrorCode::unsupported)),
        feature("values of a wrong type", "for instance null for a number", {[](Gltf& g) {
                    g.node()["translation"] = {nullptr, 0, 0};
                }},
                refused("translation[0] is null, where a number is wanted"),
                "see [Wrong types](#wrong-types-and-what-is-not-used)"),
    };
}

inline Features gltf_scenes() {
    Features all = gltf_containers();
    append(all, gltf_nodes());
    append(all, gltf_cameras());
    return all;
}

}  // namespace mirtest::features
