// SPDX-License-Identifier: MIT
#include "mir/validation/furnace.hpp"

#include "support/catch.hpp"
#include "validation/finds.hpp"

namespace {

using mir::Image;
using mir::Rgb;

/// A renderer that knows the closed form.
Image<Rgb> right(const mir::Scene& scene) {
    const mir::Material& wall = scene.materials[0];
    const float radiance = wall.emission.r / (1.0f - wall.base_color.r);
    return Image<Rgb>({4, 4}, {radiance, radiance, radiance});
}

/// One that has no second bounce.
Image<Rgb> one_bounce(const mir::Scene& scene) {
    const mir::Material& wall = scene.materials[0];
    const float radiance = wall.emission.r * (1.0f + wall.base_color.r);
    return Image<Rgb>({4, 4}, {radiance, radiance, radiance});
}

/// One whose light gets through the block.
Image<Rgb> sees_through(const mir::Scene& scene) {
    Image<Rgb> image = right(scene);
    if (scene.meshes.size() == 1) return image;
    for (Rgb& c : image.pixels()) c = c * 1.05f;
    return image;
}

/// One that loses its blue in the last row.
Image<Rgb> without_blue(const mir::Scene& scene) {
    Image<Rgb> image = right(scene);
    for (std::uint32_t x = 0; x < 4; ++x) image(x, 3).b = 0.0f;
    return image;
}

}  // namespace

TEST_CASE("check_furnace passes the closed form") {
    const auto report = mir::validation::check_furnace(right, 1e-5);
    CHECK(report.passed());
    CHECK(report.checks() == 6);
}

TEST_CASE("check_furnace finds light that is lost, doubled or has another colour") {
    using mir::validation::check_furnace;
    CHECK(check_furnace(one_bounce, 0.03).findings().size() == 6);
    CHECK(check_furnace(sees_through, 0.03).findings().size() == 3);
    CHECK(check_furnace(without_blue, 0.03).findings().size() == 6);
}
