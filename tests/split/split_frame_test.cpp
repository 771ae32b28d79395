// SPDX-License-Identifier: MIT
//
// Pictures by several frames at the same time against those of one: the same bytes.
#include "runtime/split_frame.hpp"

#include "frame/same_result.hpp"
#include "mir/runtime/mean_luminances.hpp"
#include "mir/scenes.hpp"
#include "runtime/host_frame.hpp"
#include "runtime/render_paths.hpp"
#include "runtime/render_vpls.hpp"
#include "runtime/traced_scenes.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <thread>

namespace {

using mir::BandTurn;
using mir::InlineExecutor;
using mir::RenderFrame;
using mir::RenderResult;
using mir::RenderSettings;
using mirtest::check_same;
using Frames = std::vector<std::unique_ptr<RenderFrame>>;

/// A scene, and frames of a job over it. Their loops run on the threads that split frames make.
struct Picture {
    explicit Picture(RenderSettings wanted, mir::Monitor* monitor = nullptr,
                     mir::Scene drawn = mir::builtin::cornell_box(mir::builtin::Lamp::down))
        : settings(std::move(wanted)),
          scene(std::move(drawn)),
          job({scene, geometry, mir::AnyExecutor(executor), monitor, clock}, settings) {}

    [[nodiscard]] std::unique_ptr<RenderFrame> frame() {
        return mir::host_frame(job, *traced, mir::HostScheduler::cpu_blocks);
    }
    [[nodiscard]] mir::SplitFrame split(std::size_t parts) {
        Frames frames;
        while (frames.size() < parts) frames.push_back(frame());
        return {job, std::move(frames)};
    }

    RenderSettings settings;
    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    InlineExecutor executor;
    mir::AnyExecutor loops{executor};
    mir::TracedScenePtr traced = mir::trace_by_kd_tree(geometry, loops);
    mir::StageClock clock;
    mir::RenderJob job;
};

RenderResult drawn(const RenderSettings& settings, std::size_t parts,
                   mir::Monitor* monitor = nullptr,
                   mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down)) {
    Picture picture(settings, monitor, std::move(scene));
    mir::SplitFrame frame = picture.split(parts);
    return mir::render_vpls(frame);
}

RenderResult drawn_by_one(const RenderSettings& settings,
                          mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down)) {
    Picture picture(settings, nullptr, std::move(scene));
    return mir::render_vpls(*picture.frame());
}

/// Bands of 16 rows of pixels.
RenderSettings small_picture() {
    RenderSettings s;
    s.image = {21, 37};
    s.luxels_per_pixel = 4;
    s.vpls = 12;
    s.direct_samples = 4;
    s.tile = {32, 16};
    s.measure_missing = false;  // takes longer than such a picture
    s.removed_layer = true;
    s.metropolis.bootstrap.min_paths = s.metropolis.bootstrap.max_paths = 1024;
    return s;
}

/// The box with a mirror for a block, and a clear one.
mir::Scene glass() {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    mir::Material mirror;
    mirror.metallic = 1.0f;
    mirror.roughness = 0.0f;
    mir::Material clear;
    clear.roughness = 0.0f;
    clear.transmission = 1.0f;
    clear.is_thin = false;
    const std::uint32_t first = scene.add(mirror);
    const std::uint32_t second = scene.add(clear);
    for (mir::Mesh& mesh : scene.meshes) {
        if (mesh.name == "tall block") mesh.material = first;
        if (mesh.name == "short block") mesh.material = second;
    }
    return scene;
}

/// The same picture with all rows.
RenderSettings small_whole(RenderSettings s) {
    s.rows = {};
    return s;
}

}  // namespace

TEST_CASE("Frames that share a picture give the bytes of one") {
    RenderSettings s = small_picture();
    s.bounce_layers = true;
    const RenderResult one = drawn_by_one(s);
    CHECK(one.statistics.indirect_luminance > 0.0);
    CHECK(one.statistics.removed_luminance > 0.0);
    for (const std::size_t parts : {1u, 2u, 3u}) {
        CAPTURE(parts);
        check_same(drawn(s, parts), one);
    }
}

TEST_CASE("Filters reach across the bands of several frames, however low those are") {
    RenderSettings s = small_picture();
    s.luxels_per_pixel = GENERATE(1u, 9u);
    s.image = {9, 70};
    s.vpls = 4;
    s.removed_layer = false;
    s.filter = mir::default_filter(
        GENERATE(mir::FilterKind::box, mir::FilterKind::mitchell, mir::FilterKind::lanczos));
    // As far as two bands are high.
    if (s.filter.kind == mir::FilterKind::mitchell) s.filter.half_width = 16.0f;
    check_same(drawn(s, 3), drawn_by_one(s));
}

