// SPDX-License-Identifier: MIT
//
// Light paths of a frame that keeps everything in a backend's memory, the host's here, against
// those of the host: the same bits.
#include "frame/drawn_frames.hpp"
#include "support/catch.hpp"
#include "support/masked_scene.hpp"
#include "support/test_sky.hpp"

#include <array>

namespace {

using mir::InstantRadiosityOptions;
using mir::Rgb;
using mir::Scene;
using mir::VplRecord;

/// A frame of the host and one in a backend's memory, of the same picture.
struct TwoFrames {
    explicit TwoFrames(Scene s)
        : scene(std::move(s)),
          job({scene, geometry, mir::AnyExecutor(executor), nullptr, clock}, settings),
          there(job, mirtest::HostBackend(executor),
                []() -> std::shared_ptr<const mir::KdTree> {
                    throw std::logic_error("a tree of the host was asked for");
                },
                {}) {}

    Scene scene;
    mir::RenderSettings settings = mirtest::small_picture();
    mir::WorldGeometry geometry{scene};
    mir::InlineExecutor executor;
    mir::StageClock clock;
    mir::RenderJob job;
    mir::TracedScene traced{std::make_unique<const mir::KdTreeScene>(geometry)};
    std::unique_ptr<mir::RenderFrame> host = mir::host_frame(job, traced, mir::HostScheduler::cpu);
    mirtest::FrameThere there;
};

bool is_same(Rgb a, Rgb b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

bool is_same(const VplRecord& a, const VplRecord& b) {
    return is_same_vpl(a, b) && a.vpl.position == b.vpl.position &&
           is_same(a.vpl.intensity, b.vpl.intensity) && a.bounce == b.bounce &&
           a.light_group == b.light_group && a.weight == b.weight && a.lobe_share == b.lobe_share;
}

/// Records of `a` that are others in `b`; all of them where there are more or fewer.
std::size_t others(const mir::VplRecords& a, const mir::VplRecords& b) {
    if (a.records.size() != b.records.size()) return a.records.size();
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.records.size(); ++i)
        count += is_same(a.records[i], b.records[i]) ? 0 : 1;
    return count;
}

void check_same_records(const mir::VplRecords& a, const mir::VplRecords& b) {
    CHECK(a.paths == b.paths);
    CHECK(a.emitted_power == b.emitted_power);
    CHECK(a.non_lambertian_share == b.non_lambertian_share);
    REQUIRE(a.records.size() == b.records.size());
    CHECK(others(a, b) == 0);
}

Scene glazed_room() {
    Scene scene = mirtest::lit_room();
    mir::Material pane = mir::lambertian("pane", {0.9f, 0.8f, 0.7f});
    pane.specular = 1.0f;
    pane.roughness = 0.0f;
    pane.transmission = 0.9f;
    scene.place(mir::builtin::quad("pane", scene.add(pane), {-0.9f, 0.4f, -0.2f}, {0.8f, 0, 0},
                                   {0, 0.9f, 0.1f}));
    mirtest::hang_curtain(scene, mir::lambertian("curtain", {0.7f, 0.6f, 0.5f}), 6,
                          {-0.6f, 1.3f, -0.5f}, {1.2f, 0.1f, 0.0f}, {0.0f, -0.1f, 1.1f});
    scene.environment = mirtest::test_sky();
    return scene;
}

}  // namespace

TEST_CASE(
    "Light paths in a backend's memory leave the VPLs of the host, whatever they are made of") {
    InstantRadiosityOptions options;
    options.vpls = 700;
    options.seed = 12;
    SECTION("by roulette") {}
    SECTION("from lamps on") { options.emitter_vpls = true; }
    SECTION("by a Halton sequence") { options.sequence = mir::Sequence::halton; }
    SECTION("by levels") { options.termination = mir::Termination::levels; }
    SECTION("by levels, from lamps on") {
        options.termination = mir::Termination::levels;
        options.emitter_vpls = true;
        options.max_bounce = 3;
    }
    for (const Scene& scene : {mirtest::lit_room(), glazed_room()}) {
        TwoFrames frames(scene);
        const mir::VplRecords here = frames.host->sample_light_paths(options);
        CHECK(here.records.size() > 150);
        check_same_records(here, frames.there.sample_light_paths(options));
    }
}

