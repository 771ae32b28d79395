// SPDX-License-Identifier: MIT
#include "vpls.hpp"

#include "arrays.hpp"
#include "errors.hpp"
#include "gpu_parts.hpp"
#include "views.hpp"

#include <nanobind/stl/string.h>

#include <cmath>

namespace nb = nanobind;

namespace mirpy {
namespace {

static_assert(sizeof(mir::Vpl) == 9 * sizeof(float));

/// Three of the nine floats of each VPL, from number `first` on, where they lie.
NumpyArray<float> column(nb::handle self, std::size_t first) {
    auto& vpls = nb::cast<PyVpls&>(self).vpls;
    auto* begin = reinterpret_cast<float*>(vpls.data());
    return {begin == nullptr ? nullptr : begin + first, {vpls.size(), 3}, self, {9, 1}};
}

mir::Vec3 row(const FloatArray& rows, std::size_t i) {
    return {rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)};
}

void make_from_arrays(PyVpls* self, nb::handle positions, nb::handle normals,
                      nb::handle intensities) {
    const FloatArray places(positions, "positions", {any_size, 3});
    const auto count = static_cast<long>(places.size(0));
    const FloatArray sides(normals, "normals", {count, 3});
    const FloatArray light(intensities, "intensities", {count, 3});
    PyVpls made;
    for (std::size_t i = 0; i < places.size(0); ++i) {
        const mir::Vec3 normal = row(sides, i);
        if (!(std::fabs(glm::length(normal) - 1.0f) < 1e-3f))
            throw ArgumentError("normals", "number " + std::to_string(i) +
                                               " is no unit vector; divide it by "
                                               "its length");
        const mir::Vec3 j = row(light, i);
        if (j.x < 0.0f || j.y < 0.0f || j.z < 0.0f)
            throw ArgumentError("intensities", "number " + std::to_string(i) +
                                                   " is negative; give numbers from 0 up");
        made.vpls.push_back({row(places, i), normal, {j.x, j.y, j.z}});
    }
    new (self) PyVpls(std::move(made));
}

/// The VPLs with other intensities, which stand for the same places.
PyVpls lit_by(const PyVpls& all, std::vector<mir::Vpl> some) {
    if (all.list.empty() && !all.vpls.empty())
        throw mir::Error(mir::ErrorCode::unsupported,
                         "these VPLs were made from arrays, which do not say what lit them; choose "
                         "among them by your own array");
    return {std::move(some), {}, all.bound};
}

}  // namespace

PyVpls vpls_of(mir::VplList list, float bound) {
    std::vector<mir::Vpl> all(list.vpls().begin(), list.vpls().end());
    return {std::move(all), std::move(list), bound};
}

const PyVpls& vpls_in(nb::handle vpls) {
    if (!nb::isinstance<PyVpls>(vpls))
        throw ArgumentError("vpls",
                            "it is no mir.Vpls; give what sample_vpls() returns, or "
                            "mir.Vpls(positions, normals, intensities)");
    return nb::cast<const PyVpls&>(vpls);
}

float bound_of(const PyVpls& vpls, const std::optional<float>& bound) {
    if (bound && !(*bound > 0.0f))
        throw ArgumentError("bound", "it is no positive number; give one, per square metre");
    return bound.value_or(vpls.bound);
}

void bind_vpls(nb::module_& m) {
    nb::class_<PyVpls>(m, "Vpls",
                       "Virtual point lights: places, the side on which they shine, and light.")
        .def("__init__", make_from_arrays, nb::arg("positions").none(), nb::arg("normals").none(),
             nb::arg("intensities").none(),
             "VPLs from arrays of (n, 3): metres, lifted off the surface; unit; W sr^-1.")
        .def("__len__", [](const PyVpls& self) { return self.vpls.size(); })
        .def_prop_ro(
            "positions", [](nb::handle self) { return column(self, 0); },
            "(n, 3), metres; a view of what the VPLs are.")
        .def_prop_ro(
            "normals", [](nb::handle self) { return column(self, 3); }, "(n, 3), unit; a view.")
        .def_prop_ro(
            "intensities", [](nb::handle self) { return column(self, 6); },
            "(n, 3), along the normal, W sr^-1; a view, which may be written to.")
        .def_rw("bound", &PyVpls::bound,
                "Largest geometry term under which they were placed, m^-2.")
        .def(
            "of_bounce",
            [](const PyVpls& self, std::uint8_t b) { return lit_by(self, self.list.bounce(b)); },
            nb::arg("bounce"),
            "The same VPLs with the light of so many scattering events alone; 2: one bounce.")
        .def(
            "of_light_group",
            [](const PyVpls& self, std::uint16_t g) {
                return lit_by(self, self.list.light_group(g));
            },
            nb::arg("light_group"), "The same VPLs with the light of one group of lamps alone.")
        .def("on_gpu", gpu::copy_of, nb::arg("device") = 0,
             "A copy in the memory of a GPU, for reconstruct() and reshade(): a dictionary of\n"
             "arrays positions, normals and intensities, (n, 3) each, and the bound.");
}

}  // namespace mirpy
