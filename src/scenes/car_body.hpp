// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/car_materials.hpp"
#include "scenes/car_panels.hpp"

namespace mir::builtin {

/// A mesh on the car's left and its mirror image on the right, as one.
inline Mesh both_sides(Mesh m) {
    append(m, mirrored(m));
    return m;
}

/// Wings, doors and sills.
inline void place_flanks(Scene& s, const CarMaterials& m, const Mat4& car) {
    const Core& core = lower_core;
    const LowerHull hull;
    const auto flank = [&](const char* name, const std::vector<Rib>& ribs) {
        s.place(both_sides(side_panel(name, m.paint, core, hull, ribs)), car);
    };
    const float top = core.above() - 0.012f;
    flank("front wing", around_arch(-car_axle, -1.80f, -0.803f, 0.23f, top));
    flank("door", band({-0.797f, 0.397f}, 0.23f, 1.04f));
    flank("rear wing", around_arch(car_axle, 0.403f, 1.83f, 0.23f, top));
    flank("sill", band({-0.945f, 0.945f}, 0.13f, 0.224f));
    const Cut card{0.04f, 0.01f, 0.06f};
    s.place(both_sides(side_panel("door card", m.fabric, core, hull,
                                  band({-0.75f, 0.36f}, 0.26f, 1.0f), card)),
            car);
}

/// Bonnet, cowl, parcel shelf and boot lid.
inline void place_decks(Scene& s, const CarMaterials& m, const Mat4& car) {
    const LowerHull hull;
    const auto deck = [&](const char* name, std::uint32_t material, float z0, float z1,
                          float inset) {
        const Cut cut{0.0226f, 0.012f, inset};
        s.place(deck_panel(name, material, lower_core.top, hull, {-0.654f, z0}, {0.654f, z1}, cut),
                car);
    };
    deck("bonnet", m.paint, -1.972f, -0.72f, 0.0f);
    deck("cowl", m.trim, -0.713f, -0.45f, 0.012f);
    deck("parcel shelf", m.fabric, 1.08f, 1.42f, 0.02f);
    deck("boot lid", m.paint, 1.428f, 1.894f, 0.0f);
}

/// Bumper, lamp surrounds and grille frame: everything in front of the wings.
inline void place_nose(Scene& s, const CarMaterials& m, const Mat4& car) {
    const Core& core = lower_core;
    const LowerHull hull;
    const float c = core.nose();
    const float end = -1.806f;
    const float other = 2.0f * c - end;
    const auto part = [&](const char* name, std::uint32_t material, const std::vector<Rib>& ribs) {
        s.place(side_panel(name, material, core, hull, ribs), car);
    };
    const auto pair = [&](const char* name, float a0, float a1, float b0, float b1) {
        s.place(both_sides(side_panel(name, m.paint, core, hull, band({a0, a1}, b0, b1))), car);
    };
    part("front lip", m.trim, band({other, c, end}, 0.15f, 0.22f));
    pair("bumper corner", core.front - Core::corner - 0.08f, end, 0.226f, 0.436f);
    part("front bumper", m.paint, band({other, c, end}, 0.44f, 0.54f));
    pair("lamp surround", core.front + 0.03f, end, 0.543f, 0.70f);
    pair("grille surround", c + 0.34f, c + 0.42f, 0.543f, 0.70f);
    pair("grille divider", c, c + 0.035f, 0.543f, 0.70f);
    part("nose", m.paint, band({other, c, end}, 0.703f, core.above() - 0.012f));
}

/// Bumper, tail lamps and the panel above them.
inline void place_stern(Scene& s, const CarMaterials& m, const Mat4& car) {
    const Core& core = lower_core;
    const LowerHull hull;
    const float c = core.tail();
    const float end = 1.836f;
    const float other = 2.0f * c - end;
    const auto part = [&](const char* name, std::uint32_t material, float b0, float b1) {
        s.place(side_panel(name, material, core, hull, band({end, c, other}, b0, b1)), car);
    };
    part("diffuser", m.trim, 0.16f, 0.296f);
    part("rear bumper", m.paint, 0.30f, 0.56f);
    part("boot edge", m.paint, 0.764f, core.above() - 0.012f);
    s.place(side_panel("boot face", m.paint, core, hull, band({c - 0.4f, c + 0.4f}, 0.564f, 0.76f)),
            car);
    s.place(
        both_sides(side_panel("tail lamp", m.tail, core, hull,
                              band({end, c - 0.406f}, 0.564f, 0.76f), {0.012f, 0.012f, 0.012f})),
        car);
}

/// Roof and pillars; between them are the windows, without glass.
inline void place_cabin(Scene& s, const CarMaterials& m, const Mat4& car) {
    const Core& core = cabin_core;
    const CabinHull hull;
    const float rail = 1.258f;
    const auto pillars = [&](const char* name, std::uint32_t material, Vec2 low, Vec2 high,
                             float inset) {
        const Cut cut{0.0226f, 0.03f - inset, inset};
        s.place(both_sides(side_panel(name, material, core, hull,
                                      strip(low, high, 0.86f, rail + 0.004f), cut)),
                car);
    };
    const float f = core.front;
    const float r = core.rear;
    pillars("windscreen pillar", m.paint, {f - 0.47f, f - 0.385f}, {f - 0.32f, f - 0.16f}, 0.0f);
    pillars("door pillar", m.trim, {0.375f, 0.425f}, {0.385f, 0.42f}, 0.02f);
    pillars("rear pillar", m.paint, {r + 0.13f, r + 0.42f}, {r - 0.12f, r + 0.32f}, 0.0f);
    const float top = core.above() - 0.006f;
    s.place(side_panel("roof rail", m.paint, core, hull,
                       band({core.nose(), f, r, core.tail(), 2.0f * core.tail() - r,
                             2.0f * core.tail() - f, 2.0f * core.tail() - core.nose()},
                            rail, top),
                       {0.0226f, 0.03f, 0.0f, true}),
            car);
    s.place(deck_panel("sunroof", m.paint, core.top, hull, {-core.half_width + 0.004f, f + 0.004f},
                       {core.half_width - 0.004f, r - 0.004f}, {0.0226f, 0.03f}),
            car);
}

}  // namespace mir::builtin
