// SPDX-License-Identifier: MIT
#include "mir/scene/world_geometry.hpp"
#include "mir/shading/surface_table.hpp"
#include "support/catch.hpp"
#include "support/textured_scene.hpp"

using namespace mirtest;
using mir::CookTorrance;
using mir::Rgb;
using mir::Vec3;

namespace {

/// The triangle seen from the front (+z) or the back at a place of its plane.
struct Seen {
    explicit Seen(mir::Scene what) : scene(std::move(what)) {}

    [[nodiscard]] mir::SurfacePoint point(float x, float y, bool front = true) const {
        return geometry.surface_point(0, {x / 2.0f, y / 2.0f}, {0, 0, front ? -1.0f : 1.0f});
    }
    [[nodiscard]] auto surface(float x, float y, bool front = true) const {
        return surfaces.surface(point(x, y, front), {0, 0, front ? 1.0f : -1.0f});
    }

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::SurfaceTable<CookTorrance> surfaces{scene};
};

mir::Material matte() { return mir::lambertian("m", {0.5f, 0.5f, 0.5f}); }

/// The scene with a normal map of one colour.
mir::Scene bumped(std::uint32_t color) {
    mir::Material m = matte();
    m.textures.normal = texture_of(1);
    mir::Scene scene = textured_triangle(m);
    scene.images.push_back({"normals", 1, 1, {color}});
    return scene;
}

void check_close(Vec3 a, Vec3 b) { CHECK(glm::length(a - b) < 1e-5f); }

}  // namespace

TEST_CASE("the base colour follows its texture upright") {
    mir::Material m = matte();
    m.textures.base_color = texture_of(0);
    const Seen seen(textured_triangle(m));
    // Upper left red, upper right green, lower left blue, lower right white.
    CHECK(seen.surface(0.25f, 0.75f).bsdf.diffuse == Rgb{0.5f, 0, 0});
    CHECK(seen.surface(0.75f, 0.75f).bsdf.diffuse == Rgb{0, 0.5f, 0});
    CHECK(seen.surface(0.25f, 0.25f).bsdf.diffuse == Rgb{0, 0, 0.5f});
    CHECK(seen.surface(0.75f, 0.25f).bsdf.diffuse == Rgb{0.5f, 0.5f, 0.5f});
    // Half of the texels have red, and so on.
    CHECK(seen.surfaces.mean_albedo(0) == Approx(0.25));
}

TEST_CASE("green is roughness and blue is metalness") {
    mir::Material m;
    m.roughness = 0.8f;
    m.metallic = 0.5f;
    m.textures.metallic_roughness = texture_of(0);
    const Seen seen(textured_triangle(m));
    mir::Material expected = m;
    expected.metallic = 0.0f;
    CHECK(seen.surface(0.75f, 0.75f).bsdf.alpha == Approx(0.64));
    CHECK(seen.surface(0.75f, 0.75f).bsdf.f0 == mir::material_params(expected, CookTorrance{}).f0);
    expected.metallic = 0.5f;
    expected.roughness = 0.0f;
    CHECK(seen.surface(0.25f, 0.25f).bsdf.f0 == mir::material_params(expected, CookTorrance{}).f0);
    // Chains carry a lobe as narrow as this.
    CHECK(seen.surface(0.25f, 0.25f).bsdf.alpha == 0.0f);
}

TEST_CASE("vertex colours multiply the base colour") {
    mir::Scene scene = textured_triangle(matte());
    scene.meshes[0].colors = {{1, 1, 1}, {0, 1, 0}, {0.5f, 0, 1}};
    const Seen seen(scene);
    CHECK(seen.surface(0, 0).bsdf.diffuse == Rgb{0.5f, 0.5f, 0.5f});
    CHECK(seen.surface(2, 0).bsdf.diffuse == Rgb{0, 0.5f, 0});
    CHECK(seen.surface(1, 0).bsdf.diffuse == Rgb{0.25f, 0.5f, 0.25f});
}

