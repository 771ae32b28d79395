// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/gltf_material_extensions.hpp"

#include <string>
#include <utility>
#include <vector>

namespace mirtest::features {

/// The triangle copied to x = 0 and x = 1.
inline void two_copies(Gltf& g) {
    const auto at = g.floats({0, 0, 0, 1, 0, 0}, "VEC3");
    g.node()["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", {{"TRANSLATION", at}}}};
}

/// Positions of 16 bits that are no shares, as KHR_mesh_quantization allows.
inline void quantized(Gltf& g) {
    const auto at = g.view(bytes_of<std::int16_t>({0, 0, 0, 0, 7, 0, 0, 0, 0, 1, 0, 0}));
    g.file["bufferViews"][at]["byteStride"] = 8;
    g.file["accessors"].push_back(
        {{"bufferView", at}, {"componentType", 5122}, {"count", 3}, {"type", "VEC3"}});
    g.attributes()["POSITION"] = 1;
}

inline std::vector<Extension> geometry_extensions() {
    const Build draco = [](Gltf& g) {
        g.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
            {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    };
    const auto meshopt = [](const std::string& name) {
        return [name](Gltf& g) {
            g.file["bufferViews"][0]["extensions"][name] = {{"buffer", 0}, {"count", 3}};
        };
    };
    const Build splats = [](Gltf& g) {
        g.primitive()["mode"] = 0;
        g.primitive()["extensions"]["KHR_gaussian_splatting"] = json::object();
    };
    const Build manifold = [](Gltf& g) {
        g.file["meshes"][0]["extensions"]["EXT_mesh_manifold"] = json::object();
    };
    return {
        extension(
            "KHR_mesh_quantization", "positions, normals, coordinates of 8 and 16 bits", quantized,
            read(mesh([](const mir::Mesh& m) { CHECK(m.positions.at(1) == mir::Vec3(7, 0, 0)); }))),
        extension("EXT_mesh_gpu_instancing", "copies of a mesh", two_copies, read(triangles(2)),
                  "stored once, expanded for rendering"),
        optional_alone("KHR_draco_mesh_compression", "compressed meshes", draco,
                       counted({"KHR_draco_mesh_compression"}, triangles(1)),
                       "the accessors beside it are read"),
        optional_alone("EXT_meshopt_compression", "compressed buffers",
                       meshopt("EXT_meshopt_compression"), read(triangles(1)),
                       "from the buffer beside it"),
        optional_alone("KHR_meshopt_compression", "compressed buffers",
                       meshopt("KHR_meshopt_compression"), read(triangles(1)),
                       "from the buffer beside it"),
        optional_alone("KHR_gaussian_splatting", "points that are no surface", splats,
                       counted({"primitive of points"}), "left out"),
        of_no_effect("EXT_mesh_manifold", "solids", manifold, plain_triangle),
    };
}

/// A punctual light of these fields in the triangle's node.
inline Build with_light(const json& fields) {
    return [=](Gltf& g) {
        g.file["extensions"]["KHR_lights_punctual"] = {{"lights", json::array({fields})}};
        g.node()["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
    };
}

inline std::vector<Extension> lights() {
    const std::string name = "KHR_lights_punctual";
    const auto lights = [](std::size_t points, std::size_t spots, std::size_t directions) {
        return read([=](const mir::LoadedScene& loaded) {
            CHECK(loaded.scene.point_lights.size() == points);
            CHECK(loaded.scene.spot_lights.size() == spots);
            CHECK(loaded.scene.directional_lights.size() == directions);
        });
    };
    const auto of_scene = [](const std::string& extension) {
        return [extension](Gltf& g) {
            g.file["extensions"][extension] = {{"lights", json::array()}};
            g.file["scenes"][0]["extensions"][extension] = {{"light", 0}};
        };
    };
    return {
        extension(name, "point lights", with_light({{"type", "point"}}), lights(1, 0, 0),
                  "see [Scale](#scale-of-lights-and-cameras)"),
        extension(name, "spot lights",
                  with_light({{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}),
                  lights(0, 1, 0)),
        extension(name, "cone angles out of order",
                  with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}}}}),
                  refused("its cone angles are not in order")),
        extension(name, "directional lights", with_light({{"type", "directional"}}),
                  lights(0, 0, 1)),
        extension(name, "`range`", with_light({{"type", "point"}, {"range", 2}}),
                  counted({"range of a light"}), "infinite"),
        optional_alone("EXT_lights_image_based", "light from all around",
                       of_scene("EXT_lights_image_based"), counted({"EXT_lights_image_based"}),
                       "one is given as a [picture](#environment)"),
        optional_alone(
            "EXT_lights_ies", "profiles of lamps",
            [](Gltf& g) {
                g.node()["extensions"]["EXT_lights_ies"] = {{"light", 0}};
            },
            counted({"EXT_lights_ies"})),
    };
}

/// A base colour texture whose image stands under an extension; `with_png` beside it.
inline Build image_under(const std::string& extension, bool with_png) {
    return [=](Gltf& g) {
        g.surface()["baseColorTexture"] = g.texture();
        json& texture = g.file["textures"][0];
        texture["extensions"][extension] = {{"source", 0}};
        if (!with_png) texture.erase("source");
    };
}