TEST_CASE("More frames than bands, stored visibility and passes change nothing") {
    RenderSettings s = small_picture();
    SECTION("more frames than bands") {
        s.image = {16, 9};
        s.luxels_per_pixel = 1;
        check_same(drawn(s, 3), drawn_by_one(s));
    }
    SECTION("visibility of one row of blocks at a time, which no frame keeps") {
        s.limits.visibility_bytes = std::uint64_t{3} * 256 * 12 / 8 * 2;
        check_same(drawn(s, 2), drawn_by_one(s));
    }
    SECTION("a prepass, some VPLs of which need the whole image") {
        s.normalisation = mir::NormalisationPolicy::prepass;
        s.prepass_luxels = 200;
        check_same(drawn(s, 2), drawn_by_one(s));
    }
    SECTION("light paths") {
        s.sampler = mir::SamplerKind::instant_radiosity;
        check_same(drawn(s, 2), drawn_by_one(s));
    }
    SECTION("passes of other seeds") {
        s.seed = 7;
        check_same(drawn(s, 2), drawn_by_one(s));
    }
}

TEST_CASE("Rows of a picture have its bits, by one frame or several") {
    RenderSettings s = small_picture();
    s.bounce_layers = true;
    const RenderResult whole = drawn_by_one(s);
    for (const mir::PixelRows rows :
         {mir::PixelRows{0, 1}, mir::PixelRows{9, 17}, mir::PixelRows{36, 1}}) {
        s.rows = rows;
        RenderResult cut = drawn_by_one(small_whole(s));
        mir::blacken_other_rows(rows, cut);
        cut.statistics.indirect_luminance = cut.statistics.removed_luminance = 0.0;
        for (std::uint32_t y = rows.first * 2; y < (rows.first + rows.count) * 2; ++y)
            mir::add_row(cut.statistics, whole.luminances[y]);
        for (const std::size_t parts : {0u, 1u, 3u}) {
            CAPTURE(rows.first, rows.count, parts);
            check_same(parts == 0 ? drawn_by_one(s) : drawn(s, parts), cut);
        }
    }
}

TEST_CASE("Frames of the host share spheres, lobes, light that is traced back, and cuts") {
    RenderSettings s = small_picture();
    s.sampler = mir::SamplerKind::instant_radiosity;
    s.removed_layer = false;
    SECTION("spheres") { s.vsl.enabled = true; }
    SECTION("lobes") { s.glossy.enabled = true; }
    SECTION("traced back") { s.compensate = 4; }
    SECTION("cuts") {
        s.sum = mir::LightSum::cuts;
        s.picks = 4;
        s.pick_error_layer = true;
    }
    check_same(drawn(s, 2), drawn_by_one(s));
}

TEST_CASE("Frames of the host share paths") {
    RenderSettings s = small_picture();
    s.integrator = mir::Integrator::path;
    s.path.samples = 1;
    s.removed_layer = false;
    Picture one(s);
    Picture two(s);
    mir::SplitFrame frame = two.split(2);
    check_same(mir::render_paths(frame), mir::render_paths(*one.frame()));
}

TEST_CASE("A band goes to the same frame in every loop, and turns come from top to bottom") {
    Picture picture(small_picture());
    mir::SplitFrame frame = picture.split(3);
    CHECK(frame.traits().parts == 3);
    constexpr std::uint32_t bands = 40;
    std::vector<RenderFrame*> makers(bands);
    for (int loop = 0; loop < 3; ++loop) {
        std::vector<std::uint32_t> order;
        bool same = true;
        frame.for_each_band(bands, [&](RenderFrame& by, std::uint32_t i, BandTurn& turn) {
            if (i % 5 == 0) std::this_thread::yield();
            turn.wait();
            order.push_back(i);
            same = same && (loop == 0 || makers[i] == &by);
            makers[i] = &by;
        });
        CHECK(same);
        REQUIRE(order.size() == bands);
        CHECK(std::is_sorted(order.begin(), order.end()));
    }
}

TEST_CASE("Frames work at the same time") {
    Picture picture(small_picture());
    mir::SplitFrame frame = picture.split(2);
    // Neither band ends before both have begun.
    std::atomic<int> begun{0};
    frame.for_each_band(2, [&](RenderFrame&, std::uint32_t, BandTurn&) {
        ++begun;
        while (begun < 2) std::this_thread::yield();
    });
    CHECK(begun == 2);
}