TEST_CASE("Light paths of another seed in a backend's memory are told from those of the host") {
    TwoFrames frames(mirtest::lit_room());
    InstantRadiosityOptions options;
    const mir::VplRecords here = frames.host->sample_light_paths(options);
    options.seed = 1;
    CHECK(others(here, frames.there.sample_light_paths(options)) > here.records.size() / 2);
}

TEST_CASE("Light paths of a dark scene leave nothing in a backend's memory, as on the host") {
    Scene scene = mirtest::lit_room();
    for (mir::Material& m : scene.materials) m.emission = {};
    scene.point_lights.clear();
    scene.spot_lights.clear();
    scene.directional_lights.clear();
    TwoFrames frames(scene);
    CHECK(frames.there.sample_light_paths({}).records.empty());
    CHECK(frames.host->sample_light_paths({}).records.empty());
}

TEST_CASE("A backend knows P_c by light paths as well as the host does, to the last bit") {
    const Scene scene = GENERATE(0, 1) == 0 ? mirtest::lit_room() : glazed_room();
    // Few records, each looked at by all luxels; some by a part of them; and more than are looked
    // at.
    const std::uint32_t vpls = GENERATE(60u, 5000u, 40000u);
    CAPTURE(vpls);
    TwoFrames frames(scene);
    InstantRadiosityOptions options;
    options.vpls = vpls;
    const mir::VplRecords records = frames.host->sample_light_paths(options);
    const mir::PathLuminance here = frames.host->light_path_luminance(records, 3.0f);
    const mir::PathLuminance there = frames.there.light_path_luminance(records, 3.0f);
    CHECK(here.mean > 0.0);
    CHECK(there.mean == here.mean);
    CHECK(there.standard_error == here.standard_error);
    CHECK(there.paths == here.paths);
    CHECK(there.contributing == here.contributing);
}

TEST_CASE("Light that glass throws has the splats of the host in a backend's memory") {
    TwoFrames frames(mir::builtin::make("caustics"));
    const mir::CausticPaths paths{20000, 8, mir::Sequence::random, 3};
    const auto here = frames.host->trace_caustics(paths, 100, 20000);
    const auto there = frames.there.trace_caustics(paths, 100, 20000);
    CHECK(here.size() > 100);
    REQUIRE(there.size() == here.size());
    std::size_t other = 0;
    for (std::size_t i = 0; i < here.size(); ++i)
        other += here[i].x == there[i].x && here[i].y == there[i].y &&
                         here[i].bounce == there[i].bounce &&
                         is_same(here[i].radiance, there[i].radiance)
                     ? 0
                     : 1;
    CHECK(other == 0);
}

TEST_CASE("Luxels of probes have the same bits in a backend's memory, behind glass too") {
    TwoFrames frames(glazed_room());
    const mir::ProbeRays probes(frames.scene.cameras[0], 1.5f, 300, 4);
    const mir::BandPtr here = frames.host->trace(probes);
    const mir::BandPtr there = frames.there.trace(probes);
    REQUIRE(here->extent() == there->extent());
    const auto light = [](mir::RenderFrame& frame, const mir::FrameBand& band) {
        const mir::LayerPtr direct = frame.direct(band, mir::DirectSamples(4));
        return frame.row_luminances(*direct);
    };
    CHECK(light(*frames.host, *here) == light(frames.there, *there));
}

TEST_CASE("A backend that keeps no arrivals of light refuses to be asked for them") {
    TwoFrames frames(mirtest::lit_room());
    InstantRadiosityOptions options;
    options.arrivals = true;
    CHECK_THROWS_AS(frames.there.sample_light_paths(options), mir::Error);
    options.arrivals = false;
    options.vpls = 0;
    CHECK_THROWS_AS(frames.there.sample_light_paths(options), mir::Error);
}
