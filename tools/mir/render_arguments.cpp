// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "mir/film/filter.hpp"
#include "mir/runtime/pass_goal.hpp"
#include "option_types.hpp"

namespace mirtool {
namespace {

const std::vector<std::string> layer_names{"albedo",  "normal",     "position", "depth",
                                           "direct",  "indirect",   "emission", "bounces",
                                           "removed", "pick_error", "all",      "none"};

/// Reads "WIDTHxHEIGHT" or "SIDE".
mir::Extent read_tile(const std::string& text) {
    const std::size_t x = text.find('x');
    mir::Extent tile;
    bool good = read_whole(text.substr(0, x), tile.width);
    tile.height = tile.width;
    if (x != std::string::npos) good = good && read_whole(text.substr(x + 1), tile.height);
    const auto fits = [](std::uint32_t side) { return side >= 1 && side <= 65536; };
    if (good && fits(tile.width) && fits(tile.height)) return tile;
    throw CLI::ValidationError(
        "--tile", "'" + text + "' is no tile; give WIDTHxHEIGHT in luxels, such as 256x256");
}

/// Reads "all" or numbers with commas between them.
mir::DeviceChoice read_devices(const std::string& text) {
    mir::DeviceChoice devices;
    devices.all = text == "all";
    for (std::size_t at = 0; !devices.all && at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string number = text.substr(at, end - at);
        const bool has_zeros = number.size() > 1 && number.front() == '0';
        if (has_zeros || !read_whole(number, devices.numbers.emplace_back()))
            throw CLI::ValidationError("--devices", "'" + text +
                                                        "' names no GPUs; give all, or numbers as "
                                                        "`mir devices` counts them, such as 0,1");
        at = end + 1;
    }
    return devices;
}

/// Reads "2/5".
mir::ShardNumber read_shard(const std::string& text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    mir::ShardNumber shard;
    if (slash < text.size() && read_whole(text.substr(0, slash), shard.number) &&
        read_whole(text.substr(slash + 1), shard.count) && shard.number >= 1 &&
        shard.number <= shard.count && shard.count <= mir::max_shards)
        return shard;
    throw CLI::ValidationError("--shard", "'" + text +
                                              "' is no part of a picture; give I/N, such as 2/5, "
                                              "with I from 1 to N and N to 65536");
}

void add_output(CLI::App& app, RenderOptions& o) {
    begin_group(app, "Output");
    app.add_option("-o,--output", o.output, "Picture to write (default: SCENE.exr in this folder)")
        ->type_name("FILE");
    app.add_option("--png", o.preview, "Preview to write (default: beside the picture)")
        ->type_name("FILE");
    app.add_flag("--no-png", o.no_preview, "Write no preview");
    std::map<std::string, mir::ToneCurve> curves;
    for (const mir::ToneCurveName& t : mir::tone_curve_names) curves.emplace(t.name, t.curve);
    add_choice<mir::ToneCurve>(app, "--tone", o.tone, curves,
                               "Tone curve of the preview: agx (default) and aces, like film; "
                               "reinhard; none, clamped");
    app.add_option("--exposure", o.exposure,
                   "Stops by which the preview is brighter, or darker where negative (default: "
                   "chosen for the picture)")
        ->check(between(-100, 100, "-100 to 100"))
        ->type_name("EV");
    app.add_flag("--record-seconds", o.record_seconds,
                 "Store the render time in the EXR (its bytes then differ every time)");
    app.add_flag("--json", o.json, "Print statistics as JSON on stdout");
    app.add_flag("-q,--quiet", o.quiet, "No progress, remarks or summary");
}

/// A picture without noise beside the picture.
void add_denoising(CLI::App& app, RenderOptions& o) {
    begin_group(app, "Output");
    CLI::Option* denoise = app.add_flag(
        "--denoise", o.denoise,
        "Add the layer denoised, the picture without its noise, by Open Image Denoise; the preview "
        "shows it");
    add_denoiser(app, o.denoiser)->needs(denoise);
}

/// Layers beside the picture.
void add_layers(CLI::App& app, RenderOptions& o) {
    begin_group(app, "Output");
    add_words(app, "--aov", o.layers, layer_names,
              "Layers of the EXR beside the picture, separated by commas: albedo, normal, "
              "position, depth, direct, indirect, emission, or all of these; bounces and removed, "
              "which take time; pick_error, with cuts; or none (default: albedo, normal and depth, "
              "which denoisers use)")
        ->each([&o](const std::string& name) { o.no_layers |= name == "none"; });
}

/// Files that show how a picture came about.
void add_report(CLI::App& app, RenderOptions& o) {
    begin_group(app, "Report");
    CLI::Option* report =
        app.add_option("--report", o.report,
                       "Report to write: one HTML file with picture, VPLs and statistics")
            ->type_name("FILE");
    app.add_option("--report-reference", o.report_reference,
                   "OpenEXR picture that the report compares the render with")
        ->needs(report)
        ->type_name("FILE");
    app.add_option("--vpls-out", o.vpls_out, "VPLs to write, as points (.ply or .glb)")
        ->check(CLI::Validator(
            [](const std::string& name) {
                return name.ends_with(".ply") || name.ends_with(".glb")
                           ? std::string()
                           : "'" + name + "' does not end in .ply or .glb, the formats of VPLs";
            },
            ""))
        ->type_name("FILE");
}

void add_image(CLI::App& app, RenderOptions& o) {
    begin_group(app, "Image");
    mir::RenderSettings& s = o.settings;
    const auto side = between(1, 65536, "1 to 65536");
    app.add_option("--width", o.width, "Pixels across (default: the scene's, or by the height)")
        ->check(side);
    app.add_option("--height", o.height, "Pixels down (default: the scene's, else 480)")
        ->check(side);
    app.add_option("--luxels", s.luxels_per_pixel,
                   "Camera rays per pixel: more give smoother edges (default: by --quality, 4)")
        ->check(between(1, 64, "1 to 64"));
    app.add_option("--camera", o.camera,
                   "Camera of the scene, by name or by number from 0 on (default: the first that "
                   "can be used)")
        ->type_name("NAME");
    std::map<std::string, mir::Filter> filters;
    for (const mir::FilterName& f : mir::filter_names)
        filters.emplace(f.name, mir::default_filter(f.kind));
    add_choice<mir::Filter>(
        app, "--filter", s.filter, filters,
        "Pixel filter (default gaussian, with --denoise box; lanczos is the paper's windowed sinc)")
        ->each([&o](const std::string&) { o.has_filter = true; });
}

/// Light, ground and view for files that have none.
void add_scene_parts(CLI::App& app, RenderOptions& o) {
    begin_group(app, "Scene");
    AddedScene& a = o.added;
    CLI::Option* sun =
        add_vector(app, "--sun", a.sun, "Adds a sun that stands in this direction, +y being up");
    app.add_option("--sun-irradiance", a.sun_irradiance,
                   "Irradiance of a surface that faces the sun, W/m2 (default 3)")
        ->check(between(1e-6, 1e6, "0.000001 to 1000000"))
        ->needs(sun);
    add_environment(app, o.environment);
    app.add_flag("--ground", a.ground, "Adds a grey floor below everything");
    CLI::Option* eye =
        add_vector(app, "--eye", a.eye, "Place of the camera, metres (default: the scene's)");
    add_vector(app, "--look-at", a.look_at,
               "What the camera of --eye looks at (default: the middle of the scene)")
        ->needs(eye);
    app.add_option("--fov", a.fov, "Vertical field of view of --eye (default 45)")
        ->check(between(1, 170, "1 to 170"))
        ->needs(eye)
        ->type_name("DEGREES");
    eye->excludes("--camera");
    app.add_flag("--allow-no-light", o.settings.allow_no_light,
                 "Render a scene without light, black, instead of refusing it");
    add_allow_outside(app, o.settings.limits);
}

void add_passes(CLI::App& app, PassOptions& p) {
    begin_group(app, "Time and machine");
    app.add_option("--passes", p.passes,
                   "Renders with random numbers of their own, whose mean is the picture (default "
                   "1; no limit with --time or --target-error)")
        ->check(between(1, mir::max_passes, "1 to 1000000", "without a pass there is no picture"));
    app.add_option("--time", p.seconds, "Start no further pass after so many seconds")
        ->check(between(0.001, 3.2e7, "0.001 to 32000000", "a pass takes some time"))
        ->type_name("SECONDS");
    app.add_option("--target-error", p.relative_error,
                   "Start no further pass once the relative error, from the spread of the passes, "
                   "is so small; 0.01 is one percent")
        ->check(between(1e-6, 1, "0.000001 to 1",
                        "the mean of passes comes near the true picture, but never to it"));
}

/// What of the passes is kept in files while they go on.
void add_kept_passes(CLI::App& app, PassOptions& p) {
    begin_group(app, "Time and machine");
    app.add_option("--save-every", p.save_every,
                   "Write the picture of the passes so far every so many seconds (default 10)")
        ->check(between(0, 3.2e7, "0 to 32000000"))
        ->type_name("SECONDS");
    app.add_flag("--resume", p.resume,
                 "Keep the passes in PICTURE.journal, and go on from those that are in it");
}

void add_shard(CLI::App& app, std::optional<mir::ShardNumber>& shard) {
    begin_group(app, "Time and machine");
    app.add_option_function<std::string>(
           "--shard", [&shard](const std::string& text) { shard = read_shard(text); },
           "Render part I of N of the picture to a shard, for mir merge; several machines make "
           "one picture so")
        ->type_name("I/N");
}

void add_execution(CLI::App& app, RenderOptions& o) {
    mir::RenderSettings& s = o.settings;
    add_choice<mir::BackendKind>(app, "--backend", s.backend,
                                 {{"auto", mir::BackendKind::automatic},
                                  {"cpu", mir::BackendKind::cpu},
                                  {"cuda", mir::BackendKind::cuda}},
                                 "What renders: the processor, a GPU, or a GPU where there is one "
                                 "that can (auto, default)");
    app.add_option_function<std::string>(
           "--devices", [&s](const std::string& text) { s.devices = read_devices(text); },
           "GPUs that make the picture together: all, or numbers such as 0,1 (default 0); the "
           "picture is the same")
        ->type_name("LIST");
    app.add_option("--threads", s.threads, "Threads of the processor (default 0: one per core)")
        ->check(between(0, 1024, "0 to 1024"));
    add_choice<mir::Acceleration>(
        app, "--accel", s.acceleration,
        {{"auto", mir::Acceleration::automatic},
         {"kdtree", mir::Acceleration::kd_tree},
         {"bvh", mir::Acceleration::bvh},
         {"embree", mir::Acceleration::embree}},
        "What rays are traced through: the kd-tree, the wide hierarchy with shafts (bvh), Embree "
        "(processor only), or the fastest for the picture (auto, default)");
    const std::map<std::string, std::string> schedulers{
        {"cpu", "cpu"}, {"cpu-blocks", "cpu-blocks"}, {"os", "os"}, {"rc", "rc"}, {"rcvp", "rcvp"}};
    add_choice<std::string>(
        app, "--scheduler", s.scheduler, schedulers,
        "Order of the work; the picture is the same: cpu-blocks, tuned (default of the "
        "processor); cpu, the plain loop; os, rc or rcvp (default of GPUs), the paper's");
    app.add_option_function<std::string>(
           "--tile", [&s](const std::string& text) { s.tile = read_tile(text); },
           "Luxels scheduled together; the picture is the same (default 256x256)")
        ->type_name("WxH");
}

}  // namespace

void add_allow_outside(CLI::App& app, mir::Limits& limits) {
    app.add_flag("--allow-outside", limits.allow_outside,
                 "The scene may name files outside of its folder; for scenes that you trust");
}

void add_picture(CLI::App& app, RenderOptions& options) {
    add_quality(app, options);
    add_image(app, options);
    add_layers(app, options);
    add_scene_parts(app, options);
    add_light(app, options.settings);
    add_passes(app, options.passes);
    add_execution(app, options);
}

void add_render(CLI::App& app, RenderOptions& options) {
    add_output(app, options);
    add_denoising(app, options);
    add_report(app, options);
    add_picture(app, options);
    add_kept_passes(app, options.passes);
    add_shard(app, options.shard);
}

}  // namespace mirtool
