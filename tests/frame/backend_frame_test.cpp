// SPDX-License-Identifier: MIT
//
// Whole pictures by a frame that keeps everything in a backend's memory, the host's here, against
// those of the host's own stages: the same bits.
#include "frame/drawn_frames.hpp"
#include "frame/same_result.hpp"
#include "support/catch.hpp"
#include "support/masked_scene.hpp"
#include "support/test_sky.hpp"
#include "support/textured_scene.hpp"

#include <algorithm>
#include <barrier>

namespace {

using mir::BackendFrameOptions;
using mir::BackendScheduler;
using mir::InlineExecutor;
using mir::RenderResult;
using mir::RenderSettings;
using mir::Scene;
using mirtest::check_same;
using mirtest::draw_on_backend;
using mirtest::draw_on_host;
using mirtest::draw_split;
using mirtest::lit_room;
using mirtest::small_picture;

}  // namespace

TEST_CASE("A frame in a backend's memory has the bits of the host's, whatever its structures") {
    const Scene scene = lit_room();
    RenderSettings settings = small_picture();
    settings.bounce_layers = GENERATE(false, true);
    settings.removed_layer = true;
    const RenderResult host = draw_on_host(scene, settings);
    CHECK(host.statistics.removed_luminance > 0.0);
    CHECK(host.statistics.indirect_luminance > 0.0);
    CHECK(host.removed.extent() == settings.image);
    for (const BackendFrameOptions& options :
         {BackendFrameOptions{BackendScheduler::rcvp, true, false},
          BackendFrameOptions{BackendScheduler::rcvp, true, true},
          BackendFrameOptions{BackendScheduler::rcvp, false, true}}) {
        INFO(options.kd_tree << options.shafts);
        check_same(host, draw_on_backend(scene, settings, options));
    }
}

TEST_CASE("Bands, luxels per pixel and rows change nothing between backend and host") {
    const Scene scene = lit_room();
    RenderSettings settings = small_picture();
    settings.luxels_per_pixel = 6;
    settings.filter = mir::default_filter(mir::FilterKind::mitchell);
    // Visibility of one row of blocks: several bands.
    settings.limits.visibility_bytes = std::uint64_t{2400} * settings.luxels_per_pixel;
    if (GENERATE(false, true)) settings.rows = {14, 9};
    check_same(draw_on_host(scene, settings), draw_on_backend(scene, settings, {}));
}

TEST_CASE("Backends that share a picture give the bytes of one frame, also with the host") {
    const Scene scene = lit_room();
    RenderSettings settings = small_picture();
    settings.removed_layer = true;
    const BackendFrameOptions shafts{BackendScheduler::rcvp, false, true};
    const BackendFrameOptions tree{BackendScheduler::os, true, false};
    SECTION("by chains, with layers of bounces") {
        settings.bounce_layers = true;
        const RenderResult host = draw_on_host(scene, settings);
        CHECK(host.statistics.removed_luminance > 0.0);
        check_same(host, draw_split(scene, settings, {shafts}, false));
        check_same(host, draw_split(scene, settings, {shafts, tree}, false));
        check_same(host, draw_split(scene, settings, {shafts, shafts, tree}, true));
    }
    SECTION("through wide filters and low bands, whose visibility no frame keeps") {
        settings.luxels_per_pixel = 6;
        settings.filter = mir::default_filter(mir::FilterKind::lanczos);
        settings.limits.visibility_bytes = std::uint64_t{2400} * settings.luxels_per_pixel;
        check_same(draw_on_host(scene, settings),
                   draw_split(scene, settings, {shafts, shafts}, true));
    }
    SECTION("by light paths, with probes that need the whole image") {
        settings.sampler =
            GENERATE(mir::SamplerKind::instant_radiosity, mir::SamplerKind::metropolis);
        settings.normalisation = mir::NormalisationPolicy::prepass;
        settings.prepass_luxels = 300;
        check_same(draw_on_host(scene, settings),
                   draw_split(scene, settings, {shafts, tree}, false));
    }
}

