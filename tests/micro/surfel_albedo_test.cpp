// SPDX-License-Identifier: MIT
#include "mir/micro/surfel_albedo.hpp"

#include "micro/surfel_worlds.hpp"
#include "support/catch.hpp"
#include "support/textured_scene.hpp"

using namespace mirtest;
using mir::Lambert;
using mir::Rgb;

namespace {

/// Mean over the discs of a scene with one material, by their areas.
Rgb mean_albedo(const mir::Scene& scene, float max_area) {
    const World world{mir::Scene(scene)};
    const mir::SurfaceTable<Lambert> surfaces(world.scene);
    mir::InlineExecutor executor;
    const mir::SurfelTree tree(surfels_of(world, max_area),
                               mir::SurfelAlbedo<Lambert>(surfaces, world.geometry), {}, executor);
    return tree.albedo()[0];
}

/// A triangle whose corners are red, green and blue.
mir::Scene coloured_triangle() {
    mir::Scene scene;
    mir::Mesh mesh;
    mesh.material = scene.add(mir::lambertian("m", {0.5f, 0.5f, 0.5f}));
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}};
    scene.place(std::move(mesh));
    return scene;
}

}  // namespace

TEST_CASE("discs have the colour of the part of the texture below them") {
    mir::Material m = mir::lambertian("m", {0.5f, 0.25f, 0.5f});
    CHECK(mean_albedo(textured_triangle(m), 1.0f) == Rgb{0.5f, 0.25f, 0.5f});
    m.textures.base_color = texture_of(0);
    const mir::Scene scene = textured_triangle(m);
    // What a thousand points of the triangle show, which is not the mean of all texels.
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<Lambert> surfaces(scene);
    mir::Random random = test_random(1311);
    double sum = 0.0;
    constexpr int points = 40'000;
    for (int i = 0; i < points; ++i) {
        mir::Vec2 b = random.next_2d();
        if (b.x + b.y > 1.0f) b = mir::Vec2(1.0f) - b;
        sum += double(surfaces.view().params(0, geometry.view().attributes(0, b)).reflectance.r);
    }
    CHECK(double(mean_albedo(scene, 1e-5f).r) == Approx(sum / points).margin(0.005));
    CHECK(double(mean_albedo(scene, 10.0f).r) == Approx(sum / points).margin(0.1));
}

TEST_CASE("discs have the vertex colours of their place") {
    const mir::Scene scene = coloured_triangle();
    const Rgb mean = mean_albedo(scene, 1.0f);
    CHECK(double(mean.r) == Approx(0.5 / 3));
    CHECK(double(mean.b) == Approx(0.5 / 3));
    const World world{mir::Scene(scene)};
    const mir::SurfaceTable<Lambert> surfaces(world.scene);
    const mir::SurfelAlbedo<Lambert> albedo(surfaces, world.geometry);
    for (const mir::Surfel& s : surfels_of(world, 1e-3f)) {
        CHECK(double(albedo(s).g) == Approx(0.5 * double(s.position.x)).margin(1e-5));
        CHECK(double(albedo(s).b) == Approx(0.5 * double(s.position.y)).margin(1e-5));
    }
}

TEST_CASE("a disc without a triangle has the reflectance of its material") {
    mir::Scene scene;
    scene.add(mir::lambertian("m", {0.1f, 0.2f, 0.3f}));
    const World world(std::move(scene));
    const mir::SurfaceTable<Lambert> surfaces(world.scene);
    mir::Surfel disc;
    disc.triangle = mir::Surfel::no_triangle;
    CHECK(mir::SurfelAlbedo<Lambert>(surfaces, world.geometry)(disc) == Rgb{0.1f, 0.2f, 0.3f});
}