inline std::vector<Extension> texture_extensions() {
    const auto textured =
        material([](const mir::Material& m) { CHECK(m.textures.base_color.is_set()); });
    const Outcome lost = counted({"texture baseColorTexture without a PNG or JPEG image"});
    const std::string fallback = "beside a PNG or JPEG image";
    const Build moved = [](Gltf& g) {
        json use = g.texture();
        use["extensions"]["KHR_texture_transform"] = {{"offset", {0.25, 0.5}},
                                                      {"rotation", 1.57079632679},
                                                      {"scale", {2, 4}},
                                                      {"texCoord", 1}};
        g.attributes()["TEXCOORD_1"] = g.floats({1, 0, 1, 0, 1, 0}, "VEC2");
        g.surface()["baseColorTexture"] = use;
    };
    const Check is_moved = [](const mir::LoadedScene& loaded) {
        const mir::Mesh& m = loaded.scene.meshes.at(0);
        const mir::Texture& t = loaded.scene.materials.at(m.material).textures.base_color;
        CHECK(glm::length(t.place({0.5f, 0.5f}) - mir::Vec2(2.25f, -0.5f)) < 1e-5f);
        CHECK(m.texture_coordinates.at(0) == mir::Vec2(1, 0));
    };
    std::vector<Extension> all = {
        extension("KHR_texture_transform", "`offset`, `rotation`, `scale`, `texCoord`", moved,
                  read(is_moved)),
        optional_alone("KHR_texture_basisu", fallback, image_under("KHR_texture_basisu", true),
                       read(textured)),
        optional_alone("KHR_texture_basisu", "KTX2 alone", image_under("KHR_texture_basisu", false),
                       lost)};
    for (const auto& [name, format] : {std::pair{"EXT_texture_webp", "WebP"},
                                       {"EXT_texture_avif", "AVIF"},
                                       {"MSFT_texture_dds", "DDS"}}) {
        all.push_back(extension(name, fallback, image_under(name, true), read(textured)));
        all.push_back(
            extension(name, std::string(format) + " alone", image_under(name, false), lost));
    }
    return all;
}

inline std::vector<Extension> other_extensions() {
    const auto of_node = [](const std::string& name, const json& values = json::object()) {
        return [=](Gltf& g) { g.node()["extensions"][name] = values; };
    };
    const auto visible = [](json& node, bool is_visible) {
        node["extensions"]["KHR_node_visibility"]["visible"] = is_visible;
    };
    const Build hidden = [visible](Gltf& g) {
        with_light({{"type", "point"}})(g);
        with_camera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}})(g);
        visible(g.node(), true);
        json above = {{"children", {0}}};
        visible(above, false);
        g.file["nodes"].push_back(above);
        g.file["scenes"][0]["nodes"] = {1};
    };
    const Check is_hidden = [](const mir::LoadedScene& loaded) {
        CHECK(loaded.report.triangles == 0);
        CHECK(loaded.scene.point_lights.empty());
        CHECK(loaded.scene.cameras.size() == 1);
    };
    const Build pointer = [](Gltf& g) {
        g.file["animations"] = json::array({{{"channels", json::array()}}});
    };
    const Build metadata = [](Gltf& g) {
        g.file["extensions"]["KHR_xmp_json_ld"] = {{"packets", json::array()}};
        g.node()["extensions"]["KHR_xmp_json_ld"] = {{"packet", 0}};
    };
    const Build anywhere = [](Gltf& g) {
        for (json* place : {&g.file, &g.file["scenes"][0], &g.node(), &g.material()})
            (*place)["extensions"]["VENDOR_some_extension"] = json::object();
    };
    return {
        extension("KHR_animation_pointer", "", pointer, counted({"animation"}, triangles(1)),
                  "as stored at rest"),
        extension("KHR_node_visibility", "`visible` false", hidden, read(is_hidden),
                  "hides meshes and lights of the node and those below, not cameras"),
        of_no_effect(
            "KHR_node_visibility", "`visible` true",
            [visible](Gltf& g) { visible(g.node(), true); }, plain_triangle),
        of_no_effect("KHR_node_hoverability", "", of_node("KHR_node_hoverability"), plain_triangle),
        of_no_effect("KHR_node_selectability", "", of_node("KHR_node_selectability"),
                     plain_triangle),
        of_no_effect("KHR_xmp_json_ld", "facts about the file", metadata, plain_triangle),
        optional_alone("MSFT_lod", "levels of detail", of_node("MSFT_lod"),
                       counted({"MSFT_lod"}, triangles(1)), "the finest one"),
        optional_alone("VENDOR_some_extension", "any other, of the file, scenes, nodes, materials",
                       anywhere, counted({"VENDOR_some_extension"}, triangles(1)), "ignored"),
    };
}

inline std::vector<Extension> gltf_extensions() {
    std::vector<Extension> all;
    for (auto list : {read_materials(), counted_materials(), lights(), geometry_extensions(),
                      texture_extensions(), other_extensions()})
        for (Extension& one : list) all.push_back(std::move(one));
    return all;
}

}  // namespace mirtest::features
