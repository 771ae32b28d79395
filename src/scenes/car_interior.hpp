// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/car_body.hpp"
#include "scenes/tube.hpp"

namespace mir::builtin {

/// Seat, back and head rest, its middle at `x`; `z` is the hip.
inline Mesh seat(std::uint32_t fabric, float x, float z, float width) {
    const float half = 0.5f * width;
    return joined(
        "seat", fabric,
        {cushion("base", fabric, placed({half, 0.09f, 0.27f}, {x, 0.36f, z - 0.24f}, 0.1f), 64, 40),
         cushion("back", fabric, placed({half, 0.34f, 0.075f}, {x, 0.71f, z + 0.13f}, 0.24f), 64,
                 40),
         cushion("left bolster", fabric,
                 placed({0.05f, 0.28f, 0.06f}, {x - half, 0.66f, z + 0.06f}, 0.24f), 32, 24),
         cushion("right bolster", fabric,
                 placed({0.05f, 0.28f, 0.06f}, {x + half, 0.66f, z + 0.06f}, 0.24f), 32, 24),
         cushion("head rest", fabric, placed({0.13f, 0.09f, 0.05f}, {x, 1.10f, z + 0.24f}, 0.15f),
                 48, 24)});
}

/// Ring, hub and three arms in front of the driver at `x`.
inline Mesh steering_wheel(std::uint32_t trim, float x) {
    Mesh m = ring("steering wheel", trim, 0.18f, 0.014f, 96);
    append(m, cushion("hub", trim, placed({0.03f, 0.055f, 0.06f}, {0, 0, 0}), 24, 12));
    for (const float angle : {0.0f, pi, 1.5f * pi}) {
        const Vec3 out(0.0f, std::sin(angle), std::cos(angle));
        append(m, tube("arm", trim, {0.04f * out, 0.18f * out}, 0.012f));
    }
    append(m, tube("column", trim, {Vec3(0.02f, 0, 0), Vec3(0.5f, 0, 0)}, 0.025f));
    // The axis, +x, is turned to the dashboard and 25 degrees down.
    const float c = std::cos(0.44f);
    const float d = std::sin(0.44f);
    const Mat3 turn(Vec3(0, -d, -c), Vec3(0, c, -d), Vec3(1, 0, 0));
    for (Vec3& p : m.positions) p = turn * p + Vec3(x, 0.84f, -0.13f);
    for (Vec3& n : m.normals) n = turn * n;
    return m;
}

/// Floor, dashboard, console, seats and steering wheel.
inline void place_interior(Scene& s, const CarMaterials& m, const Mat4& car) {
    const auto add = [&](Mesh mesh) { s.place(std::move(mesh), car); };
    add(box("floor", m.trim, {-0.8f, 0.14f, -0.93f}, {1.6f, 0, 0}, {0, 0.03f, 0}, {0, 0, 1.86f}));
    add(box("front floor", m.trim, {-0.55f, 0.15f, -2.0f}, {1.1f, 0, 0}, {0, 0.02f, 0},
            {0, 0, 1.06f}));
    add(box("rear floor", m.trim, {-0.55f, 0.15f, 0.94f}, {1.1f, 0, 0}, {0, 0.02f, 0},
            {0, 0, 1.05f}));
    add(box("firewall", m.trim, {-0.66f, 0.18f, -0.85f}, {1.32f, 0, 0}, {0, 0.6f, 0},
            {0, 0, 0.02f}));
    add(box("rear bulkhead", m.fabric, {-0.66f, 0.18f, 1.12f}, {1.32f, 0, 0}, {0, 0.7f, 0},
            {0, 0, 0.02f}));
    add(cushion("dashboard", m.trim, placed({0.7f, 0.15f, 0.2f}, {0, 0.79f, -0.5f}, 0.15f), 96,
                40));
    add(cushion("binnacle", m.trim, placed({0.17f, 0.06f, 0.1f}, {0.36f, 0.94f, -0.42f}), 48, 20));
    add(cushion("console", m.trim, placed({0.1f, 0.12f, 0.5f}, {0, 0.32f, -0.1f}), 48, 24));
    add(joined("gear lever", m.metal,
               {tube("rod", m.metal, {Vec3(0, 0.42f, -0.2f), Vec3(0, 0.53f, -0.22f)}, 0.008f),
                sphere("knob", m.metal, {0, 0.545f, -0.223f}, 0.024f, 24, 12)}));
    for (const float x : {-0.37f, 0.37f}) add(seat(m.fabric, x, 0.3f, 0.46f));
    for (const float x : {-0.3f, 0.3f}) add(moved(seat(m.fabric, x, 0.86f, 0.5f), {0, -0.1f, 0}));
    add(steering_wheel(m.trim, 0.37f));
}

}  // namespace mir::builtin
