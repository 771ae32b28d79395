// SPDX-License-Identifier: MIT
#include "mir/resident/uploaded_scene.hpp"

#include "conformance/stage.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

namespace {

/// All that a view may be asked is equal in both.
template <class Point>
bool same(const Point& a, const Point& b) {
    return a.position == b.position && a.geometric_normal == b.geometric_normal &&
           a.shading_normal == b.shading_normal && a.material == b.material && a.front == b.front &&
           a.texture_coordinates == b.texture_coordinates && a.color == b.color &&
           a.tangent == b.tangent && a.mirrored_texture == b.mirrored_texture;
}

/// Random texels.
mir::TextureImage noise(std::uint32_t width, std::uint32_t height) {
    mir::TextureImage image{"noise", width, height, {}};
    mir::Random random = mirtest::test_random(9);
    for (std::uint32_t i = 0; i < width * height; ++i)
        image.texels.push_back(static_cast<std::uint32_t>(random.next() * 4294967040.0f));
    return image;
}

/// A box that glows, bumps, is painted and coloured by vertices, all from noise.
mir::Scene noisy_box() {
    mir::Scene scene = mirtest::glossy_box();
    scene.images = {noise(5, 3), noise(8, 8)};
    for (mir::Material& m : scene.materials) {
        m.metallic = 0.7f;
        m.emission = {1, 2, 3};
        m.textures.base_color.image = 0;
        m.textures.metallic_roughness.image = 1;
        m.textures.normal.image = 1;
        m.textures.emission.image = 0;
        m.textures.normal.wrap_u = mir::Wrap::mirror;
        m.textures.emission.wrap_v = mir::Wrap::clamp;
    }
    for (mir::Mesh& mesh : scene.meshes)
        for (mir::Vec3 p : mesh.positions) {
            mesh.texture_coordinates.emplace_back(3.0f * p.x + p.z, p.y - 2.0f * p.z);
            mesh.colors.push_back({0.5f, 1, 0.25f});
        }
    return scene;
}

}  // namespace

TEST_CASE("An uploaded geometry and its materials answer like those on the host") {
    mir::Scene scene = mirtest::glossy_box();
    scene.place(mir::builtin::sphere("ball", 1, {0.3f, 0.4f, 0.5f}, 0.3f, 12, 6));
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<mir::CookTorrance> surfaces(scene);
    mirtest::PutOff work(0);
    const mirtest::LazyBackend backend(work);
    auto queue = backend.queue();
    const mir::UploadedGeometry<mirtest::LazyBackend> there(backend, queue, geometry);
    const mir::UploadedSurfaces<mirtest::LazyBackend, mir::CookTorrance> table(backend, queue,
                                                                               surfaces);
    queue.record().sync();
    CHECK(there.view().positions != geometry.view().positions);
    CHECK(there.view().ray_offset == geometry.ray_offset());
    mir::Random random = mirtest::test_random(4);
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
        const mir::Vec2 at = mir::square_to_triangle(random.next_2d());
        const mir::Vec3 along = mir::square_to_sphere(random.next_2d());
        const mir::SurfacePoint p = there.view().surface_point(t, at, along);
        CHECK(same(p, geometry.surface_point(t, at, along)));
        const auto found = table.view().surface(p, -along);
        const auto wanted = surfaces.surface(p, -along);
        CHECK(found.emission == wanted.emission);
        CHECK(found.bsdf.f0 == wanted.bsdf.f0);
        CHECK(found.bsdf.alpha == wanted.bsdf.alpha);
        CHECK(found.normal == p.shading_normal);
        CHECK(found.wo == -along);
    }
}

