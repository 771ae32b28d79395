// SPDX-License-Identifier: MIT
#include "array_gbuffer.hpp"

#include <algorithm>
#include <iterator>

namespace nb = nanobind;

namespace mirpy {
namespace {

constexpr const char* names[] = {"position", "normal",    "shading_normal", "view",    "eye",
                                 "albedo",   "roughness", "metallic",       "specular"};

}  // namespace

nb::handle gbuffer_array(nb::handle mapping, const char* name) {
    if (!nb::isinstance<nb::dict>(mapping))
        throw ArgumentError("gbuffer", "it is no dictionary of arrays; give one");
    for (const auto [key, value] : nb::borrow<nb::dict>(mapping)) {
        const std::string given = nb::str(key).c_str();
        // What gbuffer() tells besides is of no use here.
        if (given == "emission") continue;
        if (std::find(std::begin(names), std::end(names), given) == std::end(names))
            throw ArgumentError(
                "gbuffer", "it has an array '" + given + "', which means nothing; leave it out");
    }
    return PyDict_GetItemString(mapping.ptr(), name);
}

}  // namespace mirpy
