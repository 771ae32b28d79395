// SPDX-License-Identifier: MIT
#include "scenes/car.hpp"

#include "scenes/car_interior.hpp"
#include "scenes/wheel.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace mir::builtin {
namespace {

/// Four wheels with their brakes and the liners of their arches.
void place_wheels(Scene& s, const CarMaterials& m, const Mat4& car) {
    const auto four = [&](const Mesh& right) {
        for (const bool left : {false, true})
            for (const float z : {-car_axle, car_axle}) {
                const Vec3 centre(left ? -0.76f : 0.76f, car_wheel_height, z);
                s.place(moved(left ? mirrored(right) : right, centre), car);
            }
    };
    four(tyre(m.rubber));
    four(rim(m.metal));
    four(brake(m.metal));
    SurfaceGrid liner{2, 41, false, {}};
    for (std::uint32_t r = 0; r < liner.rows; ++r) {
        const float phi = 1.3f * pi * (0.5f - static_cast<float>(r) / 40.0f);
        const Vec3 rim_point(0.0f, 0.40f * std::cos(phi), 0.40f * std::sin(phi));
        liner.points.push_back(rim_point + Vec3(0.05f, 0, 0));
        liner.points.push_back(rim_point + Vec3(-0.2f, 0, 0));
    }
    Mesh arch = sheet("wheel arch", m.trim, liner, 0.01f);
    const std::array<Vec2, 4> end{
        {{0.03f, -0.222f}, {0.33f, -0.222f}, {0.33f, -0.212f}, {0.03f, -0.212f}}};
    append(arch, lathe("end", m.trim, end, 64));
    four(arch);
}

/// Bars behind the grille and the air intake, and the lamps beside them.
void place_front_details(Scene& s, const CarMaterials& m, const Mat4& car) {
    Mesh bars = empty_mesh("grille", m.metal);
    for (int i = -20; i <= 20; ++i) {
        const float x = 0.0167f * static_cast<float>(i);
        append(bars,
               tube("bar", m.metal, {Vec3(x, 0.53f, -2.17f), Vec3(x, 0.71f, -2.15f)}, 0.004f));
    }
    for (int i = 0; i < 5; ++i) {
        const float y = 0.25f + 0.04f * static_cast<float>(i);
        append(bars, tube("bar", m.metal, {Vec3(-0.6f, y, -2.07f), Vec3(0.6f, y, -2.07f)}, 0.005f));
    }
    s.place(std::move(bars), car);
    s.place(
        box("radiator", m.trim, {-0.62f, 0.18f, -2.0f}, {1.24f, 0, 0}, {0, 0.5f, 0}, {0, 0, 0.03f}),
        car);
    for (const float x : {0.46f, 0.60f}) {
        Mesh lamp =
            sphere("headlamp", m.metal, {x, 0.62f, -2.06f + 0.2f * (x - 0.46f)}, 0.062f, 40, 20);
        append(lamp, mirrored(lamp));
        s.place(std::move(lamp), car);
    }
}

/// Mirrors, handles, wipers, exhaust pipes, plate and aerial.
void place_small_parts(Scene& s, const CarMaterials& m, const Mat4& car) {
    const auto add = [&](Mesh mesh) { s.place(std::move(mesh), car); };
    const auto pair = [&](Mesh mesh) { add(both_sides(std::move(mesh))); };
    pair(cushion("mirror", m.paint, placed({0.105f, 0.062f, 0.06f}, {0.985f, 0.985f, -0.5f}), 64,
                 32));
    pair(tube("mirror arm", m.trim, {Vec3(0.76f, 0.92f, -0.48f), Vec3(0.92f, 0.965f, -0.49f)},
              0.017f));
    pair(tube("door handle", m.metal,
              {Vec3(0.885f, 0.78f, 0.14f), Vec3(0.945f, 0.785f, 0.16f), Vec3(0.95f, 0.785f, 0.28f),
               Vec3(0.885f, 0.78f, 0.30f)},
              0.011f));
    pair(tube("exhaust pipe", m.metal, {Vec3(0.5f, 0.24f, 1.9f), Vec3(0.5f, 0.24f, 2.24f)}, 0.04f,
              32));
    for (const float x : {-0.45f, 0.12f})
        add(tube("wiper", m.trim,
                 {Vec3(x, 0.955f, -0.69f), Vec3(x + 0.25f, 0.975f, -0.66f),
                  Vec3(x + 0.5f, 0.965f, -0.68f)},
                 0.007f));
    add(cushion("aerial", m.paint, placed({0.008f, 0.028f, 0.06f}, {0, 1.36f, 0.7f}, 0.15f), 32,
                16));
    add(cushion("front plate", m.metal, placed({0.26f, 0.055f, 0.008f}, {0, 0.49f, -2.235f}), 32,
                16));
    add(cushion("rear plate", m.metal, placed({0.26f, 0.055f, 0.008f}, {0, 0.66f, 2.235f}), 32,
                16));
}

}  // namespace

void place_car(Scene& s, const Mat4& car) {
    const CarMaterials m = add_car_materials(s);
    place_flanks(s, m, car);
    place_decks(s, m, car);
    place_nose(s, m, car);
    place_stern(s, m, car);
    place_cabin(s, m, car);
    place_interior(s, m, car);
    place_wheels(s, m, car);
    place_front_details(s, m, car);
    place_small_parts(s, m, car);
}

}  // namespace mir::builtin
