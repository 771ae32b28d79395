// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/material.hpp"

#include <string>
#include <utility>

namespace mir::detail {

/// What a file without materials gets: Lambertian, of the colours of its vertices, else grey.
inline Material unknown_surface(std::string name, bool has_colors) {
    const float reflectance = has_colors ? 1.0f : 0.8f;
    return lambertian(std::move(name), {reflectance, reflectance, reflectance});
}

}  // namespace mir::detail
