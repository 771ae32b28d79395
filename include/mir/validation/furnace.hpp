// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/number_text.hpp"
#include "mir/data/image.hpp"
#include "mir/scene/check_rooms.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/validation/report.hpp"

#include <cmath>

namespace mir::validation {

/// A room whose radiance is 1 W m^-2 sr^-1 in every direction. All surfaces reflect `reflectance`
/// diffusely and emit 1 - reflectance. With `block`, one stands in it and hides parts of the walls
/// from one another: light that gets through it makes the room brighter than 1.
inline Scene furnace(float reflectance, bool block) {
    Scene scene = builtin::furnace_box(reflectance, 1.0f - reflectance);
    if (block)
        scene.place(builtin::box("block", scene.meshes[0].material, {0.3f, -0.7f, -0.8f},
                                 {0.4f, 0.1f, 0}, {-0.1f, 0.9f, 0}, {0, 0, 0.4f}));
    return scene;
}

/// The closed form of whole renderers. `render(scene)` makes the Image<Rgb> that the scene's first
/// camera sees, emission included, W m^-2 sr^-1. Furnaces of three reflectances, with a block and
/// without, must have a mean of 1 in each channel, to within `tolerance`, which has to cover the
/// noise of the renderer and what its bound removes. All light has the same radiance, so a result
/// too bright or too dark means light counted twice or lost.
template <class Render>
Report check_furnace(const Render& render, double tolerance) {
    Report report;
    for (const float reflectance : {0.2f, 0.5f, 0.8f})
        for (const bool block : {false, true}) {
            const Image<Rgb> image = render(furnace(reflectance, block));
            double r = 0.0;
            double g = 0.0;
            double b = 0.0;
            const double share = 1.0 / static_cast<double>(image.pixels().size());
            for (const Rgb& c : image.pixels()) {
                r += share * static_cast<double>(c.r);
                g += share * static_cast<double>(c.g);
                b += share * static_cast<double>(c.b);
            }
            const bool holds = std::fabs(r - 1.0) <= tolerance && std::fabs(g - 1.0) <= tolerance &&
                               std::fabs(b - 1.0) <= tolerance;
            report.expect(holds,
                          "a furnace of reflectance " + number_text(reflectance) +
                              (block ? " with a block" : "") + " has radiance 1",
                          number_text(r) + ", " + number_text(g) + ", " + number_text(b));
        }
    return report;
}

}  // namespace mir::validation