TEST_CASE("A sky has the same bits in a backend's memory, behind the scene and in its light") {
    Scene scene = lit_room();
    scene.environment = mirtest::test_sky();
    scene.environment->rotation = 10.0f;  // no black texel ahead
    // From outside, where the walls do not fill the picture.
    scene.cameras[0].position += 3.0f * scene.cameras[0].back;
    RenderSettings settings = small_picture();
    const RenderResult host = draw_on_host(scene, settings);
    CHECK(host.emission(0, 0).g > 0.0f);
    check_same(host, draw_on_backend(scene, settings, {}));
    settings.direct = mir::DirectLight::vpl;
    check_same(draw_on_host(scene, settings), draw_on_backend(scene, settings, {}));
}

TEST_CASE("Light of VPLs that are no states is traced by every scheduler, with the same bits") {
    const Scene scene = lit_room();
    RenderSettings settings = small_picture();
    settings.sampler = mir::SamplerKind::instant_radiosity;
    const RenderResult host = draw_on_host(scene, settings);
    for (const BackendScheduler scheduler :
         {BackendScheduler::os, BackendScheduler::rc, BackendScheduler::rcvp}) {
        INFO(static_cast<int>(scheduler));
        check_same(host, draw_on_backend(scene, settings, {scheduler, false, true}));
    }
}

TEST_CASE("A frame with masks and glass has the bits of the host's, by every scheduler") {
    Scene scene = lit_room();
    mir::Material pane = mir::lambertian("pane", {0.9f, 0.8f, 0.7f});
    pane.specular = 1.0f;
    pane.roughness = 0.0f;
    pane.transmission = 0.9f;
    scene.place(mir::builtin::quad("pane", scene.add(pane), {-0.9f, 0.4f, -0.2f}, {0.8f, 0, 0},
                                   {0, 0.9f, 0.1f}));
    mirtest::hang_curtain(scene, mir::lambertian("curtain", {0.7f, 0.6f, 0.5f}), 6,
                          {-0.6f, 1.3f, -0.5f}, {1.2f, 0.1f, 0.0f}, {0.0f, -0.1f, 1.1f});
    RenderSettings settings = small_picture();
    check_same(draw_on_host(scene, settings), draw_on_backend(scene, settings, {}));
    settings.sampler = mir::SamplerKind::instant_radiosity;
    const RenderResult host = draw_on_host(scene, settings);
    for (const BackendScheduler scheduler :
         {BackendScheduler::os, BackendScheduler::rc, BackendScheduler::rcvp}) {
        INFO(static_cast<int>(scheduler));
        check_same(host, draw_on_backend(scene, settings, {scheduler, false, true}));
    }
    scene.materials.back().alpha_cutoff = 0.0f;
    const RenderResult whole = draw_on_host(scene, settings);
    CHECK_FALSE(mirtest::same_bits(whole.direct, host.direct));
    CHECK_FALSE(mirtest::same_bits(whole.indirect, host.indirect));
}

TEST_CASE("What mirrors and glass throw, and what is seen in them, has the bits of the host's") {
    const Scene scene = mir::builtin::make(GENERATE("glass-room", "caustics"));
    RenderSettings settings = small_picture();
    settings.sampler = mir::SamplerKind::instant_radiosity;
    settings.caustics = 2;
    settings.bounce_layers = GENERATE(false, true);
    const RenderResult host = draw_on_host(scene, settings);
    const BackendFrameOptions wide{BackendScheduler::rcvp, false, true};
    check_same(host, draw_on_backend(scene, settings, wide));
    check_same(host, draw_split(scene, settings, {wide, wide}, true));
    settings.caustics = 0;
    CHECK_FALSE(mirtest::same_bits(draw_on_host(scene, settings).indirect, host.indirect));
}

