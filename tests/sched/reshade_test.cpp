// SPDX-License-Identifier: MIT
#include "mir/reshade.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/scheduler_suite.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "support/catch.hpp"

#include <atomic>

// Reconstruction from bits: the image of tracing, in every bit, without a ray.

namespace {

using mir::Rgb;
using mir::VisibilityMatrix;

/// Brute force that counts the segments it is asked about.
struct CountingVisibility {
    static constexpr mir::Space space = mir::Space::host;
    mirtest::BruteForceVisibility brute;
    std::atomic<std::uint64_t>* segments;

    [[nodiscard]] bool visible(mir::Vec3 a, mir::Vec3 b) const {
        ++*segments;
        return brute.visible(a, b);
    }
    [[nodiscard]] std::uint32_t visible_packet(mir::Vec3 origin, const mir::PointPacket& points,
                                               std::uint32_t active) const {
        *segments += static_cast<std::uint64_t>(std::popcount(active));
        return brute.visible_packet(origin, points, active);
    }
};

template <mir::Bsdf B>
struct Scenery {
    mirtest::Stage<B, mirtest::BruteForceScene> stage{{70, 50}, {48, 32}, 23};
    mutable std::atomic<std::uint64_t> segments{0};
    CountingVisibility visibility{stage.visibility(), &segments};
    VisibilityMatrix matrix{stage.gbuffer().tiles(), stage.vpls().size()};
    mutable mir::InlineExecutor executor;

    Scenery() { fill_visibility(matrix, stage.gbuffer(), stage.vpls(), visibility, executor); }

    /// Pixels in which tracing and reshading differ; reshading must not trace.
    template <class S, class F>
    std::size_t differences(const S& scheduler, mir::VplSpan<mir::Space::host> vpls,
                            const F& shading) const {
        const auto traced = reconstruct(scheduler, stage.gbuffer(), vpls, visibility, shading);
        const std::uint64_t before = segments;
        const auto found = reshade(scheduler, stage.gbuffer(), vpls, matrix, shading);
        REQUIRE(segments == before);
        return mirtest::pixels_that_differ(found, traced);
    }
    template <class F>
    std::size_t differences(mir::VplSpan<mir::Space::host> vpls, const F& shading) const {
        return differences(mir::sched::Cpu{executor}, vpls, shading) +
               differences(mir::sched::CpuBlocks{executor}, vpls, shading);
    }
};

}  // namespace

TEMPLATE_TEST_CASE("Reshading gives the bits of tracing and traces no ray", "", mir::Lambert,
                   mir::CookTorrance) {
    const Scenery<TestType> s;
    REQUIRE(s.segments > 10000);
    CHECK(s.differences(s.stage.vpls(), mir::VplShading<TestType>{}) == 0);
    CHECK(s.differences(s.stage.vpls(), mir::VplShading<TestType>{2.0f}) == 0);
    CHECK(s.differences(s.stage.vpls(), mir::RemovedByBound<TestType>{2.0f}) == 0);
}

TEST_CASE("Intensities may change between filling and shading") {
    const Scenery<mir::CookTorrance> s;
    std::vector<mir::Vpl> vpls;
    for (mir::VplIndex j = 0; j < s.stage.vpls().size(); ++j) {
        vpls.push_back(s.stage.vpls()[j]);
        vpls.back().intensity = j % 2 == 0 ? Rgb{} : Rgb{0, static_cast<float>(j), 1};
    }
    CHECK(s.differences(mir::span_of(vpls), mir::VplShading<mir::CookTorrance>{}) == 0);
}

TEST_CASE("A wrong bit is seen in the image") {
    Scenery<mir::Lambert> s;
    const mir::VplShading<mir::Lambert> shading{};
    constexpr mir::VplIndex j = 10;
    const auto bits = s.matrix.view();
    const auto luxels = s.stage.gbuffer().view(0);
    mir::LuxelIndex lit = 0;
    while (!bits.sees(0, lit, j) || !shading.reflects(luxels.surface(lit)))
        REQUIRE(++lit < luxels.size());
    s.matrix.store(0, lit / 16, j, bits.mask(0, lit / 16, j) ^ 1u << lit % 16);
    CHECK(s.differences(mir::sched::Cpu{s.executor}, s.stage.vpls(), shading) == 1);
    CHECK(s.differences(mir::sched::CpuBlocks{s.executor}, s.stage.vpls(), shading) == 1);
}

TEST_CASE("No ray is traced for black VPLs") {
    const Scenery<mir::Lambert> s;
    std::vector<mir::Vpl> black;
    for (mir::VplIndex j = 0; j < s.stage.vpls().size(); ++j) black.push_back(s.stage.vpls()[j]);
    for (mir::Vpl& vpl : black) vpl.intensity = {};
    s.segments = 0;
    const mir::VplShading<mir::Lambert> shading{};
    const auto draw = [&](const auto& scheduler) {
        return reconstruct(scheduler, s.stage.gbuffer(), mir::span_of(black), s.visibility,
                           shading);
    };
    const mir::Image<Rgb> nothing(s.stage.gbuffer().extent());
    CHECK(mirtest::pixels_that_differ(draw(mir::sched::Cpu{s.executor}), nothing) == 0);
    CHECK(mirtest::pixels_that_differ(draw(mir::sched::CpuBlocks{s.executor}), nothing) == 0);
    CHECK(s.segments == 0);
}

TEST_CASE("A matrix of other luxels or VPLs is refused before anything is shaded") {
    const Scenery<mir::Lambert> s;
    const mir::VplShading<mir::Lambert> shading{};
    const VisibilityMatrix other_vpls(s.stage.gbuffer().tiles(), 22);
    const VisibilityMatrix other_tiles({{0, 0, 16, 16}}, 23);
    for (const VisibilityMatrix* matrix : {&other_vpls, &other_tiles})
        CHECK_THROWS_AS(reshade(mir::sched::Cpu{s.executor}, s.stage.gbuffer(), s.stage.vpls(),
                                *matrix, shading),
                        mir::Error);
}
