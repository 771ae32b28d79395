// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/gltf_file.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace mirtest::features {

/// A primitive of this mode over four corners of a square.
inline Build square_of_mode(int mode) {
    return [mode](Gltf& g) {
        g.attributes()["POSITION"] = g.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
        g.primitive()["mode"] = mode;
    };
}

inline Features gltf_primitives() {
    const auto order = [](std::size_t k, mir::TriangleIndices corners) {
        return mesh([=](const mir::Mesh& m) { CHECK(m.triangles.at(k) == corners); });
    };
    return {
        feature("triangles", "`mode` 4, or none", {[](Gltf&) {}}, read(triangles(1))),
        feature("strips of triangles", "`mode` 5", {square_of_mode(5)},
                read(order(1, {{1, 3, 2}}))),
        feature("fans of triangles", "`mode` 6", {square_of_mode(6)}, read(order(1, {{2, 3, 0}}))),
        feature("points", "`mode` 0", {square_of_mode(0)}, counted({"primitive of points"}),
                "left out"),
        feature("lines", "`mode` 1, 2, 3",
                {square_of_mode(1), square_of_mode(2), square_of_mode(3)},
                counted({"primitive of lines"}), "left out"),
        feature("a mode that glTF has not", "`mode` 7", {square_of_mode(7)},
                refused("mode 7 is none of glTF 2.0")),
        feature("lists of triangles with vertices left over", "`mode` 4", {square_of_mode(4)},
                counted({"incomplete triangle at the end of a primitive"}, triangles(1)),
                "the whole triangles are read"),
        feature("primitives without positions", "no `POSITION`",
                {[](Gltf& g) { g.attributes().erase("POSITION"); }},
                counted({"primitive without positions"}), "left out"),
    };
}

inline Features gltf_indices() {
    const Build bytes = [](Gltf& g) {
        g.primitive()["indices"] = g.numbers<std::uint8_t>({2, 0, 1}, Component::uint8, "SCALAR");
    };
    const Build shorts = [](Gltf& g) {
        g.primitive()["indices"] = g.numbers<std::uint16_t>({2, 0, 1}, Component::uint16, "SCALAR");
    };
    const Build words = [](Gltf& g) {
        g.primitive()["indices"] = g.numbers<std::uint32_t>({2, 0, 1}, Component::uint32, "SCALAR");
    };
    const Build beyond = [](Gltf& g) {
        g.primitive()["indices"] = g.numbers<std::uint8_t>({0, 1, 3}, Component::uint8, "SCALAR");
    };
    return {
        feature("indices of 8, 16 and 32 bits", "`indices`", {bytes, shorts, words},
                read(mesh([](const mir::Mesh& m) {
                    CHECK(m.triangles.at(0) == mir::TriangleIndices{{2, 0, 1}});
                })),
                "without: vertices in their order"),
        feature("indices of vertices that do not exist", "`indices`", {beyond},
                refused("uses vertex 3 of 3")),
    };
}

/// The triangle with its corner at the origin lifted to z = 5 by a sparse accessor.
inline void lift_sparse(Gltf& g) {
    json& accessor = g.file["accessors"][0];
    accessor["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", g.view(bytes_of<std::uint8_t>({0}))}, {"componentType", 5121}}},
        {"values", {{"bufferView", g.view(bytes_of<float>({0, 0, 5}))}}}};
}

/// Indices 2, 1, 0, in which 1 and 0 are of the sparse part.
inline void sparse_indices(Gltf& g) {
    g.primitive()["indices"] = g.numbers<std::uint8_t>({2, 0, 0}, Component::uint8, "SCALAR");
    g.file["accessors"][1]["sparse"] = {
        {"count", 2},
        {"indices",
         {{"bufferView", g.view(bytes_of<std::uint8_t>({1, 2, 0}))}, {"componentType", 5121}}},
        {"values", {{"bufferView", g.view(bytes_of<std::uint8_t>({1, 0, 2}))}}}};
}

