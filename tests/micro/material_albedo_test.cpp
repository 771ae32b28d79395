// SPDX-License-Identifier: MIT
#include "mir/micro/material_albedo.hpp"

#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/textured_scene.hpp"

using namespace mirtest;

TEST_CASE("Discs have the mean colour of their material's texture") {
    mir::Material m = mir::lambertian("m", {0.5f, 0.25f, 0.5f});
    const std::vector<mir::Rgb> plain = mir::material_albedo<mir::Lambert>(textured_triangle(m));
    CHECK(plain.at(0) == mir::Rgb{0.5f, 0.25f, 0.5f});
    // Half of the texels have red, half green, half blue.
    m.textures.base_color = texture_of(0);
    const std::vector<mir::Rgb> textured = mir::material_albedo<mir::Lambert>(textured_triangle(m));
    CHECK(textured.at(0) == mir::Rgb{0.25f, 0.125f, 0.25f});
}
