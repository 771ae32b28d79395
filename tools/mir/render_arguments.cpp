// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "mir/film/filter.hpp"
#include "mir/runtime/pass_goal.hpp"
#include "option_types.hpp"

#include <cmath>

namespace mirtool {
namespace {

const std::vector<std::string> layer_names{"albedo",  "normal",   "position", "depth",
                                           "direct",  "indirect", "emission", "bounces",
                                           "removed", "all",      "none"};

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

/// What --sampler names.
struct NamedSampler {
    mir::SamplerKind kind = mir::SamplerKind::metropolis;
    mir::Termination termination = mir::Termination::roulette;
    bool vpl_roulette = false;
};

void add_sampler(CLI::App& app, mir::RenderSettings& s) {
    using Kind = mir::SamplerKind;
    using End = mir::Termination;
    static const std::map<std::string, NamedSampler> samplers{
        {"mir", {Kind::metropolis}},
        {"bir", {Kind::bidirectional}},
        {"ir", {Kind::instant_radiosity}},
        {"roulette", {Kind::instant_radiosity, End::roulette, true}},
        {"keller", {Kind::instant_radiosity, End::levels}}};
    app.add_option_function<std::string>(
           "--sampler",
           [&s](const std::string& name) {
               const auto found = samplers.find(name);
               if (found == samplers.end())
                   throw CLI::ValidationError("--sampler", "'" + name +
                                                               "' is unknown; choose one of "
                                                               "mir|bir|ir|roulette|keller");
               s.sampler = found->second.kind;
               s.termination = found->second.termination;
               s.vpl_roulette = found->second.vpl_roulette;
           },
           "How VPLs are placed: mir, Metropolis sampling (default; up to --chains VPLs are "
           "independent draws, further ones mutations of those); bir, bidirectional with "
           "resampling; ir, instant radiosity; roulette, the same with roulette on what a VPL "
           "gives to the image; keller, a fixed share survives each bounce")
        ->type_name("mir|bir|ir|roulette|keller");
}

void add_chains(CLI::App& app, mir::RenderSettings& s) {
    mir::MetropolisTuning& m = s.metropolis;
    add_choice<mir::NormalisationPolicy>(
        app, "--normalise", s.normalisation,
        {{"full", mir::NormalisationPolicy::full},
         {"prepass", mir::NormalisationPolicy::prepass},
         {"proposal", mir::NormalisationPolicy::proposal}},
        "Where a VPL's response is measured: on all luxels (default), on a few, or while sampling");
    add_count(app, "--prepass-luxels", s.prepass_luxels, 1, 1 << 24,
              "Luxels of --normalise prepass (default 4096)");
    add_count(app, "--chains", m.chains, 1, 65536,
              "Markov chains, no more than VPLs (default 4096)");
    add_count(app, "--stride", m.stride, 1, 1 << 20,
              "Mutations from one recorded state to the next (default 64)");
    add_count(app, "--tries", m.chain.tries, 1, 254, "Candidates of a large step (default 8)");
    app.add_option("--large-steps", m.chain.large_step_probability,
                   "Share of large steps among mutations (default 0.5)")
        ->check(between(1e-6, 1, "above 0 to 1"));
    add_choice<mir::Mutation>(
        app, "--mutation", m.chain.mutation,
        {{"primary", mir::Mutation::primary}, {"bidirectional", mir::Mutation::bidirectional}},
        "Other mutations: of the random numbers (default) or of the path itself");
    add_choice<mir::PathTechniques>(app, "--paths", m.techniques,
                                    {{"camera", mir::PathTechniques::camera},
                                     {"bidirectional", mir::PathTechniques::bidirectional}},
                                    "How whole paths are built: from the camera alone, or from "
                                    "both ends (default)");
    add_count(app, "--suffix-refresh", m.suffix_refresh, 0, 255,
              "Further light paths behind each recorded VPL (default 8)");
    app.add_option("--bootstrap-error", m.bootstrap.relative_error,
                   "Relative standard error wanted of P_c (default 0.036 for 256 VPLs)")
        ->check(between(1e-6, 1, "above 0 to 1"));
    add_choice<mir::ChainStop>(
        app, "--stop", m.stop, {{"fixed", mir::ChainStop::fixed}, {"paper", mir::ChainStop::paper}},
        "End of the chains: a fixed number of states (default) or of new VPLs, as the paper "
        "prints it, biased");
}

void add_reference(CLI::App& app, mir::RenderSettings& s) {
    add_choice<mir::Integrator>(app, "--integrator", s.integrator,
                                {{"vpl", mir::Integrator::vpl},
                                 {"path", mir::Integrator::path},
                                 {"micro", mir::Integrator::micro}},
                                "VPLs (default), the reference path tracer, or light gathered "
                                "from discs");
    add_count(app, "--samples", s.path.samples, 1, 1 << 24,
              "Camera paths per luxel of --integrator path (default 64)");
    add_choice<mir::LightSearch>(app, "--light-search", s.path.light,
                                 {{"mis", mir::LightSearch::mis},
                                  {"lamps", mir::LightSearch::lamps},
                                  {"directions", mir::LightSearch::directions}},
                                 "How its paths find lamps: light samples and directions weighed "
                                 "(default), or one of them alone");
    add_count(app, "--directions", s.path.directions, 1, 65536,
              "Directions that go on from its first hit (default 1)");
}

void add_micro(CLI::App& app, mir::RenderSettings& s) {
    mir::MicroSettings& m = s.micro;
    app.add_option("--surfels", m.surfels, "Discs wanted of --integrator micro (default 16384)")
        ->check(between(1, 1.6e7, "1 to 16000000"));
    add_choice<mir::MicroGather>(
        app, "--gather", m.luxels,
        {{"exact", mir::MicroGather::exact},
         {"rays", mir::MicroGather::rays},
         {"buffers", mir::MicroGather::buffers}},
        "How a luxel gathers: by rays to the triangles (default), by rays that stop at "
        "groups of discs, or by a micro-buffer of those");
    add_count(app, "--buffer-size", m.buffer_side, 1, mir::BufferGatherOptions::largest_side,
              "Texels of a micro-buffer in each direction (default 16)");
    add_choice<mir::BufferWarp>(
        app, "--buffer-warp", m.buffer_warp,
        {{"hemisphere", mir::BufferWarp::hemisphere}, {"importance", mir::BufferWarp::importance}},
        "Where its texels look: the hemisphere by its cosine (default), or glossy surfaces also "
        "into "
        "their lobe, with a second buffer");
    add_count(app, "--gather-rays", m.gather.rays, 1, 65536,
              "Rays with which a luxel gathers (default 128)");
    add_choice<mir::GatherDirections>(
        app, "--gather-directions", m.gather.directions,
        {{"cosine", mir::GatherDirections::cosine}, {"uniform", mir::GatherDirections::uniform}},
        "Their density over the hemisphere (default cosine)");
    app.add_option("--gather-threshold", m.gather.threshold,
                   "Solid angle of a node at which a ray stops or a texel is filled, in units of "
                   "their own; 0 is exact (default 1)")
        ->check(between(0, 1e6, "0 to 1000000"));
    add_count(app, "--surfel-rays", m.surfel_rays, 1, 65536,
              "Rays with which each side of a disc gathers later bounces (default 32)");
    add_choice<mir::GatherCheck>(app, "--gather-check", m.check,
                                 {{"none", mir::GatherCheck::none},
                                  {"measure", mir::GatherCheck::measure},
                                  {"correct", mir::GatherCheck::correct}},
                                 "Light of discs against that of paths at 2048 places: none, "
                                 "measure the difference, or also "
                                 "correct it (default)");
}

void add_sampling(CLI::App& app, RenderOptions& o) {
    mir::RenderSettings& s = o.settings;
    add_sampler(app, s);
    add_choice<mir::Sequence>(
        app, "--sequence", s.sequence,
        {{"random", mir::Sequence::random}, {"halton", mir::Sequence::halton}},
        "Numbers behind the light paths (default random)");
    app.add_option("--vpls", s.vpls, "Geometric VPLs wanted (default 1024)")
        ->check(between(1, 4e6, "1 to 4000000"));
    add_choice<mir::DirectLight>(
        app, "--direct", s.direct,
        {{"separate", mir::DirectLight::separate}, {"vpl", mir::DirectLight::vpl}},
        "Direct light by samples of the lamps (default) or by VPLs on them and, of an environment, "
        "at "
        "infinity");
    app.add_option("--direct-samples", s.direct_samples, "Lamp samples per pixel (default 32)")
        ->check(between(1, 65536, "1 to 65536"));
    add_count(app, "--bounces", s.max_bounce, 1, 254,
              "Largest number of reflections on the way to the camera (default 32; no limit with "
              "--integrator path)");
    app.add_option_function<std::string>(
           "--bound",
           [&s](const std::string& text) {
               using Kind = mir::BoundPolicy::Kind;
               s.bound = {text == "auto" ? Kind::automatic : Kind::none, 0.0f};
               if (text == "auto" || text == "none") return;
               s.bound.kind = Kind::fixed;
               if (!CLI::detail::lexical_cast(text, s.bound.value) || !(s.bound.value > 0.0f) ||
                   std::isinf(s.bound.value))
                   throw CLI::ValidationError(
                       "--bound", "'" + text + "' is neither auto, none nor a positive number");
           },
           "Largest geometry term of a VPL and a luxel, per square metre: auto (default), none, or "
           "a number")
        ->type_name("auto|none|B");
    add_count(app, "--compensate", s.compensate, 0, 65536,
              "Paths per pixel that trace back what the bound removed (default 0: none)");
    CLI::Option* vsl = app.add_flag("--vsl", s.vsl.enabled,
                                    "Virtual spherical lights: VPLs light as spheres, which spread "
                                    "light where a bound would remove it");
    add_count(app, "--vsl-samples", s.vsl.samples, 1, 1024,
              "Directions in which a luxel sees a sphere, and of its BSDF (default 8)")
        ->needs(vsl);
    app.add_option("--vsl-scale", s.vsl.scale, "Factor of the spheres' radii (default 1)")
        ->check(between(1e-3, 1e3, "0.001 to 1000"))
        ->needs(vsl);
    CLI::Option* glossy = app.add_flag("--glossy", s.glossy.enabled,
                                       "VPLs on glossy surfaces send out the lobe of their surface "
                                       "(--sampler ir or keller)");
    app.add_option("--glossy-roughness", s.glossy.least_roughness,
                   "Smoother surfaces send out lobes of this roughness (default 0.5)")
        ->check(between(0.0, 1.0, "0 to 1"))
        ->needs(glossy);
    app.add_option("--seed", s.seed, "Seed of all random numbers (default 0)")
        ->check(seed_number());
}

void add_image(CLI::App& app, RenderOptions& o) {
    mir::RenderSettings& s = o.settings;
    const auto side = between(1, 65536, "1 to 65536");
    app.add_option("--width", o.width, "Pixels across (default: the scene's, else 480 high)")
        ->check(side);
    app.add_option("--height", o.height, "Pixels down")->check(side);
    app.add_option("--luxels", s.luxels_per_pixel, "Luxels per pixel (default 4)")
        ->check(between(1, 64, "1 to 64"));
    app.add_option("--camera", o.camera, "Camera of the scene, by name or index (default 0)");
    std::map<std::string, mir::Filter> filters;
    for (const mir::FilterName& f : mir::filter_names)
        filters.emplace(f.name, mir::default_filter(f.kind));
    add_choice<mir::Filter>(
        app, "--filter", s.filter, filters,
        "Pixel filter (default gaussian; lanczos is the paper's windowed sinc)");
}

/// Light, ground and view for files that have none.
void add_scene_parts(CLI::App& app, RenderOptions& o) {
    AddedScene& a = o.added;
    CLI::Option* sun = add_vector(app, "--sun", a.sun, "Adds a sun in this direction, as 1,2,1");
    app.add_option("--sun-irradiance", a.sun_irradiance,
                   "W/m2 on a surface that faces the sun (default 3)")
        ->check(between(1e-6, 1e6, "0.000001 to 1000000"))
        ->needs(sun);
    app.add_flag("--ground", a.ground, "Adds a grey floor below everything");
    CLI::Option* eye =
        add_vector(app, "--eye", a.eye, "Place of the camera, metres (default: the scene's)");
    add_vector(app, "--look-at", a.look_at,
               "What the camera of --eye looks at (default: the middle of the scene)")
        ->needs(eye);
    app.add_option("--fov", a.fov, "Vertical field of view of --eye, degrees (default 45)")
        ->check(between(1, 170, "1 to 170"))
        ->needs(eye);
    eye->excludes("--camera");
}

void add_output(CLI::App& app, RenderOptions& o) {
    app.add_option("-o,--output", o.output, "Picture to write (default SCENE.exr)");
    app.add_option("--png", o.preview, "Preview to write (default: beside the EXR)");
    app.add_flag("--no-png", o.no_preview, "Write no preview");
    std::map<std::string, mir::ToneCurve> curves;
    for (const mir::ToneCurveName& t : mir::tone_curve_names) curves.emplace(t.name, t.curve);
    add_choice<mir::ToneCurve>(app, "--tone", o.tone, curves,
                               "Tone curve of the preview (default agx)");
    app.add_option("--exposure", o.exposure, "Exposure of the preview, EV (default: automatic)")
        ->check(between(-100, 100, "-100 to 100"));
    app.add_option("--aov", o.layers,
                   "Layers of the EXR beside the picture: albedo, normal, position, depth, "
                   "direct, indirect, emission, or all of these; bounces, removed (by the bound); "
                   "or none (default: albedo,normal,depth)")
        ->delimiter(',')
        ->check(CLI::IsMember(layer_names))
        ->each([&o](const std::string& name) { o.no_layers |= name == "none"; });
    app.add_flag("--record-seconds", o.record_seconds,
                 "Store the render time in the EXR (its bytes then differ every time)");
    app.add_flag("--json", o.json, "Print statistics as JSON on stdout");
    app.add_flag("-q,--quiet", o.quiet, "No progress, no summary");
}

/// Files that show how a picture came about.
void add_report(CLI::App& app, RenderOptions& o) {
    CLI::Option* report = app.add_option(
        "--report", o.report, "Report to write, one HTML file with picture, VPLs and statistics");
    app.add_option("--report-reference", o.report_reference,
                   "OpenEXR picture that the report compares the render with")
        ->needs(report);
    app.add_option("--vpls-out", o.vpls_out, "VPLs to write, as points (.ply or .glb)")
        ->check(CLI::Validator(
            [](const std::string& name) {
                return name.ends_with(".ply") || name.ends_with(".glb")
                           ? std::string()
                           : "'" + name + "' does not end in .ply or .glb, the formats of VPLs";
            },
            ""));
}

void add_passes(CLI::App& app, PassOptions& p) {
    const auto seconds = between(0.001, 3.2e7, "0.001 to 32000000 seconds");
    app.add_option("--passes", p.passes,
                   "Renders with random numbers of their own whose mean is the picture (default 1; "
                   "no limit with --time or --target-error)")
        ->check(between(1, mir::max_passes, "1 to 1000000"));
    app.add_option("--time", p.seconds, "Start no further pass after so many seconds")
        ->check(seconds);
    app.add_option("--target-error", p.relative_error,
                   "Start no further pass once the relative error, from the spread of the passes, "
                   "is so small; 0.01 is one percent")
        ->check(between(1e-6, 1, "0.000001 to 1"));
    app.add_option("--save-every", p.save_every,
                   "Write the picture of the passes so far every so many seconds (default 10)")
        ->check(between(0, 3.2e7, "0 to 32000000 seconds"));
    app.add_flag("--resume", p.resume,
                 "Keep the passes in PICTURE.journal, and go on from those that are in it");
}

void add_execution(CLI::App& app, RenderOptions& o) {
    mir::RenderSettings& s = o.settings;
    app.add_option("--threads", s.threads, "Threads (default 0: every core)")
        ->check(between(0, 1024, "0 to 1024"));
    add_choice<mir::BackendKind>(app, "--backend", s.backend,
                                 {{"auto", mir::BackendKind::automatic},
                                  {"cpu", mir::BackendKind::cpu},
                                  {"cuda", mir::BackendKind::cuda}},
                                 "Machine: a GPU where there is one (default), or one of them");
    add_choice<mir::Acceleration>(
        app, "--accel", s.acceleration,
        {{"auto", mir::Acceleration::automatic},
         {"kdtree", mir::Acceleration::kd_tree},
         {"bvh", mir::Acceleration::bvh},
         {"embree", mir::Acceleration::embree}},
        "What rays are traced through: the kd-tree, the wide hierarchy with shafts, Embree "
        "(processor only), or the fastest for the picture (default)");
    app.add_option("--scheduler", s.scheduler,
                   "cpu-blocks, tuned (default of the processor); cpu, the plain loop; os, rc or "
                   "rcvp (default of GPUs), the paper's; the picture is the same")
        ->check(CLI::IsMember({"cpu", "cpu-blocks", "os", "rc", "rcvp"}));
    app.add_option_function<std::string>(
           "--tile", [&s](const std::string& text) { s.tile = read_tile(text); },
           "Luxels scheduled together (default 256x256); the picture does not depend on it")
        ->type_name("WxH");
    app.add_flag("--allow-no-light", s.allow_no_light, "Render a scene without light, black");
}

}  // namespace

void add_render(CLI::App& app, RenderOptions& options) {
    add_output(app, options);
    add_report(app, options);
    add_image(app, options);
    add_scene_parts(app, options);
    add_environment(app, options.environment);
    add_sampling(app, options);
    add_chains(app, options.settings);
    add_reference(app, options.settings);
    add_micro(app, options.settings);
    add_passes(app, options.passes);
    add_execution(app, options);
}

}  // namespace mirtool
