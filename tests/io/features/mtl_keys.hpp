// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/data_uri.hpp"
#include "io/features/gltf_file.hpp"
#include "io/features/obj_statements.hpp"

#include <string>
#include <utility>
#include <vector>

namespace mirtest::features {

/// 2 x 2 texels.
inline std::string large_png() {
    const auto bytes = mir::detail::data_uri_bytes("data:image/png;base64," + png8, "image");
    return {bytes.begin(), bytes.end()};
}

/// A textured square of a material with these lines. Beside it lie images.
inline Files mtl(const std::string& lines) {
    return obj(obj_directions + "mtllib a.mtl\nusemtl a\nf 1/1 2/2 3/3\n",
               {{"a.mtl", "newmtl a\n" + lines},
                {"a.png", small_png()},
                {"my c.png", small_png()},
                {"large.png", large_png()},
                {"broken.png", small_png().substr(0, 40)},
                {"a.webp", "RIFF....WEBPVP8 "}});
}

inline Feature key(std::string name, std::string says, const std::vector<std::string>& variants,
                   Outcome outcome, std::string words = "") {
    Feature to{std::move(name), std::move(says), {}, std::move(outcome), std::move(words)};
    for (const std::string& lines : variants) to.variants.push_back(mtl(lines + "\n"));
    return to;
}

inline Outcome mtl_lost(const std::string& keyword) { return counted({"MTL '" + keyword + "'"}); }

inline Features mtl_colors() {
    const auto specular = [](float weight) {
        return material([weight](const mir::Material& m) { CHECK(m.specular == Approx(weight)); });
    };
    return {
        key("base colour", "`Kd`", {"Kd 1 0.5 0.25"}, read(material([](const mir::Material& m) {
                CHECK(m.base_color == mir::Rgb{1, 0.5f, 0.25f});
            }))),
        key("one number for three", "`Kd`, `Ke`, `Ks`, `Tf`", {"Kd 0.5"},
            read(material([](const mir::Material& m) {
                CHECK(m.base_color == mir::Rgb{0.5f, 0.5f, 0.5f});
            }))),
        key("colours of two numbers", "`Kd`, `Ke`, `Ks`, `Tf`", {"Kd 1 1", "Tf 0 0"},
            refused("has 2 numbers")),
        key("colours outside 0..1", "`Kd`, `Ks`", {"Kd 2 0 0"},
            counted({"Kd outside 0..1 (clamped)"})),
        key("spectra and CIE colours", "for instance `Kd xyz`, `Ks spectral`",
            {"Kd xyz 1 1 1\nKs spectral a.rfl"}, counted({"MTL 'Kd xyz'", "MTL 'Ks spectral'"})),
        key("emission", "`Ke`", {"Ke 4 2 1"}, read(material([](const mir::Material& m) {
                CHECK(m.emission == mir::Rgb{4, 2, 1});
                CHECK_FALSE(m.emits_from_both_sides);
            })),
            "radiance of the front"),
        key("negative emission", "`Ke`", {"Ke -1 0 0"}, refused("Ke is negative")),
        key("specular colour", "`Ks`", {"Ks 0.5 0.5 0.5", "illum 2\nKs 0.5"}, read(specular(0.5f)),
            "weighs the dielectric interface (`specular`)"),
        key("specular colours that differ", "`Ks`", {"Ks 0.75 0.5 0.25"},
            counted({"colour of Ks (its mean is used)"}, specular(0.5f))),
        key("specular exponent", "`Ns`", {"Ks 1\nNs 30"},
            read(material([](const mir::Material& m) { CHECK(m.roughness == 0.5f); })),
            "roughness of the GGX lobe of equal width: ∜(2 / (Ns + 2))"),
        key("a negative exponent", "`Ns`", {"Ns -1"}, refused("Ns is negative")),
        key("index of refraction", "`Ni`", {"Ni 1.25"},
            read(material([](const mir::Material& m) { CHECK(m.ior == 1.25f); }))),
        key("an index of 1 or less", "`Ni`", {"Ni 1", "Ni 0"},
            read(material([](const mir::Material& m) { CHECK(m.ior == 1.5f); })),
            "taken as 1.5: exporters write it for none"),
        key("ambient colour, sharpness of reflections", "`Ka`, `map_Ka`, `sharpness`",
            {"Ka 1 1 1", "map_Ka a.png", "sharpness 60"}, without_effect(mtl("")),
            "light from around is computed"),
        key("keywords with nothing behind them", "for instance `Kd`", {"Kd"},
            counted({"MTL 'Kd' without a value"}), "ignored"),
        key("numbers that are none", "for instance `Ns x`", {"Ns x"},
            refused("a.mtl, line 2: Ns is no number")),
    };
}

inline Features mtl_models() {
    const auto is_matte = material([](const mir::Material& m) { CHECK(m.is_lambertian()); });
    return {
        key("colour without highlights", "`illum` 0, 1", {"Ks 1\nillum 0", "Ks 1\nillum 1"},
            read(is_matte), "no interface, whatever `Ks` says"),
        key("highlights, reflections", "`illum` 2, 3, 5, 8",
            {"Ks 1\nillum 2", "Ks 1\nillum 3", "Ks 1\nillum 5", "Ks 1\nillum 8"},
            read(material([](const mir::Material& m) { CHECK(m.specular == 1.0f); })),
            "by `Ks` and `Ns`"),
        key("glass", "`illum` 4, 6, 7, 9",
            {"illum 4\nNi 1.5", "illum 6\nNi 1.5", "illum 7\nNi 1.5", "illum 9\nTf 1 0.5 1"},
            read(material([](const mir::Material& m) { CHECK(m.transmission == 1.0f); })),
            "with `Ni` above 1 or a coloured `Tf`, which tints; smooth without `Pr`; 6 and 7 are "
            "bodies, "
            "the others sheets"),
        key("surfaces that only catch shadows", "`illum` 10", {"illum 10"},
            counted({"illum 10 (shadows on what is not seen)"}), "seen like any other"),
        key("filter of what shines through", "`Tf`, `Kt`", {"Tf 0.5 1 1", "Kt 0.5 1 1"},
            counted({"Tf without a model of glass"}), "read of glass alone; `1 1 1` means none"),
        key("opacity, transparency", "`d`, `Tr`", {"d 0.5", "Tr 0.5", "d 0.5\nTr 0"},
            read(material([](const mir::Material& m) {
                CHECK(m.is_blended);
                CHECK(m.alpha == 0.5f);
            })),
            "the covered share; `d` before `Tr`; not of glass"),
        key("opacity that is full", "`d 1`, `Tr 0`", {"d 1", "Tr 0", "d 1\nTr 1"},
            without_effect(mtl(""))),
        key("opacity towards the rim", "`d -halo`", {"d -halo 1"}, counted({"MTL option '-halo'"}),
            "as `d`"),
        key("roughness, metalness", "`Pr`, `Pm`", {"Pr 0.25\nPm 0.5\nNs 30"},
            read(material([](const mir::Material& m) {
                CHECK(m.roughness == 0.25f);
                CHECK(m.metallic == 0.5f);
                CHECK(m.specular == 1.0f);
            })),
            "`Pr` before `Ns`; with either and no `Ks` the interface has weight 1"),
        key("sheen", "`Ps`", {"Ps 1"}, mtl_lost("Ps")),
        key("clearcoat", "`Pc`, `Pcr`", {"Pc 1\nPcr 0.5"},
            read(material([](const mir::Material& m) {
                CHECK(m.clearcoat == 1.0f);
                CHECK(m.clearcoat_roughness == 0.5f);
            })),
            "weight and roughness of a second interface; not on glass"),
        key("anisotropy", "`aniso`, `anisor`", {"aniso 1\nanisor 0.5"},
            counted({"MTL 'aniso'", "MTL 'anisor'"})),
        key("any other keyword", "for instance `Km`", {"Km 1"}, mtl_lost("Km")),
    };
}

inline Features mtl_textures() {
    const auto has = [](mir::Texture mir::MaterialTextures::*which) {
        return read(
            material([which](const mir::Material& m) { CHECK((m.textures.*which).is_set()); }));
    };
    using T = mir::MaterialTextures;
    return {
        key("texture of the base colour", "`map_Kd`", {"map_Kd a.png", "map_Kd my c.png"},
            read(material([](const mir::Material& m) {
                CHECK(m.textures.base_color.is_set());
                CHECK(m.base_color == mir::Rgb{1, 1, 1});
            })),
            "sRGB; multiplies `Kd`, else white; names may hold blanks"),
        key("texture of the emission", "`map_Ke`", {"map_Ke a.png"},
            read(material([](const mir::Material& m) {
                CHECK(m.textures.emission.is_set());
                CHECK(m.emission == mir::Rgb{1, 1, 1});
            })),
            "sRGB; multiplies `Ke`, else 1 W m⁻² sr⁻¹"),
        key("normal map", "`norm`, `-bm`", {"norm a.png", "norm -bm 0.5 a.png"}, has(&T::normal),
            "`-bm` is its scale"),
        key("texture of the opacity", "`map_d`, `-imfchan`", {"map_d -imfchan r a.png"},
            read(material([](const mir::Material& m) { CHECK(m.alpha_cutoff == 0.5f); })),
            "[mask](#masks), cutoff 0.5, of the image's alpha, else brightness; `-imfchan r`, `g`, "
            "`b`, `m` (alpha) or `l` (brightness) chooses"),
        key("an opacity that lies otherwise than the colour", "`map_d`, `map_Kd`",
            {"map_Kd a.png\nmap_d -s 2 2 a.png"},
            counted({"map_d with other options than map_Kd"})),
        key("an opacity of another size than the colour", "`map_d`, `map_Kd`",
            {"map_Kd a.png\nmap_d large.png"}, counted({"map_d of another size than map_Kd"})),
        key("height maps", "`map_Bump`, `map_bump`, `bump`",
            {"map_Bump a.png\nmap_bump a.png\nbump a.png"},
            counted({"MTL 'bump'", "MTL 'map_Bump'", "MTL 'map_bump'"})),
        key("textures of the interface", "`map_Ks`, `map_Ns`", {"map_Ks a.png\nmap_Ns a.png"},
            counted({"MTL 'map_Ks'", "MTL 'map_Ns'"})),
        key("textures of roughness, metalness, sheen", "`map_Pr`, `map_Pm`, `map_Ps`",
            {"map_Pr a.png\nmap_Pm a.png\nmap_Ps a.png"},
            counted({"MTL 'map_Pm'", "MTL 'map_Pr'", "MTL 'map_Ps'"})),
        key("displacement, decals, pictures of what is reflected", "`disp`, `decal`, `refl`",
            {"disp a.png\ndecal a.png\nrefl -type sphere a.png"},
            counted({"MTL 'decal'", "MTL 'disp'", "MTL 'refl'"})),
    };
}

inline Features mtl_images() {
    const auto placed = [](const std::function<void(const mir::Texture&)>& look) {
        return read(material([look](const mir::Material& m) { look(m.textures.base_color); }));
    };
    Features all = {
        key("scale and offset", "`-s`, `-o`", {"map_Kd -s 2 4 -o 0.25 0.5 a.png"},
            placed([](const mir::Texture& t) {
                CHECK(t.u_axis.x == 2.0f);
                CHECK(t.offset.x == 0.25f);
            }),
            "lookups at (s u + o, s v + o), v from below"),
        key("clamping", "`-clamp`", {"map_Kd -clamp on a.png"},
            placed([](const mir::Texture& t) { CHECK(t.wrap_u == mir::Wrap::clamp); }),
            "`on` clamps to the edge, else images repeat"),
        key("any other option", "for instance `-blendu`, `-boost`, `-mm`, `-t`, `-texres`",
            {"map_Kd -blendu off -boost 2 -mm 0 1 -t 1 1 1 -texres 8 a.png"},
            counted(
                {"MTL option '-blendu'", "MTL option '-boost'", "MTL option '-mm'",
                 "MTL option '-t'", "MTL option '-texres'"},
                material([](const mir::Material& m) { CHECK(m.textures.base_color.is_set()); }))),
        key("images that are missing", "`map_Kd`", {"map_Kd none.png"},
            counted({"image 'none.png' (not found)"})),
        key("images outside of the folder", "`map_Kd`", {"map_Kd ../a.png"},
            counted({"image '../a.png' (outside of the folder of the OBJ file)"}),
            "see [OBJ and MTL](#obj-and-mtl)"),
        key("images neither PNG nor JPEG", "`map_Kd`", {"map_Kd a.webp"},
            counted({"image that is neither PNG nor JPEG"})),
        key("broken images", "`map_Kd`", {"map_Kd broken.png"}, refused("it cannot be decoded")),
    };
    const std::string bare = "mtllib a.mtl\nusemtl a\nf 1 2 3\n";
    all.push_back({"textures without coordinates",
                   "`f 1 2 3`",
                   {obj(bare, {{"a.mtl", "newmtl a\nmap_Kd a.png\n"}, {"a.png", small_png()}})},
                   counted({"textured corner without texture coordinates"}),
                   ""});
    return all;
}

inline Features mtl_keys() {
    Features all = mtl_colors();
    append(all, mtl_models());
    append(all, mtl_textures());
    append(all, mtl_images());
    return all;
}

}  // namespace mirtest::features
