// SPDX-License-Identifier: MIT
#include "mir/kernels/primary_hits.hpp"

#include "conformance/stage.hpp"
#include "kernels/brute_finder.hpp"
#include "mir/host/backend.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/resident/trace_primary_hits.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"
#include "support/test_sky.hpp"

namespace {

using mir::Extent;

/// A lamp that shines from both sides, glossy walls, smooth normals, and some empty luxels.
mir::Scene scene() {
    mir::Scene s = mirtest::glossy_box();
    s.place(mir::builtin::sphere("ball", 0, {0.3f, 0.4f, 0.5f}, 0.3f, 12, 6));
    for (mir::Material& m : s.materials)
        if (m.emits()) m.emits_from_both_sides = true;
    return s;
}

/// A scene, and its luxels by fill_gbuffer() and by kernels.
template <mir::Bsdf F>
class Camera {
 public:
    using Host = mir::BlockedGBuffer<typename F::Params>;

    mir::CameraRays rays;

    explicit Camera(Extent pixels, std::uint32_t luxels_per_pixel = 1) {
        rays.camera = scene_.cameras.front();
        rays.grid = mir::luxel_grid(pixels, luxels_per_pixel);
        rays.seed = 23;
    }

    [[nodiscard]] Host by_host(Extent extent, Extent tile, std::uint32_t first_row = 0) const {
        Host g(extent, tile);
        mir::InlineExecutor executor;
        const mir::LuxelTracer tracer{caster(geometry_.view()), surfaces_.view()};
        fill_gbuffer(g, first_row, rays, tracer, sky_.view(), executor);
        return g;
    }

    template <mir::Backend B>
    [[nodiscard]] Host by_kernels(const B& backend, Extent extent, Extent tile,
                                  std::uint32_t first_row = 0) const {
        Host g(extent, tile);
        auto queue = backend.queue();
        const mir::UploadedGeometry<B> geometry(backend, queue, geometry_);
        const mir::UploadedSurfaces<B, F> surfaces(backend, queue, surfaces_);
        const mir::UploadedEnvironment<B> sky(backend, queue, sky_);
        mir::BackendGBuffer<B, typename F::Params> there(backend, extent, tile);
        const mir::LuxelTracer tracer{caster(geometry.view()), surfaces.view()};
        trace_primary_hits(queue, there, first_row, rays.luxel_rays(), tracer, sky.view());
        there.download(queue, g);
        queue.record().sync();
        return g;
    }

 private:
    [[nodiscard]] mirtest::BruteFinderCaster caster(
        const mir::GeometryView<mir::Space::host>& geometry) const {
        const float magnitude = mir::larger(mir::max_abs(geometry_.bounds().low),
                                            mir::max_abs(geometry_.bounds().high));
        return {geometry,
                {rows_.data(), static_cast<std::uint32_t>(rows_.size()), 1.5f * magnitude}};
    }

    mir::Scene scene_ = scene();
    mir::WorldGeometry geometry_{scene_};
    mir::SurfaceTable<F> surfaces_{scene_};
    mir::EnvironmentTable sky_{mirtest::test_sky()};
    std::vector<mir::TriangleRows> rows_ = mirtest::rows_of(geometry_);
};

template <class G>
std::size_t words_that_differ(const G& a, const G& b) {
    if (a.words().size() != b.words().size()) return static_cast<std::size_t>(-1);
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.words().size(); ++i) count += a.words()[i] != b.words()[i];
    return count;
}

template <class G>
std::size_t luxels_with_hits(const G& g) {
    std::size_t count = 0;
    for (mir::TileIndex t = 0; t < g.tiles().size(); ++t)
        for (mir::LuxelIndex i = 0; i < g.view(t).size(); ++i)
            count += is_empty(g.view(t).hit(i)) ? 0u : 1u;
    return count;
}

}  // namespace

TEMPLATE_TEST_CASE("Primary hits by kernels have the words of those on the host", "", mir::Lambert,
                   mir::CookTorrance) {
    const Extent image{100, 70};
    const Camera<TestType> camera(image);
    mir::TbbExecutor executor(2);
    const mir::host::Backend backend(executor);
    const Extent tile = GENERATE(Extent{48, 32}, Extent{16, 16}, Extent{20, 13}, Extent{256, 512});
    const auto wanted = camera.by_host(image, tile);
    // Some luxels see the box, others pass it.
    CHECK(luxels_with_hits(wanted) > 1000);
    CHECK(luxels_with_hits(wanted) < 6990);
    CHECK(words_that_differ(camera.by_kernels(backend, image, tile), wanted) == 0);
}

TEST_CASE("Primary hits of many luxels per pixel and of a lens are those of the host") {
    Camera<mir::CookTorrance> camera({30, 20}, 6);
    camera.rays.camera.lens_radius = GENERATE(0.0f, 0.1f);
    camera.rays.camera.focus_distance = 3.0f;
    const Extent luxels = camera.rays.grid.luxels();
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    const auto wanted = camera.by_host(luxels, {32, 32});
    CHECK(words_that_differ(camera.by_kernels(backend, luxels, {32, 32}), wanted) == 0);
}

TEST_CASE("Primary hits of a band of rows are those of these rows of the image") {
    const Camera<mir::Lambert> camera({100, 70});
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    const auto found = camera.by_kernels(backend, {100, 22}, {48, 16}, 48);
    CHECK(words_that_differ(found, camera.by_host({100, 22}, {48, 16}, 48)) == 0);
    CHECK(words_that_differ(found, camera.by_host({100, 22}, {48, 16}, 0)) > 1000);
}

TEST_CASE("Every word of primary hits is written, however late") {
    const Camera<mir::CookTorrance> camera({50, 30});
    mirtest::PutOff work(GENERATE(0u, 1u));
    const mirtest::LazyBackend backend(work);
    const auto wanted = camera.by_host({50, 30}, {32, 16});
    CHECK(words_that_differ(camera.by_kernels(backend, {50, 30}, {32, 16}), wanted) == 0);
}
