// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "errors.hpp"
#include "mir/scene/environment_table.hpp"
#include "scene.hpp"
#include "triples.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace nb = nanobind;

namespace mirpy {
namespace {

mir::Vec3 direction_of(nb::handle value, const char* place) {
    const mir::Vec3 v = vector_of(value, place);
    const float length = glm::length(v);
    if (!(length > 0.0f) || std::isinf(length))
        throw ArgumentError(place, "it has no direction; give one such as (0, -1, 0)");
    return v / length;
}

float radians_of(double degrees, double least, double most, const char* place) {
    if (!(degrees >= least && degrees <= most))
        throw ArgumentError(place, "give degrees of " + std::to_string(static_cast<int>(least)) +
                                       " to " + std::to_string(static_cast<int>(most)));
    return static_cast<float>(degrees) * std::numbers::pi_v<float> / 180.0f;
}

void add_point_light(PyScene& self, nb::handle position, nb::handle intensity,
                     std::uint16_t light_group, const std::string& name) {
    const mir::PointLight light{name, vector_of(position, "position"),
                                light_of(intensity, "intensity"), light_group};
    self.edit().point_lights.push_back(light);
}

void add_spot_light(PyScene& self, nb::handle position, nb::handle direction, nb::handle intensity,
                    double inner_angle, double outer_angle, std::uint16_t light_group,
                    const std::string& name) {
    if (!(inner_angle <= outer_angle))
        throw ArgumentError("inner_angle", "it is larger than outer_angle; give less");
    mir::SpotLight light;
    light.name = name;
    light.position = vector_of(position, "position");
    light.direction = direction_of(direction, "direction");
    light.intensity = light_of(intensity, "intensity");
    light.cos_inner = std::cos(radians_of(inner_angle, 0, 90, "inner_angle"));
    light.cos_outer = std::cos(radians_of(outer_angle, 0, 90, "outer_angle"));
    light.light_group = light_group;
    self.edit().spot_lights.push_back(light);
}

void add_directional_light(PyScene& self, nb::handle direction, nb::handle irradiance,
                           std::uint16_t light_group, const std::string& name) {
    const mir::DirectionalLight light{name, direction_of(direction, "direction"),
                                      light_of(irradiance, "irradiance"), light_group};
    self.edit().directional_lights.push_back(light);
}

void set_environment(PyScene& self, nb::handle radiance, float scale, float rotation,
                     std::uint16_t light_group) {
    if (radiance.is_none()) {
        self.edit().environment.reset();
        return;
    }
    const FloatArray pixels(radiance, "radiance", {any_size, any_size, 3});
    mir::Environment environment;
    environment.name = "environment";
    environment.radiance = mir::Image<mir::Rgb>(
        {static_cast<std::uint32_t>(pixels.size(1)), static_cast<std::uint32_t>(pixels.size(0))});
    environment.scale = scale;
    environment.rotation = rotation;
    environment.light_group = light_group;
    for (std::uint32_t y = 0; y < environment.radiance.height(); ++y)
        for (std::uint32_t x = 0; x < environment.radiance.width(); ++x)
            environment.radiance(x, y) = {pixels.at(y, x, 0), pixels.at(y, x, 1),
                                          pixels.at(y, x, 2)};
    try {
        static_cast<void>(mir::EnvironmentTable(environment));
    } catch (const mir::Error& e) {
        throw ArgumentError("radiance", e.what());
    }
    self.edit().environment = std::move(environment);
}

std::uint32_t add_camera(PyScene& self, nb::handle position, nb::handle target, nb::handle up,
                         double fov, float lens_radius, const std::optional<float>& focus_distance,
                         float aspect_ratio, const std::string& name) {
    const mir::Vec3 eye = vector_of(position, "position");
    const mir::Vec3 at = vector_of(target, "target");
    const mir::Vec3 top = direction_of(up, "up");
    const mir::Vec3 way = at - eye;
    if (!(glm::length(way) > 0.0f))
        throw ArgumentError("target", "it is where the camera stands; give another place");
    if (!(glm::length(glm::cross(top, way)) > 1e-6f * glm::length(way)))
        throw ArgumentError("up", "the camera looks along it; give another direction");
    if (!(lens_radius >= 0.0f)) throw ArgumentError("lens_radius", "give metres from 0 up");
    mir::Camera camera = mir::Camera::look_at(eye, at, top, radians_of(fov, 1, 170, "fov"));
    camera.name = name;
    camera.lens_radius = lens_radius;
    camera.focus_distance = focus_distance.value_or(glm::length(way));
    if (!(camera.focus_distance > 0.0f))
        throw ArgumentError("focus_distance", "give metres of more than 0");
    camera.aspect_ratio = aspect_ratio;
    return self.add_camera(camera);
}

}  // namespace

void bind_lights(nb::class_<PyScene>& scene) {
    scene
        .def("add_point_light", add_point_light, nb::arg("position").none(),
             nb::arg("intensity").none(), nb::kw_only(), nb::arg("light_group") = 0,
             nb::arg("name") = "point",
             "Adds a lamp without extent. intensity: three numbers, W sr^-1.")
        .def("add_spot_light", add_spot_light, nb::arg("position").none(),
             nb::arg("direction").none(), nb::arg("intensity").none(), nb::kw_only(),
             nb::arg("inner_angle") = 0.0, nb::arg("outer_angle") = 45.0,
             nb::arg("light_group") = 0, nb::arg("name") = "spot",
             "Adds a lamp that shines into a cone around `direction`.\n\n"
             "intensity: three numbers, W sr^-1. Angles: degrees from `direction`; full light up\n"
             "to the inner one, none from the outer one on.")
        .def("add_directional_light", add_directional_light, nb::arg("direction").none(),
             nb::arg("irradiance").none(), nb::kw_only(), nb::arg("light_group") = 0,
             nb::arg("name") = "sun",
             "Adds parallel light that travels along `direction`.\n\n"
             "irradiance: of a surface that faces it, three numbers, W m^-2.")
        .def("set_environment", set_environment, nb::arg("radiance").none(), nb::kw_only(),
             nb::arg("scale") = 1.0f, nb::arg("rotation") = 0.0f, nb::arg("light_group") = 0,
             "Puts light from all around; None takes it away.\n\n"
             "radiance: (height, width, 3), equirectangular, W m^-2 sr^-1; the top row looks up,\n"
             "the middle along +x. rotation: degrees about +y.")
        .def("add_camera", add_camera, nb::arg("position").none(), nb::arg("target").none(),
             nb::kw_only(), nb::arg("up") = nb::make_tuple(0, 1, 0), nb::arg("fov") = 45.0,
             nb::arg("lens_radius") = 0.0f, nb::arg("focus_distance") = nb::none(),
             nb::arg("aspect_ratio") = 0.0f, nb::arg("name") = "",
             "Adds a camera; returns its index.\n\n"
             "position, target: metres. fov: vertical, degrees. lens_radius: metres, 0 is a\n"
             "pinhole; focus_distance: metres, without it that of the target. aspect_ratio:\n"
             "width / height of pictures without a size of their own; 0 is 4 / 3.");
}

}  // namespace mirpy
