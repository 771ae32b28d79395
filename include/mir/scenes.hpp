// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/check_rooms.hpp"
#include "mir/scene/scene.hpp"

#include <array>
#include <string_view>

namespace mir::builtin {

/// Which way a lamp shines.
enum class Lamp { down, up };

/// The Cornell box, 2 m wide and open to the viewer. It has a red and a green wall and two blocks.
/// With the lamp up it hangs below the ceiling and lights it: nearly all light on the floor is
/// indirect. Dimensions follow the measured box of Goral et al. (1984), scaled and straightened.
Scene cornell_box(Lamp lamp);

/// The paper's simplest scene (section 6, "sphere"), about 2 000 triangles. A sphere stands in a
/// room with a main lamp turned down or up; a second lamp is in a room behind a plane that leaves a
/// small passage.
Scene sphere_room(Lamp lamp);

/// The paper's second scene (section 6, "voiture"): a car in two rooms. About 480 000 triangles.
Scene car_room(Lamp lamp);

/// The paper's third scene ("voiture+grillage"), about 1.4 million triangles in all. Woven wire
/// covers the car from above and three sides, between it and the lamp.
Scene car_grille(Lamp lamp);

/// The paper's fourth scene (section 6, "garage"): the car in a closed garage. The only lamps are
/// in the next room. Light comes through the door, and the door stops most shadow rays: as many
/// triangles as in car_room(), but rays that find alike.
Scene garage();

/// Two closed rooms of 6 x 3 x 6 m, joined by a door ajar. Both lamps are in the room behind the
/// wall and shine at its ceiling: no lamp is seen from the camera's room, and 1 to 3 % of the
/// emitted power gets there, through the gap. The hard case for light paths that start at the
/// lamps, small enough for tests: after the garage of section 6 of the paper and the room of Veach
/// and Guibas, "Metropolis light transport", SIGGRAPH 1997, figure 2.
Scene door_ajar();

/// Floor and wall, 2 m x 2 m each, that meet at a right angle. A lamp shines into the edge between
/// them: the light near that edge is what a bound of the geometry term removes. Only the two see
/// each other, so each bounce goes from one to the other.
Scene corner();

/// A furnished corner of a room with mirror, window pane and glass of water. Daylight comes
/// through the pane, which is a sheet; what stands in the mirror is seen once more; the glass has
/// interfaces between air, glass and water.
Scene glass_room();

/// A metal ring and a glass ball on a table under a small lamp. The ring, a short open cylinder,
/// throws a heart-shaped caustic, the ball a bright spot: light that no VPL can bring.
Scene caustics();

/// A hedge of leaf cards in front of a wall. Most are cut out by an alpha mask, every sixth is
/// blended: rays and shadows go through parts of 1400 triangles.
Scene leaves();

/// sphere_room(Lamp::down) with its main lamp in a hollow shade of glass. All that lamp's light
/// goes through the shade's walls, 2 cm thick: next-event estimation finds none of it.
Scene sphere_behind_glass();

/// A scene that is generated in code, and what it shows.
struct Entry {
    std::string_view name;         ///< what make() takes
    std::string_view description;  ///< one line of help
    Scene (*make)();               ///< generates it, with the same bits each time
};

/// Every built-in scene, those of check_rooms.hpp too, in the order in which help lists them.
extern const std::array<Entry, 19> scenes;

/// Makes the scene called `name`.
/// @throws Error(invalid_argument) that lists the names when there is none.
Scene make(std::string_view name);

}  // namespace mir::builtin
