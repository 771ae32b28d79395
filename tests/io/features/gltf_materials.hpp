// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/gltf_file.hpp"

#include <string>
#include <vector>

namespace mirtest::features {

inline Build with_material(const json& fields) {
    return [=](Gltf& g) { g.material() = fields; };
}

inline Build with_surface(const json& fields) {
    return [=](Gltf& g) { g.surface() = fields; };
}

inline Features gltf_factors() {
    return {
        feature("base colour, metalness, roughness",
                "`baseColorFactor`, `metallicFactor`, `roughnessFactor`",
                {with_surface({{"baseColorFactor", {0.25, 0.5, 0.75, 1}},
                               {"metallicFactor", 0.125},
                               {"roughnessFactor", 0.5}})},
                read(material([](const mir::Material& m) {
                    CHECK(m.base_color == mir::Rgb{0.25f, 0.5f, 0.75f});
                    CHECK(m.metallic == 0.125f);
                    CHECK(m.roughness == 0.5f);
                }))),
        feature("factors outside 0..1", "for instance `roughnessFactor`",
                {with_surface({{"roughnessFactor", 1.5}})},
                counted({"roughnessFactor outside 0..1 (clamped)"},
                        material([](const mir::Material& m) { CHECK(m.roughness == 1.0f); }))),
        feature("emission", "`emissiveFactor`", {with_material({{"emissiveFactor", {1, 0.5, 0}}})},
                read(material([](const mir::Material& m) {
                    CHECK(m.emission == mir::Rgb{1.0f, 0.5f, 0.0f});
                }))),
        feature("negative emission", "`emissiveFactor`",
                {with_material({{"emissiveFactor", {-1, 0, 0}}})},
                refused("emissiveFactor is negative")),
        feature("double-sided materials", "`doubleSided`", {with_material({{"doubleSided", true}})},
                read(material([](const mir::Material& m) { CHECK(m.emits_from_both_sides); })),
                "of lamps alone, see [Sides](#sides)"),
        feature("primitives without material", "no `material`",
                {[](Gltf& g) { g.primitive().erase("material"); }},
                read(material([](const mir::Material& m) {
                    CHECK(m.base_color == mir::Rgb{1, 1, 1});
                    CHECK(m.metallic == 1.0f);
                    CHECK(m.roughness == 1.0f);
                })),
                "glTF's default: white, metallic, rough"),
    };
}

inline Features gltf_alpha() {
    const json half = {{"baseColorFactor", {1, 1, 1, 0.5}}};
    return {
        feature("masks", "`alphaMode` MASK, `alphaCutoff`",
                {with_material({{"alphaMode", "MASK"}, {"pbrMetallicRoughness", half}})},
                read(material([](const mir::Material& m) {
                    CHECK(m.alpha == 0.5f);
                    CHECK(m.alpha_cutoff == 0.5f);
                })),
                "the cutoff is 0.5 where it is missing; see [Masks](#masks)"),
        feature("a negative cutoff", "`alphaCutoff`",
                {with_material({{"alphaMode", "MASK"}, {"alphaCutoff", -1}})},
                refused("alphaCutoff is negative")),
        feature("alpha of opaque materials", "`alphaMode` OPAQUE",
                {with_material({{"alphaMode", "OPAQUE"}, {"alphaCutoff", 0.25}})},
                without_effect(gltf([](Gltf&) {}))),
        feature("blending", "`alphaMode` BLEND", {with_material({{"alphaMode", "BLEND"}})},
                read(material([](const mir::Material& m) {
                    CHECK_FALSE(m.is_masked());
                    CHECK(m.is_blended);
                })),
                "alpha is the covered share of the surface, which alone shines and reflects"),
        feature("any other mode", "`alphaMode`", {with_material({{"alphaMode", "HASH"}})},
                counted({"alphaMode HASH"},
                        material([](const mir::Material& m) { CHECK_FALSE(m.is_blended); })),
                "opaque"),
    };
}

/// The texture under this key of `pbrMetallicRoughness`, or of the material.
inline Build with_texture(const std::string& key, bool of_surface) {
    return [=](Gltf& g) {
        (of_surface ? g.surface() : g.material())[key] = g.texture();
        if (key == "normalTexture") g.material()[key]["scale"] = 0.5;
        if (key == "emissiveTexture") g.material()["emissiveFactor"] = {1, 1, 1};
    };
}

inline Features gltf_textures() {
    const auto has = [](mir::Texture mir::MaterialTextures::*which) {
        return read(
            material([which](const mir::Material& m) { CHECK((m.textures.*which).is_set()); }));
    };
    using T = mir::MaterialTextures;
    return {
        feature("texture of the base colour", "`baseColorTexture`",
                {with_texture("baseColorTexture", true)}, has(&T::base_color),
                "see [Textures](#textures)"),
        feature("texture of metalness and roughness", "`metallicRoughnessTexture`",
                {with_texture("metallicRoughnessTexture", true)}, has(&T::metallic_roughness)),
        feature("normal map", "`normalTexture`, `scale`", {with_texture("normalTexture", false)},
                read(material([](const mir::Material& m) {
                    CHECK(m.textures.normal.is_set());
                    CHECK(m.textures.normal_scale == 0.5f);
                }))),
        feature("texture of the emission", "`emissiveTexture`",
                {with_texture("emissiveTexture", false)}, has(&T::emission)),
        feature("texture of occlusion", "`occlusionTexture`",
                {with_texture("occlusionTexture", false)}, counted({"texture occlusionTexture"}),
                "the picture has the real one"),
        feature("wrapping: repeat, clamp, mirror", "`wrapS`, `wrapT`", {[](Gltf& g) {
                    g.surface()["baseColorTexture"] = g.texture();
                    g.file["textures"][0]["sampler"] = 0;
                    g.file["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}}});
                }},
                read(material([](const mir::Material& m) {
                    CHECK(m.textures.base_color.wrap_u == mir::Wrap::clamp);
                    CHECK(m.textures.base_color.wrap_v == mir::Wrap::mirror);
                }))),
        feature(
            "the nearest texel instead of four", "`magFilter` 9728", {[](Gltf& g) {
                g.surface()["baseColorTexture"] = g.texture();
                g.file["textures"][0]["sampler"] = 0;
                g.file["samplers"] = json::array({{{"magFilter", 9728}}});
            }},
            read(material([](const mir::Material& m) { CHECK(m.textures.base_color.nearest); }))),
        feature(
            "mip maps", "`minFilter`", {[](Gltf& g) {
                g.surface()["baseColorTexture"] = g.texture();
                g.file["textures"][0]["sampler"] = 0;
                g.file["samplers"] = json::array({{{"minFilter", 9987}}});
            }},
            without_effect(gltf([](Gltf& g) { g.surface()["baseColorTexture"] = g.texture(); })),
            "more luxels a pixel filter"),
    };
}

inline Features gltf_coordinates() {
    const Build second = [](Gltf& g) {
        g.surface()["baseColorTexture"] = g.texture();
        g.surface()["baseColorTexture"]["texCoord"] = 1;
        g.attributes()["TEXCOORD_1"] = g.shares<std::uint8_t>(
            {255, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0}, Component::uint8, "VEC2");
        json& accessor = g.file["accessors"][std::size_t{g.attributes()["TEXCOORD_1"]}];
        accessor["count"] = 3;
        g.file["bufferViews"][std::size_t{accessor["bufferView"]}]["byteStride"] = 4;
    };
    return {
        feature("texture coordinates of floats", "`TEXCOORD_0`",
                {with_texture("baseColorTexture", true)}, read(mesh([](const mir::Mesh& m) {
                    CHECK(m.texture_coordinates == std::vector<mir::Vec2>{{0, 1}, {1, 1}, {0, 0}});
                }))),
        feature("a second set, of whole numbers", "`TEXCOORD_1`, `texCoord`, `normalized`",
                {second}, read(mesh([](const mir::Mesh& m) {
                    CHECK(m.texture_coordinates == std::vector<mir::Vec2>{{1, 0}, {1, 0}, {0, 0}});
                }))),
        feature("two sets in one material", "`texCoord`", {[second](Gltf& g) {
                    second(g);
                    g.material()["normalTexture"] = {{"index", 0}};
                }},
                counted({"texture normalTexture on a second set of coordinates"}),
                "the first texture's set is taken"),
        feature("textures without coordinates", "no `TEXCOORD_0`", {[](Gltf& g) {
                    g.surface()["baseColorTexture"] = g.texture();
                    g.attributes().erase("TEXCOORD_0");
                }},
                counted({"textured mesh without texture coordinates"})),
    };
}

inline Feature image(const std::string& name, const std::string& says, const json& from,
                     Outcome outcome, const std::string& words = "") {
    return {name, says, {image_file(from)}, std::move(outcome), words};
}

inline Features gltf_images() {
    const std::string lost = "texture baseColorTexture without a PNG or JPEG image";
    const std::string other = "image that is neither PNG nor JPEG";
    const auto texels = [](const std::vector<std::uint32_t>& expected) {
        return read([expected](const mir::LoadedScene& loaded) {
            CHECK(loaded.scene.images.at(0).texels == expected);
        });
    };
    const auto data = [](const std::string& type, const std::string& base64) {
        return json{{"uri", "data:image/" + type + ";base64," + base64}};
    };
    const Build in_view = [](Gltf& g) {
        const auto at = g.view(small_png());
        g.surface()["baseColorTexture"] =
            g.texture({{"bufferView", at}, {"mimeType", "image/png"}});
    };
    Features all = {
        image("PNG of 8 bits", "image", data("png", png8),
              texels({0xff0000ff, 0xff00ff00, 0xffff0000, 0x80ffffff})),
        image("PNG of 16 bits", "image", data("png", png16), texels({0xff0180ff}), "as 8 bits"),
        image("JPEG", "image", data("jpeg", jpeg), texels({0xff808080})),
        feature("images in buffers", "`bufferView`", {in_view},
                read([](const mir::LoadedScene& loaded) {
                    CHECK(loaded.scene.images.at(0).width == 1);
                })),
        feature(
            "images in files", "`uri`", {[](Gltf& g) {
                g.beside["a b.png"] = small_png();
                g.surface()["baseColorTexture"] = g.texture({{"uri", "a%20b.png"}});
            }},
            read([](const mir::LoadedScene& loaded) { CHECK(loaded.scene.images.size() == 1); })),
        image("WebP", "image", data("webp", "UklGRhoAAABXRUJQVlA4TA0AAAAvAAAAEAcQERGIiP4HAA=="),
              counted({other, lost})),
        image("KTX2", "image", data("ktx2", "q0tUWCAyMLsNChoK"), counted({other, lost})),
        image("DDS", "image", data("vnd-ms.dds", "RERTIHwAAAA="), counted({other, lost})),
        image("images that are missing", "`uri`", {{"uri", "no.png"}},
              counted({"image 'no.png' (not found)", lost})),
        image("images elsewhere", "`uri` with `http:`", {{"uri", "http://x/a.png"}},
              counted({"image 'http://x/a.png' (only files beside the scene are read)", lost})),
        image("broken images", "image", data("png", png8.substr(0, 60)),
              refused("image 0: it is no image")),
    };
    const Build outside = [](Gltf& g) {
        g.beside["../a.png"] = small_png();
        g.surface()["baseColorTexture"] = g.texture({{"uri", "../a.png"}});
    };
    all.push_back(feature("images outside of the folder", "`uri`", {outside},
                          counted({"image outside of the scene's folder", lost}),
                          "see [Files](#files-beside-the-scene)"));
    return all;
}

inline Features gltf_appearance() {
    Features all = gltf_factors();
    append(all, gltf_alpha());
    append(all, gltf_textures());
    append(all, gltf_coordinates());
    append(all, gltf_images());
    return all;
}

}  // namespace mirtest::features