TEST_CASE("Uploaded textures and vertex colours give the numbers of the host") {
    const mir::Scene scene = noisy_box();
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<mir::CookTorrance> surfaces(scene);
    const mir::LightTable lights(scene, geometry);
    mirtest::PutOff work(0);
    const mirtest::LazyBackend backend(work);
    auto queue = backend.queue();
    const mir::UploadedGeometry<mirtest::LazyBackend> there(backend, queue, geometry);
    const mir::UploadedSurfaces<mirtest::LazyBackend, mir::CookTorrance> table(backend, queue,
                                                                               surfaces);
    const mir::UploadedLights<mirtest::LazyBackend> lamps(backend, queue, lights);
    queue.record().sync();
    CHECK(table.view().textures.images[0].texels != scene.images[0].texels.data());
    mir::Random random = mirtest::test_random(5);
    int painted = 0;
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
        const mir::Vec2 at = mir::square_to_triangle(random.next_2d());
        const mir::Vec3 along = mir::square_to_sphere(random.next_2d());
        const mir::SurfacePoint p = there.view().surface_point(t, at, along);
        CHECK(same(p, geometry.surface_point(t, at, along)));
        const auto found = table.view().surface(p, -along);
        const auto wanted = surfaces.surface(p, -along);
        CHECK(found.normal == wanted.normal);
        CHECK(found.emission == wanted.emission);
        CHECK(found.bsdf.diffuse == wanted.bsdf.diffuse);
        CHECK(found.bsdf.f0 == wanted.bsdf.f0);
        CHECK(found.bsdf.f90 == wanted.bsdf.f90);
        CHECK(found.bsdf.alpha == wanted.bsdf.alpha);
        painted += wanted.bsdf.diffuse != surfaces.params(p.material).diffuse ? 1 : 0;
        CHECK(wanted.emission != mir::Rgb{1, 2, 3});
        const auto light = lamps.view().lamps.point_on(there.view(), t, at);
        const auto point = lights.lamps().view().point_on(geometry.view(), t, at);
        CHECK(light.radiance == point.radiance);
        CHECK(light.normal == point.normal);
        CHECK(light.pdf_area == point.pdf_area);
        const float u = random.next();
        CHECK(lamps.view().lamps.sample(there.view(), u, at).pdf_area ==
              lights.sample_emitter(u, at).pdf_area);
        const mir::LightReceiver receiver{p.position, p.shading_normal, p.geometric_normal};
        const auto own = lights.tree().view().pick(receiver, static_cast<double>(u));
        const auto copied = lamps.view().tree.pick(receiver, static_cast<double>(u));
        CHECK(copied.light == own.light);
        CHECK(copied.probability == own.probability);
        CHECK(light.radiance != mir::Rgb{1, 2, 3});
    }
    // The lamp of the box is black.
    CHECK(painted >= 8);
}

TEST_CASE("Surfaces shine from their front, and from their back where the material says so") {
    mir::Scene scene;
    scene.add(mir::emitter("lamp", {}, {1, 2, 3}));
    scene.add(mir::emitter("lantern", {}, {4, 5, 6}));
    scene.materials[1].emits_from_both_sides = true;
    const mir::SurfaceTable<mir::Lambert> surfaces(scene);
    const auto emission = [&](std::uint32_t material, bool front) {
        mir::SurfacePoint p;
        p.material = material;
        p.front = front;
        return surfaces.view().surface(p, {0, 0, 1}).emission;
    };
    CHECK(emission(0, true) == mir::Rgb{1, 2, 3});
    CHECK(emission(0, false) == mir::Rgb{});
    CHECK(emission(1, true) == mir::Rgb{4, 5, 6});
    CHECK(emission(1, false) == mir::Rgb{4, 5, 6});
}

TEST_CASE("A geometry without triangles can be uploaded") {
    const mir::WorldGeometry nothing{mir::Scene{}};
    mirtest::PutOff work(0);
    const mirtest::LazyBackend backend(work);
    auto queue = backend.queue();
    const mir::UploadedGeometry<mirtest::LazyBackend> there(backend, queue, nothing);
    queue.record().sync();
    CHECK(there.view().ray_offset == 0.0f);
}
