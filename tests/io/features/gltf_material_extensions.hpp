// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/gltf_file.hpp"

#include <string>
#include <utility>
#include <vector>

namespace mirtest::features {

/// The outcome of an extension that may be required as well as used.
inline Extension extension(const std::string& name, const std::string& about, const Build& build,
                           const Outcome& outcome, const std::string& words = "") {
    const auto made = [&](bool required) {
        return gltf([&](Gltf& g) {
            build(g);
            g.use(name);
            if (required) g.file["extensionsRequired"] = json::array({name});
        });
    };
    return {"`" + name + "`", about, made(false), made(true), outcome, outcome, words};
}

/// One that cannot be read without.
inline Extension optional_alone(const std::string& name, const std::string& about,
                                const Build& build, const Outcome& outcome,
                                const std::string& words = "") {
    Extension to = extension(name, about, build, outcome, words);
    to.when_required =
        refused("the file cannot be read without '" + name + "'", mir::ErrorCode::unsupported);
    return to;
}

/// One that makes no difference.
inline Extension of_no_effect(const std::string& name, const std::string& about, const Build& build,
                              const Build& plain, const std::string& words = "") {
    return extension(name, about, build, without_effect(gltf(plain)), words);
}

inline void plain_triangle(Gltf&) {}

/// These values under the extension of the material.
inline Build of_material(const std::string& name, const json& values = json::object()) {
    return [=](Gltf& g) { g.material()["extensions"][name] = values; };
}

/// The same with textures.
inline Build textured(const std::string& name, const json& values,
                      const std::vector<std::string>& textures) {
    return [=](Gltf& g) {
        json& to = g.material()["extensions"][name] = values;
        for (const std::string& texture : textures) to[texture] = g.texture();
    };
}

inline std::vector<Extension> read_materials() {
    const auto ior = [](float value) {
        return [value](const mir::Material& m) { CHECK(m.ior == value); };
    };
    const Build bright = [](Gltf& g) {
        g.material() = {{"emissiveFactor", {1, 0.5, 0}}};
        g.material()["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 4}};
    };
    const Build unlit = [](Gltf& g) {
        g.surface()["baseColorFactor"] = {1, 0.5, 0, 1};
        g.material()["extensions"]["KHR_materials_unlit"] = json::object();
    };
    const Build varied = [unlit](Gltf& g) {
        unlit(g);
        g.attributes()["COLOR_0"] = g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    };
    const auto orange = material([](const mir::Material& m) {
        CHECK(m.emission == mir::Rgb{1.0f, 0.5f, 0.0f});
        CHECK(m.is_lambertian());
    });
    return {
        extension("KHR_materials_emissive_strength", "`emissiveStrength`", bright,
                  read(material([](const mir::Material& m) {
                      CHECK(m.emission == mir::Rgb{4.0f, 2.0f, 0.0f});
                  }))),
        extension("KHR_materials_ior", "`ior`", of_material("KHR_materials_ior", {{"ior", 1.25}}),
                  read(material(ior(1.25f)))),
        extension("KHR_materials_ior", "an `ior` of 0",
                  of_material("KHR_materials_ior", {{"ior", 0}}),
                  counted({"KHR_materials_ior of 0 (taken as 1.5)"}, material(ior(1.5f)))),
        extension("KHR_materials_ior", "an `ior` below 1",
                  of_material("KHR_materials_ior", {{"ior", 0.5}}),
                  refused("its index of refraction is below 1")),
        extension("KHR_materials_specular", "`specularFactor`",
                  of_material("KHR_materials_specular", {{"specularFactor", 0.25}}),
                  read(material([](const mir::Material& m) { CHECK(m.specular == 0.25f); }))),
        extension("KHR_materials_specular", "`specularColorFactor`",
                  of_material("KHR_materials_specular", {{"specularColorFactor", {1, 0, 0}}}),
                  counted({"KHR_materials_specular specularColorFactor"}), "white"),
        extension("KHR_materials_specular", "`specularTexture`, `specularColorTexture`",
                  of_material("KHR_materials_specular", {{"specularTexture", {{"index", 0}}},
                                                         {"specularColorTexture", {{"index", 0}}}}),
                  counted({"texture specularColorTexture", "texture specularTexture"})),
        extension(
            "KHR_materials_unlit", "", unlit, read(orange),
            "reflects nothing and shines with its base colour as radiance, W m⁻² sr⁻¹, which "
            "lights what is around. A vertex colour multiplies it if a primitive has only one"),
        extension("KHR_materials_unlit", "vertex colours that differ", varied,
                  counted({"COLOR_0 of an unlit material"}, orange), "white"),
        extension("KHR_materials_transmission", "`transmissionFactor`, `transmissionTexture`",
                  textured("KHR_materials_transmission", {{"transmissionFactor", 0.5}},
                           {"transmissionTexture"}),
                  read(material([](const mir::Material& m) {
                      CHECK(m.transmission == 0.5f);
                      CHECK(m.is_thin);
                      CHECK(m.textures.transmission.is_set());
                  })),
                  "glass, a sheet without `KHR_materials_volume`"),
        extension("KHR_materials_clearcoat",
                  "`clearcoatFactor`, `clearcoatRoughnessFactor`, `clearcoatTexture`, "
                  "`clearcoatRoughnessTexture`",
                  textured("KHR_materials_clearcoat",
                           {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.25}},
                           {"clearcoatTexture", "clearcoatRoughnessTexture"}),
                  read(material([](const mir::Material& m) {
                      CHECK(m.clearcoat == 0.75f);
                      CHECK(m.clearcoat_roughness == 0.25f);
                      CHECK(m.textures.clearcoat.is_set());
                      CHECK(m.textures.clearcoat_roughness.is_set());
                  })),
                  "a second interface on top, without the normal texture"),
        extension("KHR_materials_clearcoat", "`clearcoatNormalTexture`",
                  of_material("KHR_materials_clearcoat",
                              {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}}}}),
                  counted({"texture clearcoatNormalTexture"})),
        extension(
            "KHR_materials_clearcoat", "on glass",
            [](Gltf& g) {
                json& all = g.material()["extensions"];
                all["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
                all["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1}};
            },
            counted({"KHR_materials_clearcoat on glass"}), "no coat"),
        extension("KHR_materials_diffuse_transmission",
                  "`diffuseTransmissionFactor`, `diffuseTransmissionColorFactor`, "
                  "`diffuseTransmissionTexture`, `diffuseTransmissionColorTexture`",
                  textured("KHR_materials_diffuse_transmission",
                           {{"diffuseTransmissionFactor", 0.5},
                            {"diffuseTransmissionColorFactor", {1, 0.5, 0.25}}},
                           {"diffuseTransmissionTexture", "diffuseTransmissionColorTexture"}),
                  read(material([](const mir::Material& m) {
                      CHECK(m.diffuse_transmission == 0.5f);
                      CHECK(m.diffuse_transmission_color == mir::Rgb{1.0f, 0.5f, 0.25f});
                      CHECK(m.textures.diffuse_transmission.is_set());
                      CHECK(m.textures.diffuse_transmission_color.is_set());
                  })),
                  "leaves, paper, lampshades: light comes out of the other side in all directions"),
        extension(
            "KHR_materials_diffuse_transmission", "of a body (`KHR_materials_volume`)",
            [](Gltf& g) {
                g.surface()["metallicFactor"] = 0;
                json& all = g.material()["extensions"];
                all["KHR_materials_volume"] = {{"thicknessFactor", 0.1}};
                all["KHR_materials_diffuse_transmission"] = {{"diffuseTransmissionFactor", 1}};
            },
            counted({"KHR_materials_volume of diffuse transmission"}),
            "as of a sheet: the body takes no light away"),
        extension("KHR_materials_volume",
                  "`thicknessFactor`, `thicknessTexture`, `attenuationDistance`, "
                  "`attenuationColor`",
                  of_material("KHR_materials_volume", {{"thicknessFactor", 0.1},
                                                       {"thicknessTexture", {{"index", 0}}},
                                                       {"attenuationDistance", 2},
                                                       {"attenuationColor", {1, 0.5, 0.25}}}),
                  counted({"texture thicknessTexture"}, material([](const mir::Material& m) {
                              CHECK_FALSE(m.is_thin);
                              CHECK(m.attenuation_distance == 2.0f);
                              CHECK(m.attenuation_color == mir::Rgb{1.0f, 0.5f, 0.25f});
                          })),
                  "a thickness above 0 makes glass a body; rays find how thick it is"),
        extension("KHR_materials_pbrSpecularGlossiness",
                  "`diffuseFactor`, `glossinessFactor`, `diffuseTexture`, "
                  "`specularGlossinessTexture`",
                  of_material("KHR_materials_pbrSpecularGlossiness",
                              {{"diffuseFactor", {1, 0.5, 0, 1}},
                               {"glossinessFactor", 0.75},
                               {"diffuseTexture", {{"index", 0}}},
                               {"specularGlossinessTexture", {{"index", 0}}}}),
                  counted({"KHR_materials_pbrSpecularGlossiness specularFactor",
                           "texture diffuseTexture", "texture specularGlossinessTexture"},
                          material([](const mir::Material& m) {
                              CHECK(m.base_color == mir::Rgb{1.0f, 0.5f, 0.0f});
                              CHECK(m.roughness == 0.25f);
                              CHECK(m.metallic == 0.0f);
                          })),
                  "both factors are read as of a dielectric; specular colour white"),
    };
}

/// Extensions of materials that are counted as a whole.
inline std::vector<Extension> counted_materials() {
    const std::vector<std::pair<const char*, const char*>> names = {
        {"KHR_materials_anisotropy", "highlights drawn out"},
        {"KHR_materials_dispersion", "colours of glass"},
        {"KHR_materials_iridescence", "thin films"},
        {"KHR_materials_sheen", "cloth"},
        {"KHR_materials_volume_scatter", "wax and milk"}};
    std::vector<Extension> all;
    for (const auto& [name, about] : names)
        all.push_back(
            extension(name, about, of_material(name), counted({name}, triangles(1)), "ignored"));
    const Build variants = [](Gltf& g) {
        g.file["extensions"]["KHR_materials_variants"] = {
            {"variants", json::array({{{"name", "red"}}})}};
        g.primitive()["extensions"]["KHR_materials_variants"] = {{"mappings", json::array()}};
    };
    all.push_back(extension("KHR_materials_variants", "materials to choose from", variants,
                            counted({"KHR_materials_variants"}, triangles(1)),
                            "the primitive's own material"));
    return all;
}

}  // namespace mirtest::features
