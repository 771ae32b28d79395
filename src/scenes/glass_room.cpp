// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/furniture.hpp"
#include "scenes/glass.hpp"

namespace mir::builtin {
namespace {

/// Wall at x = -2.2 with a window of 1.2 x 1.2 m: a pane in a frame, and a bright sky outside.
void place_window_wall(Scene& s, std::uint32_t plaster, std::uint32_t wood) {
    const auto wall = [&](float y, float z, float height, float depth) {
        s.place(box("window wall", plaster, {-2.4f, y, z}, {0.2f, 0, 0}, {0, height, 0},
                    {0, 0, depth}));
    };
    wall(0.0f, -2.0f, 0.9f, 4.2f);
    wall(2.1f, -2.0f, 0.5f, 4.2f);
    wall(0.9f, -2.0f, 1.2f, 0.6f);
    wall(0.9f, -0.2f, 1.2f, 2.4f);
    const auto bar = [&](float y, float z, float height, float depth) {
        s.place(box("window frame", wood, {-2.32f, y, z}, {0.05f, 0, 0}, {0, height, 0},
                    {0, 0, depth}));
    };
    bar(0.9f, -1.4f, 0.05f, 1.2f);
    bar(2.05f, -1.4f, 0.05f, 1.2f);
    for (const float z : {-1.4f, -0.825f, -0.25f}) bar(0.95f, z, 1.1f, 0.05f);

    const std::uint32_t glass = s.add(pane_glass("pane"));
    const std::uint32_t sky = s.add(emitter("sky", {0, 0, 0}, {14.0f, 17.0f, 21.0f}));
    for (const float z : {-1.35f, -0.775f})
        s.place(quad("pane", glass, {-2.295f, 0.95f, z + 0.525f}, {0, 0, -0.525f}, {0, 1.1f, 0}));
    s.place(quad("sky", sky, {-3.4f, 0.3f, 1.0f}, {0, 0, -3.6f}, {0, 3.2f, 0}));
}

/// A tumbler, 11 cm high, two thirds full. The three interfaces (glass and air, glass and water,
/// water and air) meet in one circle: each has the ratio of the two indices, so that no ray needs
/// to know more than one body.
void place_glass_of_water(Scene& s, Vec3 base) {
    constexpr std::uint32_t segments = 48;
    const std::uint32_t glass = s.add(body_glass("glass", 1.5f));
    const std::uint32_t wet = s.add(body_glass("wet glass", 1.5f / 1.33f));
    Material clear = body_glass("water", 1.33f);
    clear.attenuation_color = {0.86f, 0.95f, 0.97f};
    clear.attenuation_distance = 0.5f;
    const std::uint32_t water = s.add(clear);

    const Vec2 level(0.0325f, 0.075f);
    s.place(
        turned_solid("tumbler", glass, base,
                     {{{0, 0}, {0.032f, 0}},
                      {{0.032f, 0}, {0.0365f, 0.109f}},
                      {{0.0365f, 0.109f}, {0.0360f, 0.11f}, {0.0350f, 0.11f}, {0.0345f, 0.109f}},
                      {{0.0345f, 0.109f}, level}},
                     segments));
    s.place(turned_solid("wet tumbler", wet, base,
                         {{level, {0.0295f, 0.008f}}, {{0.0295f, 0.008f}, {0, 0.008f}}}, segments));
    s.place(turned_solid("water", water, base, {{level, {0, level.y}}}, segments));
}

/// Table top of 1.2 x 0.7 m, 0.75 m high, on four legs. `corner` has the smallest coordinates.
void place_table(Scene& s, std::uint32_t wood, Vec3 corner) {
    s.place(box("table top", wood, corner + Vec3(0, 0.71f, 0), {1.2f, 0, 0}, {0, 0.04f, 0},
                {0, 0, 0.7f}));
    for (const float x : {0.04f, 1.1f})
        for (const float z : {0.04f, 0.6f})
            s.place(box("table leg", wood, corner + Vec3(x, 0, z), {0.06f, 0, 0}, {0, 0.709f, 0},
                        {0, 0, 0.06f}));
}

void place_mirror(Scene& s, std::uint32_t wood) {
    const std::uint32_t silver = s.add(mirror("mirror", {0.95f, 0.95f, 0.94f}));
    s.place(box("mirror frame", wood, {-0.85f, 0.85f, -1.999f}, {1.2f, 0, 0}, {0, 1.2f, 0},
                {0, 0, 0.02f}));
    s.place(quad("mirror", silver, {-0.8f, 0.9f, -1.975f}, {1.1f, 0, 0}, {0, 1.1f, 0}));
}

}  // namespace

Scene glass_room() {
    Scene s;
    s.name = "glass-room";
    const std::uint32_t plaster = s.add(lambertian("plaster", {0.75f, 0.72f, 0.67f}));
    const std::uint32_t warm = s.add(lambertian("warm wall", {0.66f, 0.33f, 0.2f}));
    const std::uint32_t wood = s.add(lambertian("wood", {0.45f, 0.29f, 0.16f}));
    const std::uint32_t floor = s.add(lambertian("floor", {0.4f, 0.33f, 0.27f}));
    const std::uint32_t carton = s.add(lambertian("carton", {0.2f, 0.36f, 0.42f}));
    const std::uint32_t orange = s.add(lambertian("orange", {0.8f, 0.34f, 0.05f}));
    const std::uint32_t lamp = s.add(emitter("lamp", {0, 0, 0}, {26.0f, 21.0f, 14.0f}));

    s.place(quad("floor", floor, {-2.3f, 0, 2.2f}, {4.7f, 0, 0}, {0, 0, -4.2f}));
    s.place(quad("ceiling", plaster, {-2.3f, 2.6f, -2.0f}, {4.7f, 0, 0}, {0, 0, 4.2f}));
    s.place(quad("back wall", plaster, {-2.3f, 0, -2.0f}, {4.7f, 0, 0}, {0, 2.6f, 0}));
    s.place(quad("right wall", plaster, {2.4f, 0, -2.0f}, {0, 0, 4.2f}, {0, 2.6f, 0}));
    s.place(quad("near wall", warm, {2.4f, 0, 2.2f}, {-4.7f, 0, 0}, {0, 2.6f, 0}));
    place_window_wall(s, plaster, wood);
    place_mirror(s, wood);
    place_shelves(s, wood, carton, {0.75f, 0.001f, -1.99f});
    place_table(s, wood, {-0.8f, 0.001f, -0.5f});
    place_glass_of_water(s, {0.1f, 0.7515f, 0.0f});
    s.place(sphere("orange", orange, {-0.08f, 0.792f, -0.13f}, 0.04f, 24, 12));
    s.place(turned_block("book", carton, {-0.6f, 0.752f, -0.05f}, 0.2f, 0.03f, 0.4f));
    s.place(quad("lamp", lamp, {0.4f, 2.58f, 0.6f}, {0.5f, 0, 0}, {0, 0, 0.5f}));

    s.cameras.push_back(
        Camera::look_at({0.75f, 1.25f, 1.35f}, {-0.35f, 0.93f, -0.6f}, {0, 1, 0}, 0.95f));
    s.cameras.back().name = "table";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

}  // namespace mir::builtin