/// Positions and normals in turn.
inline void interleave(Gltf& g) {
    const auto at = g.view(bytes_of<float>({0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}));
    g.file["bufferViews"][at]["byteStride"] = 24;
    json accessor = {{"bufferView", at}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
    g.file["accessors"].push_back(accessor);
    accessor["byteOffset"] = 12;
    g.file["accessors"].push_back(accessor);
    g.attributes() = {{"POSITION", 1}, {"NORMAL", 2}};
}

inline Features gltf_accessors() {
    return {
        feature(
            "sparse accessors", "`sparse`",
            {lift_sparse,
             [](Gltf& g) {
                 lift_sparse(g);
                 // Zeros where nothing is sparse.
                 g.file["accessors"][0].erase("bufferView");
             }},
            read(mesh([](const mir::Mesh& m) { CHECK(m.positions.at(0) == mir::Vec3(0, 0, 5)); }))),
        feature("sparse accessors of indices", "`sparse` of `indices`",
                {sparse_indices,
                 [](Gltf& g) {
                     sparse_indices(g);
                     g.file["accessors"][1].erase("bufferView");
                     g.file["accessors"][1]["sparse"]["count"] = 3;
                 }},
                read(mesh([](const mir::Mesh& m) {
                    CHECK(m.triangles.at(0) == mir::TriangleIndices{{2, 1, 0}});
                }))),
        feature("interleaved accessors", "`byteStride`", {interleave},
                read(mesh([](const mir::Mesh& m) {
                    CHECK(m.positions.at(1) == mir::Vec3(1, 0, 0));
                    CHECK(m.normals.at(1) == mir::Vec3(0, 1, 0));
                }))),
        feature("accessors that reach past their view", "`count`",
                {[](Gltf& g) { g.file["accessors"][0]["count"] = 4; }},
                refused("its 4 elements reach past bufferView 0 of 36 bytes")),
        feature("accessors without elements", "`count` 0",
                {[](Gltf& g) { g.file["accessors"][0]["count"] = 0; }},
                refused("it has no elements")),
        feature(
            "positions that are not finite", "NaN, infinity in `POSITION`", {[](Gltf& g) {
                g.attributes()["POSITION"] = g.floats({0, 0, INFINITY, 1, 0, 0, 0, 1, 0}, "VEC3");
            }},
            refused("position 0 is not finite")),
    };
}

/// White vertices of these alphas, of a mask.
inline Build masked(const std::array<float, 3>& alpha) {
    return [alpha](Gltf& g) {
        g.attributes()["COLOR_0"] =
            g.floats({1, 1, 1, alpha[0], 1, 1, 1, alpha[1], 1, 1, 1, alpha[2]}, "VEC4");
        g.material()["alphaMode"] = "MASK";
    };
}

/// A normal map.
inline void bumpy(Gltf& g) { g.material()["normalTexture"] = g.texture(); }

inline void bumpy_with_tangents(Gltf& g) {
    bumpy(g);
    g.attributes()["TANGENT"] = g.floats({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4");
}

inline Features gltf_attributes() {
    const auto colors = [](const std::vector<mir::Rgb>& expected) {
        return read(mesh([=](const mir::Mesh& m) { CHECK(m.colors == expected); }));
    };
    const auto with_color = [](auto make) {
        return [make](Gltf& g) { g.attributes()["COLOR_0"] = make(g); };
    };
    const Build bytes = with_color([](Gltf& g) {
        return g.shares<std::uint8_t>({255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0}, Component::uint8,
                                      "VEC4");
    });
    const Build shorts = with_color([](Gltf& g) {
        return g.shares<std::uint16_t>({65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0},
                                       Component::uint16, "VEC4");
    });
    const Build floats = with_color([](Gltf& g) {
        return g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    });
    return {
        feature("normals", "`NORMAL`", {[](Gltf& g) {
                    g.attributes()["NORMAL"] = g.floats({0, 0, 2, 0, 0, 2, 0, 1, 0}, "VEC3");
                }},
                read(mesh([](const mir::Mesh& m) {
                    CHECK(m.normals == std::vector<mir::Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 1, 0}});
                }))),
        feature("normals of length zero", "`NORMAL`", {[](Gltf& g) {
                    g.attributes()["NORMAL"] = g.floats({0, 0, 0, 0, 0, 1, 0, 0, 1}, "VEC3");
                }},
                counted({"normal without a direction (mesh counted once)"}),
                "the flat normal there"),
        feature("vertex colours of floats, 8 and 16 bits, with alpha and without", "`COLOR_0`",
                {floats, bytes, shorts}, colors({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}),
                "they multiply the base colour; their alpha counts in masks only"),
        feature("vertex colours outside 0..1", "`COLOR_0`", {with_color([](Gltf& g) {
                    return g.floats({2, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
                })},
                counted({"COLOR_0 outside 0..1 (clamped)"})),
        feature("alpha of vertex colours in a mask", "`COLOR_0`, `alphaMode` MASK",
                {masked({0.25f, 0.25f, 0.25f})},
                read(material([](const mir::Material& m) { CHECK(m.alpha == 0.25f); }))),
        feature("the same where it differs over a primitive", "`COLOR_0`, `alphaMode` MASK",
                {masked({1, 0, 1})},
                counted({"alpha of COLOR_0 in a mask"},
                        material([](const mir::Material& m) { CHECK(m.alpha == 1.0f); })),
                "taken as 1"),
        feature("tangents", "`TANGENT`", {bumpy_with_tangents}, without_effect(gltf(bumpy)),
                "see [Textures](#textures)"),
        feature("attributes of programs, further colours", "`_ANYTHING`, `COLOR_1`",
                {[](Gltf& g) { g.attributes()["_ANYTHING"] = 0; },
                 [](Gltf& g) { g.attributes()["COLOR_1"] = 0; }},
                without_effect(gltf([](Gltf&) {}))),
    };
}

/// A morph target with this attribute, of weight `weight`.
inline Build morphed(const std::string& attribute, float weight) {
    return [=](Gltf& g) {
        const auto moves = g.floats({0, 0, 4, 0, 0, 4, 0, 0, 4}, "VEC3");
        g.primitive()["targets"] = json::array({{{attribute, moves}}});
        g.file["meshes"][0]["weights"] = {weight};
    };
}

/// The triangle on one joint, or two sets of them, at x = 1. Its own node stands elsewhere.
inline Build skinned(int sets) {
    return [=](Gltf& g) {
        for (int k = 0; k < sets; ++k) {
            g.attributes()["JOINTS_" + std::to_string(k)] =
                g.numbers(std::vector<std::uint8_t>(12, 0), Component::uint8, "VEC4");
            g.attributes()["WEIGHTS_" + std::to_string(k)] =
                g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
        }
        g.node() = {{"mesh", 0}, {"skin", 0}, {"translation", {500, 0, 0}}};
        g.file["nodes"].push_back({{"translation", {1, 0, 0}}});
        g.file["scenes"][0]["nodes"] = {0, 1};
        g.file["skins"] = json::array({{{"joints", {1}}}});
    };
}

inline Features gltf_shapes() {
    return {
        feature("morph targets of positions and normals", "`targets`, `weights`", {[](Gltf& g) {
                    morphed("POSITION", 0.5f)(g);
                    g.attributes()["NORMAL"] = g.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
                    g.primitive()["targets"][0]["NORMAL"] =
                        g.floats({0, 0, -4, 0, 0, 0, 0, 0, 0}, "VEC3");
                }},
                read(mesh([](const mir::Mesh& m) {
                    CHECK(m.positions.at(0) == mir::Vec3(0, 0, 2));
                    CHECK(m.normals.at(0) == mir::Vec3(0, 0, -1));
                })),
                "weights of the node, else of the mesh"),
        feature("morph targets of colours and texture coordinates", "`targets`", {[](Gltf& g) {
                    morphed("COLOR_0", 0.5f)(g);
                    g.surface()["baseColorTexture"] = g.texture();
                    g.primitive()["targets"][0]["TEXCOORD_0"] = 0;
                    g.attributes()["COLOR_0"] = g.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
                }},
                counted({"morph target of COLOR_0", "morph target of TEXCOORD_0"})),
        feature("morph targets of weight 0", "`targets`",
                {morphed("POSITION", 0), morphed("COLOR_0", 0)},
                without_effect(gltf([](Gltf&) {}))),
        feature("skins, of any number of joints a vertex", "`skin`, `JOINTS_0`, `JOINTS_1`",
                {skinned(1), skinned(2)}, read(first_vertex({1, 0, 0})),
                "placed by joints and inverse bind matrices, not by the mesh's node"),
        feature("skins that cannot be used", "`skin`", {[](Gltf& g) {
                    skinned(1)(g);
                    g.file["skins"][0]["joints"] = {99};
                }},
                counted({"skin"}), "the mesh is placed by its node"),
    };
}

inline Features gltf_geometry() {
    Features all = gltf_primitives();
    append(all, gltf_indices());
    append(all, gltf_accessors());
    append(all, gltf_attributes());
    append(all, gltf_shapes());
    return all;
}

}  // namespace mirtest::features
