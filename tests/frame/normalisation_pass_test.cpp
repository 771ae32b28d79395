// SPDX-License-Identifier: MIT
#include "runtime/normalisation_pass.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "mir/concepts/archetypes.hpp"
#include "normalise/random_records.hpp"
#include "runtime/host_frame.hpp"
#include "runtime/render_vpls.hpp"
#include "support/catch.hpp"

// Whole renders with a sampler whose records need normalising.

namespace {

using mir::HostScheduler;
using mir::NormalisationPolicy;
using mir::RenderResult;
using mir::RenderSettings;
using mirtest::Approx;
constexpr double path_luminance = mirtest::RandomRecords::path_luminance;

RenderSettings settings(NormalisationPolicy policy = NormalisationPolicy::full) {
    RenderSettings s;
    s.image = {60, 44};
    s.luxels_per_pixel = 1;
    s.vpls = 12;
    s.direct_samples = 1;
    s.tile = {32, 32};
    s.normalisation = policy;
    return s;
}

struct Box {
    mirtest::World world{mirtest::glossy_box()};
    mir::TracedScene traced{std::make_unique<const mirtest::BruteForceScene>(world.geometry)};

    /// `use(frame)` of a frame of the box.
    template <class Use, mir::Executor E>
    RenderResult with(const RenderSettings& s, E& executor, mir::Monitor* monitor,
                      HostScheduler scheduler, const Use& use) const {
        mir::StageClock clock;
        mir::RenderJob job(
            {world.scene, world.geometry, mir::AnyExecutor(executor), monitor, clock}, s);
        return use(*mir::host_frame(job, traced, scheduler));
    }
    template <mir::Executor E>
    RenderResult draw(const RenderSettings& s, E& executor, HostScheduler scheduler,
                      mir::Monitor* monitor = nullptr) const {
        return with(s, executor, monitor, scheduler, [&](mir::RenderFrame& frame) {
            const float bound = mir::choose_bound(frame);
            return render_vpls(frame, sampled(), bound);
        });
    }
    RenderResult draw(const RenderSettings& s) const {
        mir::InlineExecutor executor;
        return draw(s, executor, HostScheduler::cpu_blocks);
    }
    /// Records that need normalising.
    [[nodiscard]] mir::SampledVpls sampled() const {
        mir::InlineExecutor executor;
        const mirtest::RandomRecords sampler(world.geometry, 12, 72);
        return {sampler.sample(executor), mirtest::RandomRecords::normalisation};
    }
};

/// Pixels of any layer that differ in a bit.
std::size_t differences(const RenderResult& a, const RenderResult& b) {
    std::size_t count = mirtest::pixels_that_differ(a.beauty, b.beauty) +
                        mirtest::pixels_that_differ(a.direct, b.direct) +
                        mirtest::pixels_that_differ(a.indirect, b.indirect);
    REQUIRE(a.bounces.size() == b.bounces.size());
    for (std::size_t i = 0; i < a.bounces.size(); ++i)
        count += mirtest::pixels_that_differ(a.bounces[i], b.bounces[i]);
    return count;
}

bool same_intensities(const mir::VplList& a, const mir::VplList& b) {
    bool same = a.size() == b.size();
    for (mir::VplIndex j = 0; same && j < a.size(); ++j)
        same = a.vpls()[j].intensity == b.vpls()[j].intensity;
    return same;
}

}  // namespace

TEST_CASE("A full normalisation gives the image the luminance that the sampler found") {
    const Box box;
    RenderSettings s = settings();
    s.bounce_layers = GENERATE(false, true);
    s.luxels_per_pixel = GENERATE(1u, 2u);
    const RenderResult r = box.draw(s);
    CHECK(r.statistics.normalisation == "full");
    CHECK(r.statistics.path_luminance == path_luminance);
    CHECK(r.statistics.states > 12.0);
    CHECK(r.statistics.dropped_share > 0.0);
    CHECK(r.statistics.indirect_luminance ==
          Approx(path_luminance * (1.0 - r.statistics.dropped_share)).epsilon(1e-5));
    CHECK(r.bounces.size() == (s.bounce_layers ? 5 : 0));
}