TEST_CASE("emission follows its texture") {
    mir::Material m = mir::emitter("lamp", {0, 0, 0}, {2, 4, 8});
    m.textures.emission = texture_of(0);
    const Seen seen(textured_triangle(m));
    CHECK(seen.surface(0.25f, 0.25f).emission == Rgb{0, 0, 8});
    CHECK(seen.surface(0.25f, 0.25f, false).emission == Rgb{0, 0, 0});
}

TEST_CASE("a normal map bends the shading normal, red to the right and green upwards") {
    check_close(Seen(bumped(texel(255, 128, 128))).surface(0.5f, 0.5f).normal,
                glm::normalize(Vec3(1, 1 / 255.0f, 1 / 255.0f)));
    check_close(Seen(bumped(texel(128, 255, 255))).surface(0.5f, 0.5f).normal,
                glm::normalize(Vec3(1 / 255.0f, 1, 1)));
    // From behind the same relief is seen: bumps become dents.
    check_close(Seen(bumped(texel(128, 255, 255))).surface(0.5f, 0.5f, false).normal,
                -glm::normalize(Vec3(1 / 255.0f, 1, 1)));
}

TEST_CASE("a mirrored map stays upright") {
    mir::Scene scene = bumped(texel(204, 204, 255));
    for (mir::Vec2& uv : scene.meshes[0].texture_coordinates) uv.x = -uv.x;
    check_close(Seen(scene).surface(0.5f, 0.5f).normal, glm::normalize(Vec3(-0.6f, 0.6f, 1)));
}

TEST_CASE("the scale of a normal map weighs its slopes") {
    mir::Scene scene = bumped(texel(204, 204, 255));
    scene.materials[0].textures.normal_scale = 0.5f;
    check_close(Seen(scene).surface(0.5f, 0.5f).normal, glm::normalize(Vec3(0.3f, 0.3f, 1)));
}

TEST_CASE("a normal that would turn away, or has no direction, is that of the vertices") {
    check_close(Seen(bumped(texel(255, 128, 0))).surface(0.5f, 0.5f).normal, {0, 0, 1});
    mir::Scene scene = bumped(texel(204, 204, 255));
    scene.meshes[0].texture_coordinates.assign(3, {0.5f, 0.5f});
    check_close(Seen(scene).surface(0.5f, 0.5f).normal, {0, 0, 1});
    scene.meshes[0].texture_coordinates.clear();
    check_close(Seen(scene).surface(0.5f, 0.5f).normal, {0, 0, 1});
}

TEST_CASE("a bent normal is the same wherever it is seen from, but for luxels") {
    const Seen seen(bumped(texel(255, 128, 160)));
    const mir::SurfacePoint p = seen.point(0.5f, 0.5f);
    const Vec3 bent = seen.surface(0.5f, 0.5f).normal;
    const Vec3 along = glm::normalize(Vec3(1, 0, 0.1f));
    const Vec3 against = glm::normalize(Vec3(-1, 0, 0.1f));
    CHECK(seen.surfaces.surface(p, along).normal == bent);
    CHECK(seen.surfaces.surface(p, against).normal == bent);
    CHECK(seen.surfaces.luxel_surface(p, along).normal == bent);
    CHECK(seen.surfaces.luxel_surface(p, against).normal == p.shading_normal);
    mir::SurfacePoint leaning = p;
    leaning.shading_normal = along;
    CHECK(seen.surfaces.luxel_surface(leaning, against).normal == p.geometric_normal);
}