TEST_CASE("What fails in one frame reaches the caller, and ends the work of all") {
    Picture picture(small_picture());
    mir::SplitFrame frame = picture.split(3);
    std::atomic<std::uint32_t> last{0};
    const auto fail_at = [&](std::uint32_t bad) {
        frame.for_each_band(1000, [&](RenderFrame&, std::uint32_t i, BandTurn& turn) {
            last = std::max(last.load(), i);
            if (i == bad) throw mir::Error(mir::ErrorCode::out_of_memory, "this one is full");
            turn.wait();
        });
    };
    for (const std::uint32_t bad : {0u, 1u, 7u}) {
        try {
            fail_at(bad);
            FAIL("nothing was thrown");
        } catch (const mir::Error& e) {
            CHECK(e.code() == mir::ErrorCode::out_of_memory);
        }
        CHECK(last < 12);
    }
    CHECK_NOTHROW(fail_at(1000));
}

TEST_CASE("A render by several frames can be cancelled, and its progress ends where planned") {
    RenderSettings s = small_picture();
    mir::Monitor monitor;
    static_cast<void>(drawn(s, 2, &monitor));
    CHECK(monitor.contributions == monitor.planned_contributions);
    CHECK(monitor.looping_contributions == 0);
    CHECK(monitor.planned_bands > 2);
    CHECK(monitor.bands == monitor.planned_bands);
    monitor.cancelled = true;
    try {
        static_cast<void>(drawn(s, 2, &monitor));
        FAIL("nothing was thrown");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::cancelled);
    }
}

TEST_CASE("A picture is split among one frame at least") {
    Picture picture(small_picture());
    CHECK_THROWS_AS(mir::SplitFrame(picture.job, Frames{}), mir::Error);
}

TEST_CASE("Frames share caustics, rows have theirs, and their sums are those of the picture") {
    RenderSettings s = small_picture();
    s.bounce_layers = GENERATE(false, true);
    s.caustics = 8;
    const RenderResult one = drawn_by_one(s, glass());
    CHECK(one.statistics.caustic_luminance > 0.0);
    for (const std::size_t parts : {1u, 3u}) {
        CAPTURE(parts);
        const RenderResult shared = drawn(s, parts, nullptr, glass());
        check_same(shared, one);
        CHECK(shared.statistics.caustic_luminance == one.statistics.caustic_luminance);
    }
    RenderSettings without = s;
    without.caustics = 0;
    const RenderResult dark = drawn_by_one(without, glass());
    const auto mean = [](const mir::Image<mir::Rgb>& image) {
        double sum = 0.0;
        for (const mir::Rgb& c : image.pixels()) sum += static_cast<double>(luminance(c));
        return sum / static_cast<double>(image.extent().area());
    };
    // A box filter leaves the mean of the luxels.
    s.filter = without.filter = mir::default_filter(mir::FilterKind::box);
    const RenderResult boxes = drawn_by_one(s, glass());
    const RenderResult dark_boxes = drawn_by_one(without, glass());
    CHECK(mean(boxes.beauty) - mean(dark_boxes.beauty) ==
          Approx(one.statistics.caustic_luminance).epsilon(1e-3));
    CHECK(mean(boxes.direct) - mean(dark_boxes.direct) ==
          Approx(one.statistics.caustic_direct_luminance).epsilon(1e-3));
    CHECK(one.statistics.caustic_direct_luminance > 0.0);
    CHECK(one.statistics.caustic_direct_luminance < one.statistics.caustic_luminance);
    CHECK(dark.statistics.caustic_luminance == 0.0);
    CHECK(dark.statistics.caustic_direct_luminance == 0.0);

    s.rows = {9, 17};
    RenderResult cut = drawn_by_one(small_whole(s), glass());
    mir::blacken_other_rows(s.rows, cut);
    mir::clear_rows(cut.statistics);
    for (std::uint32_t y = s.rows.first * 2; y < (s.rows.first + s.rows.count) * 2; ++y)
        mir::add_row(cut.statistics, one.luminances[y]);
    for (const std::size_t parts : {0u, 3u}) {
        CAPTURE(parts);
        const RenderResult rows =
            parts == 0 ? drawn_by_one(s, glass()) : drawn(s, parts, nullptr, glass());
        check_same(rows, cut);
        CHECK(rows.statistics.caustic_luminance == cut.statistics.caustic_luminance);
    }
}
