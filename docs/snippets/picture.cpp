// SPDX-License-Identifier: MIT
//
// Quoted by README.md and docs/api.md: a picture by one call.
#include "support/catch.hpp"

// region: picture
#include "mir/render.hpp"
#include "mir/scenes.hpp"

mir::RenderResult picture_of_sphere() {
    const mir::Scene scene = mir::builtin::make("sphere");
    mir::RenderSettings settings;
    settings.image = {320, 240};
    return mir::render(scene, settings);
}
// endregion: picture

TEST_CASE("The first program of the documentation makes a picture") {
    const mir::RenderResult result = picture_of_sphere();
    CHECK(result.beauty.extent() == mir::Extent{320, 240});
    CHECK(result.statistics.vpls > 0);
}