TEST_CASE("meshes with and without coordinates and colours stand beside each other") {
    mir::Scene scene = textured_triangle(matte());
    mir::Mesh plain = scene.meshes[0];
    plain.texture_coordinates.clear();
    mir::Mesh colored = plain;
    colored.colors.assign(3, {0.25f, 0, 0});
    scene.place(plain);
    scene.place(colored);
    scene.place(plain);
    const mir::WorldGeometry geometry(scene);
    CHECK(geometry.texture_coordinates().size() == 12);
    CHECK(geometry.colors().size() == 12);
    const auto at = [&](std::uint32_t t) { return geometry.view().attributes(t, {0.5f, 0.25f}); };
    CHECK(at(0).texture_coordinates == mir::Vec2(1.0f, 0.5f));
    CHECK(at(1).texture_coordinates == mir::Vec2(0.0f));
    CHECK(at(0).color == Rgb{1, 1, 1});
    CHECK(at(2).color == Rgb{0.25f, 0, 0});
    CHECK(at(3).color == Rgb{1, 1, 1});
    scene.meshes[2].colors.pop_back();
    CHECK_THROWS_AS(mir::WorldGeometry(scene), mir::Error);
    scene.meshes[2].colors.assign(3, {2, 0, 0});
    CHECK_THROWS_AS(mir::WorldGeometry(scene), mir::Error);
}

TEST_CASE("what goes through and what coats follow their textures") {
    mir::Material m = matte();
    m.transmission = 0.5f;
    m.clearcoat = 0.75f;
    m.clearcoat_roughness = 0.5f;
    m.diffuse_transmission = 0.25f;
    m.diffuse_transmission_color = {0.5f, 1.0f, 1.0f};
    mir::MaterialTextures& t = m.textures;
    t.transmission = t.clearcoat = t.clearcoat_roughness = texture_of(0);
    t.diffuse_transmission = t.diffuse_transmission_color = texture_of(0);
    mir::Scene scene = textured_triangle(m);
    scene.images[0].texels[2] = texel(0, 0, 255, 0);
    const Seen seen(scene);
    const auto at = [&](float x, float y) {
        return seen.surfaces.view().factors(0, attributes_of(seen.point(x, y)));
    };
    const mir::MaterialFactors red = at(0.25f, 0.75f);
    const mir::MaterialFactors green = at(0.75f, 0.75f);
    const mir::MaterialFactors blue = at(0.25f, 0.25f);
    CHECK(red.transmission == 0.5f);
    CHECK(green.transmission == 0.0f);
    CHECK(red.clearcoat == 0.75f);
    CHECK(green.clearcoat == 0.0f);
    CHECK(red.clearcoat_roughness == 0.0f);
    CHECK(green.clearcoat_roughness == 0.5f);
    CHECK(red.diffuse_transmission == 0.25f);
    CHECK(blue.diffuse_transmission == 0.0f);
    CHECK(red.diffuse_transmission_color == Rgb{0.5f, 0, 0});
    CHECK(blue.diffuse_transmission_color == Rgb{0, 0, 1});
    // The base colour varies with none of them.
    CHECK(red.base_color == m.base_color);
}

TEST_CASE("the base is what the texture of transmission leaves, and glass has no coat") {
    mir::Material m = matte();
    m.transmission = 1.0f;
    m.clearcoat = 1.0f;
    m.clearcoat_roughness = 0.5f;
    m.textures.transmission = texture_of(0);
    const Seen seen(textured_triangle(m));
    const auto clear = seen.surface(0.25f, 0.75f).bsdf;
    const auto solid = seen.surface(0.75f, 0.75f).bsdf;
    CHECK(is_black(clear.diffuse));
    CHECK(clear.clearcoat == 0.0f);
    CHECK(solid.diffuse.g > 0.45f);
    CHECK(solid.clearcoat == 1.0f);
}

TEST_CASE("a rough coat is as wide as its texture says, and one that is smooth somewhere mirrors") {
    mir::Material m = matte();
    m.clearcoat = 1.0f;
    m.clearcoat_roughness = 0.5f;
    CHECK_FALSE(Seen(textured_triangle(m)).surfaces.bends_rays());
    m.textures.clearcoat_roughness = texture_of(0);
    const Seen seen(textured_triangle(m));
    CHECK(seen.surfaces.bends_rays());
    const auto coat = [&](float x, float y) {
        return seen.surfaces.view().coat(0, attributes_of(seen.point(x, y)));
    };
    CHECK(coat(0.75f, 0.75f).alpha == Approx(0.25));
    CHECK(coat(0.25f, 0.75f).alpha < 1e-3f);
}
