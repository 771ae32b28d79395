// SPDX-License-Identifier: MIT
//
// One picture through two ray engines: Embree, and the kd-tree whose bits are those of the GPU
// (tests/cuda/pictures). docs/validation.md, "Pictures by different engines", has the bound.
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/surface_table.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"
#include "support/named_scene.hpp"
#include "support/segment_judge.hpp"

namespace {

using Bsdf = mir::CookTorrance;
using Shading = mir::VplShading<Bsdf>;
using GBuffer = mir::BlockedGBuffer<Bsdf::Params>;

constexpr mir::Extent size{96, 72};

/// Luxels and VPLs of a scene, made with the kd-tree for both engines.
struct Stage {
    explicit Stage(const mir::Scene& scene)
        : geometry(scene),
          lights(scene, geometry),
          surfaces(scene),
          tree(geometry, executor),
          embree(geometry),
          gbuffer(size, size) {
        const mir::CameraRays rays{scene.cameras.front(), mir::luxel_grid(size, 1), 0};
        mir::fill_gbuffer<Bsdf>(gbuffer, 0, rays, tree.ray_caster(), surfaces, executor);
        mir::InstantRadiosityOptions options;
        options.vpls = 128;
        options.emitter_vpls = true;
        using Sampler = mir::InstantRadiositySampler<Bsdf, mir::KdRayCaster<mir::Space::host>>;
        vpls = mir::aggregate(
            Sampler({geometry, lights, surfaces, tree.ray_caster()}, options).sample(executor));
    }

    template <mir::Visibility V>
    [[nodiscard]] mir::Image<mir::Rgb> picture(const V& visibility) {
        return mir::reconstruct(mir::sched::Cpu{executor}, gbuffer, vpls.span(), visibility,
                                Shading{});
    }

    mir::TbbExecutor executor;
    mir::WorldGeometry geometry;
    mir::LightTable lights;
    mir::SurfaceTable<Bsdf> surfaces;
    mir::KdTreeScene tree;
    mir::cpu::EmbreeScene embree;
    GBuffer gbuffer;
    mir::VplList vpls;
};

/// What a luxel gets of the VPLs about which the engines disagree, and of all.
struct Dispute {
    mir::Rgb open;
    mir::Rgb all;
    std::uint64_t rays = 0;
    std::uint64_t different = 0;
    std::uint64_t beyond_rounding = 0;  ///< of the different ones
};

template <mir::Visibility A, mir::Visibility B>
Dispute dispute(const Stage& stage, const mirtest::SegmentJudge& judge, mir::LuxelIndex i,
                const A& a, const B& b) {
    const auto luxels = stage.gbuffer.view(0);
    const mir::Hit hit = luxels.hit(i);
    Dispute d;
    if (is_empty(hit)) return d;
    for (const mir::Vpl& vpl : stage.vpls.vpls()) {
        if (!mir::faces(hit, vpl)) continue;
        ++d.rays;
        const mir::Rgb shaded = Shading{}(hit, luxels.surface(i), vpl);
        d.all += shaded;
        if (a.visible(vpl.position, hit.position) == b.visible(vpl.position, hit.position))
            continue;
        ++d.different;
        d.beyond_rounding += judge.judge({vpl.position, hit.position}).within_rounding() ? 0u : 1u;
        d.open += shaded;
    }
    return d;
}

/// |x - y| of one channel is at most what is open, and both sums' rounding: n additions of numbers
/// that are not negative.
bool is_explained(float x, float y, float open, float all, std::size_t n) {
    const double rounding = 2.0 * static_cast<double>(n) * 0x1p-24 * static_cast<double>(all);
    return std::fabs(static_cast<double>(x) - static_cast<double>(y)) <=
           static_cast<double>(open) + rounding;
}

}  // namespace

TEST_CASE("Pictures by Embree and by the kd-tree differ by the pairs that the two disagree about",
          "[extended]") {
    std::uint64_t rays = 0;
    std::uint64_t different = 0;
    for (const mirtest::NamedScene& named : mirtest::picture_scenes()) {
        const auto scene = mirtest::load_opaque_scene(named.name, named.file);
        if (!scene) {
            WARN("skipped: " << named.file << " is not on this machine");
            continue;
        }
        INFO(named.name);
        Stage stage(*scene);
        const auto embree = stage.embree.visibility();
        const auto tree = stage.tree.visibility();
        const mir::Image<mir::Rgb> a = stage.picture(embree);
        const mir::Image<mir::Rgb> b = stage.picture(tree);
        const auto layout = mir::BlockedLayout::of(stage.gbuffer.tiles().front());
        const mirtest::SegmentJudge judge(stage.geometry);
        std::uint64_t unexplained = 0;
        std::uint64_t beyond_rounding = 0;
        for (std::uint32_t y = 0; y < size.height; ++y)
            for (std::uint32_t x = 0; x < size.width; ++x) {
                const Dispute d = dispute(stage, judge, layout(x, y), embree, tree);
                rays += d.rays;
                different += d.different;
                beyond_rounding += d.beyond_rounding;
                const std::size_t n = d.different == 0 ? 0 : stage.vpls.size();
                const mir::Rgb p = a(x, y);
                const mir::Rgb q = b(x, y);
                unexplained += is_explained(p.r, q.r, d.open.r, d.all.r, n) &&
                                       is_explained(p.g, q.g, d.open.g, d.all.g, n) &&
                                       is_explained(p.b, q.b, d.open.b, d.all.b, n)
                                   ? 0u
                                   : 1u;
            }
        CHECK(unexplained == 0);
        CHECK(beyond_rounding == 0);
    }
    CHECK(rays > 1'000'000);
    CHECK(different <= rays / 1000);
}
