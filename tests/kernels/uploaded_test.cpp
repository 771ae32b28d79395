// SPDX-License-Identifier: MIT
#include "conformance/stage.hpp"
#include "mir/resident/uploaded_geometry.hpp"
#include "mir/resident/uploaded_surfaces.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

namespace {

/// All that a view may be asked is equal in both.
template <class Point>
bool same(const Point& a, const Point& b) {
    return a.position == b.position && a.geometric_normal == b.geometric_normal &&
           a.shading_normal == b.shading_normal && a.material == b.material && a.front == b.front;
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
