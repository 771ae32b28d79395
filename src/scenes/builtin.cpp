// SPDX-License-Identifier: MIT
#include "mir/core/error.hpp"
#include "mir/scenes.hpp"

#include <string>

namespace mir::builtin {

constinit const std::array<Entry, 19> scenes{{
    {"cornell-box", "the Cornell box", [] { return cornell_box(Lamp::down); }},
    {"cornell-inverted", "the Cornell box with its lamp turned to the ceiling",
     [] { return cornell_box(Lamp::up); }},
    {"sphere", "the paper's sphere, main lamp down", [] { return sphere_room(Lamp::down); }},
    {"sphere-indirect", "the paper's sphere, main lamp up", [] { return sphere_room(Lamp::up); }},
    {"car", "the paper's car, 480 000 triangles, main lamp down",
     [] { return car_room(Lamp::down); }},
    {"car-indirect", "the paper's car, main lamp up", [] { return car_room(Lamp::up); }},
    {"car-grille", "the car behind woven wire, 1.4 million triangles, main lamp down",
     [] { return car_grille(Lamp::down); }},
    {"car-grille-indirect", "the car behind woven wire, main lamp up",
     [] { return car_grille(Lamp::up); }},
    {"garage", "the paper's garage: the car, lit through a door from the next room",
     [] { return garage(); }},
    {"door-ajar", "all light comes through a door ajar, small", [] { return door_ajar(); }},
    {"corner", "a floor and a wall that meet, and a lamp", [] { return corner(); }},
    {"glass-room", "a room with a mirror, a window pane and a glass of water",
     [] { return glass_room(); }},
    {"caustics", "light that a metal ring and a glass ball throw on a table",
     [] { return caustics(); }},
    {"leaves", "a hedge of masked and blended leaves", [] { return leaves(); }},
    {"sphere-behind-glass", "the paper's sphere, main lamp in a glass shade",
     [] { return sphere_behind_glass(); }},
    {"furnace", "closed box whose radiance is exactly 1", [] { return furnace_box(); }},
    {"parallel-squares", "form factor 0.199824896", [] { return parallel_squares(); }},
    {"perpendicular-squares", "form factor 0.200043776", [] { return perpendicular_squares(); }},
    {"disc-above-plane", "irradiance pi/2 below the centre", [] { return disc_above_plane(); }},
}};

Scene make(std::string_view name) {
    std::string names;
    for (const Entry& e : scenes) {
        if (e.name == name) return e.make();
        names += (names.empty() ? "" : ", ") + std::string(e.name);
    }
    throw Error(ErrorCode::invalid_argument,
                "there is no built-in scene '" + std::string(name) + "'; choose one of " + names);
}

}  // namespace mir::builtin
