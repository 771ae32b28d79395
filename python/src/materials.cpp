// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "errors.hpp"
#include "scene.hpp"
#include "triples.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <limits>
#include <optional>

namespace nb = nanobind;

namespace mirpy {
namespace {

void check_share(float value, const char* place) {
    if (!(value >= 0.0f && value <= 1.0f)) throw ArgumentError(place, "give a number of 0 to 1");
}

mir::Rgb shares_of(nb::handle value, const char* place) {
    const mir::Rgb color = rgb_of(value, place);
    for (const float c : {color.r, color.g, color.b}) check_share(c, place);
    return color;
}

mir::Wrap wrap_of(const std::string& name) {
    if (name == "repeat") return mir::Wrap::repeat;
    if (name == "clamp") return mir::Wrap::clamp;
    if (name == "mirror") return mir::Wrap::mirror;
    throw ArgumentError("wrap", "'" + name + "' is unknown; choose one of clamp|mirror|repeat");
}

using ImageIndex = std::optional<std::uint32_t>;

/// How the images of one material are looked up.
struct Lookup {
    std::size_t images;
    mir::Wrap wrap;
    bool nearest;

    [[nodiscard]] mir::Texture texture(const ImageIndex& image, const char* place) const {
        mir::Texture t;
        if (!image) return t;
        if (*image >= images)
            throw ArgumentError(place, "there is no image " + std::to_string(*image) +
                                           "; give what add_image() returned");
        t.image = *image;
        t.wrap_u = t.wrap_v = wrap;
        t.nearest = nearest;
        return t;
    }
};

std::uint32_t add_material(
    PyScene& self, const std::string& name, nb::handle base_color, float metallic, float roughness,
    float specular, float ior, nb::handle emission, bool emits_from_both_sides,
    std::uint16_t light_group, float alpha, bool blend, float alpha_cutoff, float transmission,
    bool thin, nb::handle attenuation_color, float attenuation_distance, float clearcoat,
    float clearcoat_roughness, float diffuse_transmission, nb::handle diffuse_transmission_color,
    const ImageIndex& base_color_image, const ImageIndex& metallic_roughness_image,
    const ImageIndex& normal_image, const ImageIndex& emission_image,
    const ImageIndex& transmission_image, const ImageIndex& clearcoat_image,
    const ImageIndex& clearcoat_roughness_image, const ImageIndex& diffuse_transmission_image,
    const ImageIndex& diffuse_transmission_color_image, float normal_scale, const std::string& wrap,
    bool nearest) {
    mir::Material m;
    m.name = name;
    m.base_color = shares_of(base_color, "base_color");
    check_share(m.metallic = metallic, "metallic");
    check_share(m.roughness = roughness, "roughness");
    check_share(m.specular = specular, "specular");
    if (!(ior >= 1.0f) || std::isinf(ior)) throw ArgumentError("ior", "give a number from 1 up");
    m.ior = ior;
    m.emission = light_of(emission, "emission");
    m.emits_from_both_sides = emits_from_both_sides;
    m.light_group = light_group;
    check_share(m.alpha = alpha, "alpha");
    m.is_blended = blend;
    check_share(m.alpha_cutoff = alpha_cutoff, "alpha_cutoff");
    check_share(m.transmission = transmission, "transmission");
    m.is_thin = thin;
    m.attenuation_color = shares_of(attenuation_color, "attenuation_color");
    if (!(attenuation_distance > 0.0f))
        throw ArgumentError("attenuation_distance", "give metres above 0, or infinity");
    m.attenuation_distance = attenuation_distance;
    check_share(m.clearcoat = clearcoat, "clearcoat");
    check_share(m.clearcoat_roughness = clearcoat_roughness, "clearcoat_roughness");
    check_share(m.diffuse_transmission = diffuse_transmission, "diffuse_transmission");
    m.diffuse_transmission_color =
        shares_of(diffuse_transmission_color, "diffuse_transmission_color");
    const Lookup lookup{self.scene().images.size(), wrap_of(wrap), nearest};
    m.textures.base_color = lookup.texture(base_color_image, "base_color_image");
    m.textures.metallic_roughness =
        lookup.texture(metallic_roughness_image, "metallic_roughness_image");
    m.textures.normal = lookup.texture(normal_image, "normal_image");
    m.textures.emission = lookup.texture(emission_image, "emission_image");
    m.textures.transmission = lookup.texture(transmission_image, "transmission_image");
    m.textures.clearcoat = lookup.texture(clearcoat_image, "clearcoat_image");
    m.textures.clearcoat_roughness =
        lookup.texture(clearcoat_roughness_image, "clearcoat_roughness_image");
    m.textures.diffuse_transmission =
        lookup.texture(diffuse_transmission_image, "diffuse_transmission_image");
    m.textures.diffuse_transmission_color =
        lookup.texture(diffuse_transmission_color_image, "diffuse_transmission_color_image");
    m.textures.normal_scale = normal_scale;
    return self.edit().add(std::move(m));
}

std::uint32_t add_image(PyScene& self, nb::handle pixels, const std::string& name) {
    const auto bytes = byte_array(pixels, "pixels", {any_size, any_size, any_size});
    const std::size_t channels = bytes.shape(2);
    if (channels != 3 && channels != 4)
        throw ArgumentError(
            "pixels", "it has " + std::to_string(channels) + " channels; give 3, or 4 with alpha");
    constexpr std::size_t most = 65536;
    for (const std::size_t side : {bytes.shape(0), bytes.shape(1)})
        if (side < 1 || side > most)
            throw ArgumentError("pixels",
                                "a side has " + std::to_string(side) + " pixels; give 1 to 65536");
    mir::TextureImage image;
    image.name = name;
    image.height = static_cast<std::uint32_t>(bytes.shape(0));
    image.width = static_cast<std::uint32_t>(bytes.shape(1));
    image.texels.reserve(bytes.shape(0) * bytes.shape(1));
    const auto* at = static_cast<const std::uint8_t*>(bytes.data());
    for (std::size_t i = 0; i < bytes.shape(0) * bytes.shape(1); ++i, at += channels)
        image.texels.push_back(at[0] | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16 |
                               (channels == 4 ? std::uint32_t{at[3]} : 0xFFu) << 24);
    mir::Scene& scene = self.edit();
    scene.images.push_back(std::move(image));
    return static_cast<std::uint32_t>(scene.images.size() - 1);
}

}  // namespace

void bind_materials(nb::class_<PyScene>& scene) {
    const auto black = nb::make_tuple(0.0, 0.0, 0.0);
    const auto grey = nb::make_tuple(0.8, 0.8, 0.8);
    const auto white = nb::make_tuple(1.0, 1.0, 1.0);
    scene
        .def("add_material", add_material, nb::kw_only(), nb::arg("name") = "",
             nb::arg("base_color") = grey, nb::arg("metallic") = 0.0f, nb::arg("roughness") = 1.0f,
             nb::arg("specular") = 1.0f, nb::arg("ior") = 1.5f, nb::arg("emission") = black,
             nb::arg("emits_from_both_sides") = false, nb::arg("light_group") = 0,
             nb::arg("alpha") = 1.0f, nb::arg("blend") = false, nb::arg("alpha_cutoff") = 0.0f,
             nb::arg("transmission") = 0.0f, nb::arg("thin") = true,
             nb::arg("attenuation_color") = white,
             nb::arg("attenuation_distance") = std::numeric_limits<float>::infinity(),
             nb::arg("clearcoat") = 0.0f, nb::arg("clearcoat_roughness") = 0.0f,
             nb::arg("diffuse_transmission") = 0.0f, nb::arg("diffuse_transmission_color") = white,
             nb::arg("base_color_image") = nb::none(),
             nb::arg("metallic_roughness_image") = nb::none(), nb::arg("normal_image") = nb::none(),
             nb::arg("emission_image") = nb::none(), nb::arg("transmission_image") = nb::none(),
             nb::arg("clearcoat_image") = nb::none(),
             nb::arg("clearcoat_roughness_image") = nb::none(),
             nb::arg("diffuse_transmission_image") = nb::none(),
             nb::arg("diffuse_transmission_color_image") = nb::none(),
             nb::arg("normal_scale") = 1.0f, nb::arg("wrap") = "repeat", nb::arg("nearest") = false,
             "Adds a material in glTF's metallic-roughness parameters; returns its index.\n\n"
             "base_color: three of 0..1, linear Rec. 709. metallic, roughness, specular: 0..1;\n"
             "specular=0 with metallic=0 is purely Lambertian. emission: radiance of the front,\n"
             "W m^-2 sr^-1. Images are what add_image() returned; they multiply.\n\n"
             "alpha: 0..1, times that of the base colour's image; with blend=True the covered\n"
             "share of the surface. Where it is below alpha_cutoff, there is a hole.\n\n"
             "transmission: 0..1, share of the light below the interface that goes through. thin:\n"
             "a sheet, which light leaves as it came; else the surface of a body, which refracts\n"
             "by ior and leaves attenuation_color of the light after attenuation_distance, m.\n\n"
             "clearcoat: 0..1, weight of a second, colourless interface on top, with a roughness\n"
             "of its own; not on glass.\n\n"
             "diffuse_transmission: 0..1, share of what would be reflected diffusely that goes\n"
             "through instead, spread in all directions and tinted: leaves, paper.\n\n"
             "Of images red multiplies transmission and clearcoat, green clearcoat_roughness, and\n"
             "alpha diffuse_transmission.")
        .def("add_image", add_image, nb::arg("pixels").none(), nb::arg("name") = "",
             "Adds a picture for textures; returns its index.\n\n"
             "pixels: (height, width, 3 or 4) of uint8, the top row first; sRGB where a colour\n"
             "is meant, linear alpha.");
}

}  // namespace mirpy
