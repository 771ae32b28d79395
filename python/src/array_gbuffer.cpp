// SPDX-License-Identifier: MIT
#include "array_gbuffer.hpp"

#include "errors.hpp"

#include <algorithm>
#include <iterator>

namespace nb = nanobind;

namespace mirpy {
namespace {

constexpr const char* names[] = {"position", "normal",    "shading_normal", "view",    "eye",
                                 "albedo",   "roughness", "metallic",       "specular"};

/// A mapping after its names were looked at.
nb::handle with_known_names(nb::handle mapping) {
    if (!nb::isinstance<nb::dict>(mapping))
        throw ArgumentError("gbuffer", "it is no dictionary of arrays; give one");
    for (const auto [key, value] : nb::borrow<nb::dict>(mapping)) {
        const std::string name = nb::str(key).c_str();
        // What gbuffer() tells besides is of no use here.
        if (name == "emission") continue;
        if (std::find(std::begin(names), std::end(names), name) == std::end(names))
            throw ArgumentError(
                "gbuffer", "it has an array '" + name + "', which means nothing; leave it out");
    }
    return mapping;
}

std::optional<FloatArray> optional_array(nb::handle mapping, const char* name,
                                         std::initializer_list<long> shape) {
    const nb::handle found = PyDict_GetItemString(mapping.ptr(), name);
    if (!found.is_valid() || found.is_none()) return std::nullopt;
    return FloatArray(found, "gbuffer." + std::string(name), shape, Numbers::single_floats);
}

FloatArray needed_array(nb::handle mapping, const char* name, std::initializer_list<long> shape) {
    std::optional<FloatArray> found = optional_array(mapping, name, shape);
    if (!found)
        throw ArgumentError("gbuffer." + std::string(name),
                            "it is missing; give " + shape_text(shape) + " floats");
    return *std::move(found);
}

mir::Vec3 triple(const FloatArray& a, std::size_t y, std::size_t x) {
    return {a.at(y, x, 0), a.at(y, x, 1), a.at(y, x, 2)};
}

}  // namespace

GBufferArrays::GBufferArrays(nb::handle mapping)
    : position(needed_array(with_known_names(mapping), "position", {any_size, any_size, 3})),
      normal(needed_array(mapping, "normal", {any_size, any_size, 3})),
      albedo(needed_array(mapping, "albedo", {any_size, any_size, 3})) {
    const auto h = static_cast<long>(position.size(0));
    const auto w = static_cast<long>(position.size(1));
    if (h == 0 || w == 0) throw ArgumentError("gbuffer.position", "it has no pixels; give some");
    for (const FloatArray* other : {&normal, &albedo})
        if (other->size(0) != position.size(0) || other->size(1) != position.size(1))
            throw ArgumentError(
                "gbuffer", "its arrays differ in size; give " + shape_text({h, w, 3}) + " each");
    shading_normal = optional_array(mapping, "shading_normal", {h, w, 3});
    view = optional_array(mapping, "view", {h, w, 3});
    eye = optional_array(mapping, "eye", {3});
    roughness = optional_array(mapping, "roughness", {h, w});
    metallic = optional_array(mapping, "metallic", {h, w});
    specular = optional_array(mapping, "specular", {h, w});
    if (!view && !eye)
        throw ArgumentError("gbuffer.view",
                            "it is missing, and eye too (surfaces reflect towards the viewer); "
                            "give one of them");
}

mir::Hit ArrayTile::hit(mir::LuxelIndex i) const {
    const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
    if (at.x >= tile.width || at.y >= tile.height) return {};
    const std::size_t y = tile.y + at.y;
    const std::size_t x = tile.x + at.x;
    const mir::Vec3 n = triple(arrays->normal, y, x);
    return {lifted(triple(arrays->position, y, x), n, ray_offset), n};
}

ArrayTile::Surface ArrayTile::surface(mir::LuxelIndex i) const {
    const mir::LuxelPlace at = mir::BlockedLayout::of(tile).place(i);
    if (at.x >= tile.width || at.y >= tile.height) return {};
    const std::size_t y = tile.y + at.y;
    const std::size_t x = tile.x + at.x;
    const GBufferArrays& a = *arrays;
    const auto factor = [y, x](const std::optional<FloatArray>& array, float usual) {
        return array ? array->at(y, x) : usual;
    };
    mir::MaterialFactors factors;
    factors.base_color = {a.albedo.at(y, x, 0), a.albedo.at(y, x, 1), a.albedo.at(y, x, 2)};
    factors.roughness = factor(a.roughness, 1.0f);
    factors.metallic = factor(a.metallic, 0.0f);
    factors.specular = factor(a.specular, 0.0f);
    const mir::Vec3 towards =
        a.view ? triple(*a.view, y, x)
               : glm::normalize(mir::Vec3(a.eye->at(0), a.eye->at(1), a.eye->at(2)) -
                                triple(a.position, y, x));
    const mir::Vec3 n = a.shading_normal ? triple(*a.shading_normal, y, x) : triple(a.normal, y, x);
    return {n, towards, {}, material_params(factors, mir::CookTorrance{})};
}

}  // namespace mirpy
