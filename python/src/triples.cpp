// SPDX-License-Identifier: MIT
#include "triples.hpp"

#include "arrays.hpp"
#include "errors.hpp"

namespace nb = nanobind;

namespace mirpy {

mir::Vec3 vector_of(nb::handle value, const char* place) {
    const std::vector<double> v = numbers_of(value, place, 3);
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

mir::Rgb rgb_of(nb::handle value, const char* place) {
    const mir::Vec3 v = vector_of(value, place);
    return {v.x, v.y, v.z};
}

mir::Rgb light_of(nb::handle value, const char* place) {
    const mir::Rgb light = rgb_of(value, place);
    if (light.r < 0.0f || light.g < 0.0f || light.b < 0.0f)
        throw ArgumentError(place, "light is negative; give three numbers from 0 up");
    return light;
}

}  // namespace mirpy