TEST_CASE("Bands, tiles, threads and schedulers do not change a bit of a normalised image") {
    const Box box;
    RenderSettings s = settings();
    s.bounce_layers = true;
    const RenderResult wanted = box.draw(s);
    SECTION("bits that do not fit are traced again, in lower bands") {
        // One row of blocks: 4 blocks of 256 luxels, a bit for each of 12 VPLs.
        s.limits.visibility_bytes = GENERATE(1u, 2u) * 4 * 256 * 12 / 8;
        const RenderResult found = box.draw(s);
        CHECK(differences(found, wanted) == 0);
        CHECK(found.statistics.indirect_luminance == wanted.statistics.indirect_luminance);
    }
    SECTION("tiles") {
        s.tile = {16, 48};
        CHECK(differences(box.draw(s), wanted) == 0);
    }
    SECTION("executor and scheduler") {
        mir::archetype::Executor backwards{mir::archetype::make};
        CHECK(differences(box.draw(s, backwards, HostScheduler::cpu), wanted) == 0);
    }
}

TEST_CASE("A limit that not even one row of blocks fits into is an error, not an allocation") {
    const Box box;
    RenderSettings s = settings();
    s.limits.visibility_bytes = 4 * 256 * 12 / 8 - 1;
    try {
        static_cast<void>(box.draw(s));
        FAIL("the limit was passed");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::limit_exceeded);
    }
}

TEST_CASE("A prepass trusts probes only where enough of them are lit") {
    const Box box;
    const RenderResult full = box.draw(settings());
    RenderSettings s = settings(NormalisationPolicy::prepass);
    SECTION("of 40 probes no VPL is seen by 64: all take the full response, bit by bit") {
        s.prepass_luxels = 40;
        const RenderResult guarded = box.draw(s);
        CHECK(guarded.statistics.normalisation == "prepass");
        CHECK(same_intensities(guarded.vpls, full.vpls));
        CHECK(differences(guarded, full) == 0);
    }
    SECTION("many probes come close, and what they hardly see is exact") {
        s.prepass_luxels = 2000;
        const RenderResult probed = box.draw(s);
        const double wanted = path_luminance * (1.0 - full.statistics.dropped_share);
        CHECK(probed.statistics.dropped_share == full.statistics.dropped_share);
        CHECK(probed.statistics.indirect_luminance == Approx(wanted).epsilon(0.15));
        CHECK(probed.statistics.indirect_luminance != Approx(wanted).epsilon(1e-5));
        std::size_t exact = 0;
        for (mir::VplIndex j = 0; j < full.vpls.size(); ++j) {
            const mir::Rgb a = probed.vpls.vpls()[j].intensity;
            const mir::Rgb b = full.vpls.vpls()[j].intensity;
            CHECK(luminance(a) == Approx(luminance(b)).epsilon(0.1).margin(3.0));
            exact += a == b ? 1 : 0;
        }
        CHECK(exact > 0);
        CHECK(exact < full.vpls.size());
    }
}

TEST_CASE("Other policies leave records as they are") {
    const Box box;
    const auto policy = GENERATE(NormalisationPolicy::none, NormalisationPolicy::proposal);
    const RenderResult r = box.draw(settings(policy));
    CHECK(r.statistics.normalisation == to_string(policy));
    CHECK(same_intensities(r.vpls, aggregate(box.sampled().records)));
}

TEST_CASE("Progress ends where it was planned to, whatever the passes") {
    const Box box;
    RenderSettings s = settings(GENERATE(NormalisationPolicy::full, NormalisationPolicy::none));
    s.bounce_layers = GENERATE(false, true);
    if (GENERATE(false, true)) s.limits.visibility_bytes = 4 * 256 * 12 / 8;
    mir::Monitor monitor;
    mir::InlineExecutor executor;
    static_cast<void>(box.draw(s, executor, HostScheduler::cpu_blocks, &monitor));
    CHECK(monitor.planned_contributions > 0);
    CHECK(monitor.contributions == monitor.planned_contributions);
}

TEST_CASE("Instant radiosity stays as it is, and its bound depends on the VPLs asked for alone") {
    const Box box;
    mir::InlineExecutor executor;
    RenderSettings s = settings();
    s.sampler = mir::SamplerKind::instant_radiosity;
    const RenderResult r =
        box.with(s, executor, nullptr, HostScheduler::cpu_blocks,
                 [](mir::RenderFrame& frame) { return mir::render_vpls(frame); });
    CHECK(r.statistics.normalisation == "none");
    CHECK(r.statistics.path_luminance == 0.0);
    CHECK(r.statistics.vpls > 0);
    CHECK(r.statistics.bound > 0.0f);
    CHECK(r.statistics.bound == box.draw(settings()).statistics.bound);
    RenderSettings twice = settings();
    twice.vpls *= 2;
    CHECK(box.draw(twice).statistics.bound == Approx(2 * r.statistics.bound));
}