TEST_CASE("Leaves and panes with textures have the same bits in a backend's memory") {
    Scene scene = lit_room();
    scene.images.push_back(
        {"spots", 2, 1, {mirtest::texel(255, 80, 120, 250), mirtest::texel(10, 200, 40, 60)}});
    mir::Material leaf = mir::lambertian("leaf", {0.3f, 0.5f, 0.2f});
    leaf.specular = 1.0f;
    leaf.roughness = 0.5f;
    leaf.diffuse_transmission = 0.8f;
    leaf.textures.diffuse_transmission = leaf.textures.diffuse_transmission_color =
        mirtest::texture_of(0);
    mir::Material pane = mir::lambertian("pane", {0.9f, 0.8f, 0.7f});
    pane.roughness = 0.0f;
    pane.transmission = 1.0f;
    pane.textures.transmission = mirtest::texture_of(0);
    float x = -0.9f;
    for (const mir::Material& m : {leaf, pane}) {
        mir::Mesh quad = mir::builtin::quad(m.name, scene.add(m), {x, 0.3f, -0.2f}, {0.8f, 0, 0.2f},
                                            {0, 0.9f, 0.1f});
        quad.texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        scene.place(std::move(quad));
        x = 0.1f;
    }
    RenderSettings settings = small_picture();
    settings.luxels_per_pixel = 4;
    for (const auto sampler : {mir::SamplerKind::metropolis, mir::SamplerKind::instant_radiosity}) {
        settings.sampler = sampler;
        const RenderResult host = draw_on_host(scene, settings);
        check_same(host, draw_on_backend(scene, settings, {}));
        Scene opaque = scene;
        for (mir::Material& m : opaque.materials) m.diffuse_transmission = 0.0f;
        CHECK_FALSE(mirtest::same_bits(draw_on_host(opaque, settings).direct, host.direct));
    }
}

TEST_CASE("Cuts of many VPLs have the bits of the host's in a backend's memory") {
    Scene scene = lit_room();
    RenderSettings settings = small_picture();
    settings.sum = mir::LightSum::cuts;
    settings.vpls = 400;
    settings.picks = 24;
    settings.sampler = mir::SamplerKind::instant_radiosity;
    SECTION("by bounces, in bands") {
        settings.bounce_layers = true;
        settings.luxels_per_pixel = 4;
    }
    SECTION("by chains") { settings.sampler = mir::SamplerKind::metropolis; }
    SECTION("through alpha masks") {
        mirtest::hang_curtain(scene, mir::lambertian("curtain", {0.7f, 0.6f, 0.5f}), 6,
                              {-0.6f, 1.3f, -0.5f}, {1.2f, 0.1f, 0.0f}, {0.0f, -0.1f, 1.1f});
    }
    const RenderResult host = draw_on_host(scene, settings);
    CHECK(host.statistics.indirect_luminance > 0.0);
    const BackendFrameOptions tree{BackendScheduler::rcvp, true, false};
    const BackendFrameOptions shafts{BackendScheduler::rcvp, false, true};
    check_same(host, draw_split(scene, settings, {tree}, false));
    check_same(host, draw_split(scene, settings, {shafts, tree}, true));
}

TEST_CASE("Backends behind the host leave their rows in one picture, whoever has which band") {
    const Scene scene = lit_room();
    const RenderSettings settings = small_picture();
    const mir::WorldGeometry geometry(scene);
    InlineExecutor executor;
    mir::StageClock clock;
    const mir::TracedScene traced(std::make_unique<const mir::KdTreeScene>(geometry));
    const auto make_tree = [&] {
        return std::make_shared<const mir::KdTree>(geometry, mir::KdTreeOptions{}, executor);
    };
    // Rows of blocks: as many bands as there are frames, so that each has one.
    constexpr std::uint32_t bands = 3;
    const auto put = [&](mir::RenderFrame& by, std::uint32_t i, mir::BandTurn& turn) {
        const std::uint32_t rows = std::min(16u, settings.image.height - 16 * i);
        const mir::BandPtr band = by.trace({settings.image.width, rows}, {48, 16}, 16 * i);
        std::vector<mir::LayerPtr> layers;
        layers.push_back(by.direct(*band, mir::DirectSamples(4)));
        turn.wait();
        by.put(*band, std::move(layers), turn);
    };
    mir::RenderJob alone({scene, geometry, mir::AnyExecutor(executor), nullptr, clock}, settings);
    const auto host = mir::host_frame(alone, traced, mir::HostScheduler::cpu);
    host->for_each_band(bands, put);
    const mir::Image<mir::Rgb> whole = host->develop().front();
    // Who comes first is chance: often enough for the host to have the first band.
    for (std::size_t picture = 0; picture < 24; ++picture) {
        const std::size_t host_place = picture % bands;
        CAPTURE(host_place);
        mir::RenderJob job({scene, geometry, mir::AnyExecutor(executor), nullptr, clock}, settings);
        std::vector<std::unique_ptr<mir::RenderFrame>> parts;
        for (std::size_t k = 0; k < bands; ++k) {
            if (k == host_place)
                parts.push_back(mir::host_frame(job, traced, mir::HostScheduler::cpu));
            else
                parts.push_back(std::make_unique<mirtest::FrameThere>(
                    job, mirtest::HostBackend(executor), make_tree, BackendFrameOptions{}));
        }
        mir::SplitFrame frame(job, std::move(parts));
        std::barrier all_have_one(bands);
        frame.for_each_band(bands, [&](mir::RenderFrame& by, std::uint32_t i, mir::BandTurn& turn) {
            all_have_one.arrive_and_wait();
            put(by, i, turn);
        });
        CHECK(mirtest::same_bits(frame.develop().front(), whole));
    }
}

TEST_CASE("What the bound removed is traced back in a backend's memory with the host's bits") {
    Scene scene = lit_room();
    RenderSettings settings = small_picture();
    settings.compensate = 2;
    SECTION("of all bounces together") {}
    SECTION("by bounces") { settings.bounce_layers = true; }
    SECTION("of VPLs on lamps") { settings.direct = mir::DirectLight::vpl; }
    SECTION("under the lower bound of cuts") {
        settings.sum = mir::LightSum::cuts;
        settings.sampler = mir::SamplerKind::instant_radiosity;
    }
    SECTION("under a sky, through glass and masks") {
        mirtest::hang_curtain(scene, mir::lambertian("curtain", {0.7f, 0.6f, 0.5f}), 6,
                              {-0.6f, 1.3f, -0.5f}, {1.2f, 0.1f, 0.0f}, {0.0f, -0.1f, 1.1f});
        scene.environment = mirtest::test_sky();
    }
    const RenderResult host = draw_on_host(scene, settings);
    CHECK(host.statistics.residual_luminance > 0.0);
    const BackendFrameOptions tree{BackendScheduler::rcvp, true, false};
    const BackendFrameOptions wide{BackendScheduler::rcvp, false, true};
    check_same(host, draw_split(scene, settings, {wide}, false));
    check_same(host, draw_split(scene, settings, {tree, wide}, true));
}

TEST_CASE("Spheres and lobes do not light luxels in a backend's memory, and it says so") {
    RenderSettings settings = small_picture();
    settings.sampler = mir::SamplerKind::instant_radiosity;
    settings.vsl.enabled = GENERATE(true, false);
    settings.glossy.enabled = !settings.vsl.enabled;
    try {
        draw_on_backend(lit_room(), settings, {});
        FAIL("no error");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::unsupported);
        CHECK(std::string(e.what()).find("--backend cpu") != std::string::npos);
    }
}

TEST_CASE("A frame on a backend says how long its stages took") {
    const RenderResult frame = draw_on_backend(lit_room(), small_picture(), {});
    const mir::StageSeconds& s = frame.statistics.seconds;
    for (const double seconds :
         {s.build, s.bound, s.bootstrap, s.sampling, s.gbuffer, s.visibility, s.response, s.direct,
          s.reconstruction, s.light_budget, s.film, s.guides, s.download, s.other})
        CHECK(seconds > 0.0);
    double sum = 0.0;
    for (const mir::RenderStage& stage : mir::render_stages) sum += s.*stage.seconds;
    CHECK(s.total == sum);
}
