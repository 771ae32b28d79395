// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "exit_code.hpp"
#include "mir/cpu/register.hpp"
#include "mir/version.hpp"
#include "nearest.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <iostream>

namespace mirtool {
namespace {

const std::vector<std::string> layer_names{"albedo",   "normal",   "position", "depth", "direct",
                                           "indirect", "emission", "bounces",  "none"};

/// A number within [low, high]; CLI11's own check prints bounds with hundreds of digits.
CLI::Validator between(double low, double high, const std::string& text) {
    return {[=](std::string& value) {
                double number = 0.0;
                if (!CLI::detail::lexical_cast(value, number))
                    return "'" + value + "' is no number";
                if (number >= low && number <= high) return std::string();
                return value + " is out of range; give " + text;
            },
            text};
}

/// Reads all of `text` as a number without sign.
template <class T>
bool read_whole(const std::string& text, T& number) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc() && read.ptr == end;
}

/// Any number of 64 bits; CLI11 2.1 lets others wrap around.
CLI::Validator seed_number() {
    return {[](std::string& value) {
                std::uint64_t number = 0;
                if (read_whole(value, number)) return std::string();
                return "'" + value + "' is no seed; give 0 to 18446744073709551615";
            },
            "0 to 2^64-1"};
}

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

template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& target,
                        const std::map<std::string, T>& choices, const std::string& help) {
    std::string names;
    for (const auto& [key, value] : choices) names += (names.empty() ? "" : "|") + key;
    return app
        .add_option_function<std::string>(
            name,
            [&target, choices, name, names](const std::string& text) {
                const auto found = choices.find(text);
                if (found == choices.end())
                    throw CLI::ValidationError(name,
                                               "'" + text + "' is unknown; choose one of " + names);
                target = found->second;
            },
            help)
        ->type_name(names);
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
           "How VPLs are placed: mir, Metropolis sampling (default); bir, bidirectional with "
           "resampling; ir, instant radiosity; roulette, the same with roulette on what a VPL "
           "gives to the image; keller, a fixed share survives each bounce")
        ->type_name("mir|bir|ir|roulette|keller");
}

/// A whole number option of a smaller type than int.
template <class T>
CLI::Option* add_count(CLI::App& app, const std::string& name, T& target, int low, int high,
                       const std::string& help) {
    return app
        .add_option_function<int>(
            name, [&target](int n) { target = static_cast<T>(n); }, help)
        ->check(between(low, high, std::to_string(low) + " to " + std::to_string(high)))
        ->type_name("N");
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
    add_count(app, "--chains", m.chains, 1, 65536, "Markov chains (default 128)");
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
                   "Relative standard error wanted of P_c (default 0.03)")
        ->check(between(1e-6, 1, "above 0 to 1"));
    add_choice<mir::ChainStop>(
        app, "--stop", m.stop, {{"fixed", mir::ChainStop::fixed}, {"paper", mir::ChainStop::paper}},
        "End of the chains: a fixed number of states (default) or of new VPLs, as the paper "
        "prints it, biased");
}

void add_reference(CLI::App& app, mir::RenderSettings& s) {
    add_choice<mir::Integrator>(app, "--integrator", s.integrator,
                                {{"vpl", mir::Integrator::vpl}, {"path", mir::Integrator::path}},
                                "VPLs (default) or the reference path tracer");
    add_count(app, "--samples", s.path.samples, 1, 1 << 24,
              "Camera paths per luxel of --integrator path (default 256)");
    add_choice<mir::LightSearch>(app, "--light-search", s.path.light,
                                 {{"mis", mir::LightSearch::mis},
                                  {"lamps", mir::LightSearch::lamps},
                                  {"directions", mir::LightSearch::directions}},
                                 "How its paths find lamps: light samples and directions weighed "
                                 "(default), or one of them alone");
    add_count(app, "--directions", s.path.directions, 1, 65536,
              "Directions that go on from its first hit (default 1)");
}

void add_sampling(CLI::App& app, RenderOptions& o) {
    mir::RenderSettings& s = o.settings;
    add_sampler(app, s);
    add_choice<mir::Sequence>(
        app, "--sequence", s.sequence,
        {{"random", mir::Sequence::random}, {"halton", mir::Sequence::halton}},
        "Numbers behind the light paths (default random)");
    app.add_option("--vpls", s.vpls, "Geometric VPLs wanted (default 256)")
        ->check(between(1, 4e6, "1 to 4000000"));
    add_choice<mir::DirectLight>(
        app, "--direct", s.direct,
        {{"separate", mir::DirectLight::separate}, {"vpl", mir::DirectLight::vpl}},
        "Direct light by samples of the lamps (default) or by VPLs on them");
    app.add_option("--direct-samples", s.direct_samples, "Lamp samples per pixel (default 16)")
        ->check(between(1, 65536, "1 to 65536"));
    add_count(app, "--bounces", s.max_bounce, 1, 254,
              "Largest number of reflections on the way to the camera (default 32)");
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
    app.add_option("--seed", s.seed, "Seed of all random numbers (default 0)")
        ->check(seed_number());
}

void add_image(CLI::App& app, RenderOptions& o) {
    mir::RenderSettings& s = o.settings;
    const auto side = between(1, 65536, "1 to 65536");
    app.add_option("--width", o.width, "Pixels across (default: the scene's, else 480 high)")
        ->check(side);
    app.add_option("--height", o.height, "Pixels down")->check(side);
    app.add_option("--luxels", s.luxels_per_pixel, "Luxels per pixel (default 1)")
        ->check(between(1, 64, "1 to 64"));
    app.add_option("--camera", o.camera, "Camera of the scene, by name or index (default 0)");
    std::map<std::string, mir::Filter> filters;
    for (const mir::FilterName& f : mir::filter_names)
        filters.emplace(f.name, mir::default_filter(f.kind));
    add_choice<mir::Filter>(app, "--filter", s.filter, filters,
                            "Pixel filter (default lanczos, the paper's windowed sinc)");
}

void add_output(CLI::App& app, RenderOptions& o) {
    app.add_option("-o,--output", o.output, "Picture to write (default SCENE.exr)");
    app.add_option("--png", o.preview, "Preview to write (default: beside the EXR)");
    app.add_flag("--no-png", o.no_preview, "Write no preview");
    app.add_option("--exposure", o.exposure, "Exposure of the preview, EV (default: automatic)")
        ->check(between(-100, 100, "-100 to 100"));
    app.add_option("--aov", o.layers,
                   "Layers of the EXR: albedo, normal, position, depth, direct, indirect, "
                   "emission, bounces, or none (default: all but bounces)")
        ->delimiter(',')
        ->check(CLI::IsMember(layer_names))
        ->each([&o](const std::string& name) { o.no_layers |= name == "none"; });
    app.add_flag("--record-seconds", o.record_seconds,
                 "Store the render time in the EXR (its bytes then differ every time)");
    app.add_flag("--json", o.json, "Print statistics as JSON on stdout");
    app.add_flag("-q,--quiet", o.quiet, "No progress, no summary");
}

void add_execution(CLI::App& app, RenderOptions& o) {
    mir::RenderSettings& s = o.settings;
    app.add_option("--threads", s.threads, "Threads (default 0: every core)")
        ->check(between(0, 1024, "0 to 1024"));
    app.add_option("--scheduler", s.scheduler,
                   "cpu-blocks, tuned (default), or cpu, the plain loop; the picture is the same")
        ->check(CLI::IsMember({"cpu", "cpu-blocks"}));
    app.add_option_function<std::string>(
           "--tile", [&s](const std::string& text) { s.tile = read_tile(text); },
           "Luxels scheduled together (default 256x256); the picture does not depend on it")
        ->type_name("WxH");
    app.add_flag("--allow-no-light", s.allow_no_light, "Render a scene without light, black");
}

/// Files of the comparison of two pictures; the ending of --error says what it is.
void add_compare_output(CLI::App& app, CompareOptions& o) {
    app.add_option("--html", o.report, "Report to write, one HTML file with pictures");
    app.add_option("--error", o.error, "Signed error to write: a picture (.png) or values (.exr)")
        ->check(CLI::Validator(
            [](const std::string& name) {
                return name.ends_with(".png") || name.ends_with(".exr")
                           ? std::string()
                           : "'" + name + "' ends neither in .png nor in .exr";
            },
            ""));
    app.add_flag("--json", o.json, "Print the metrics as JSON on stdout");
}

void add_compare(CLI::App& app, CompareOptions& o) {
    app.add_option("image", o.image, "OpenEXR picture")->required();
    app.add_option("reference", o.reference, "OpenEXR picture to compare it with")->required();
    app.add_option("--layer", o.layer, "Layer to compare in both (default: the beauty)");
    add_compare_output(app, o);
    const auto limit = between(0, 1e30, "0 to 1e30");
    app.add_option("--max-rmse", o.max_rmse, "Exit with 1 when the RMSE is above")->check(limit);
    app.add_option("--max-relmse", o.max_relmse, "Exit with 1 when the relMSE is above")
        ->check(limit);
    app.add_option("--max-flip", o.max_flip, "Exit with 1 when the mean HDR-FLIP is above")
        ->check(limit);
    app.add_option(
           "--max-mean-difference", o.max_mean_difference,
           "Exit with 1 when the mean of a channel is further from the reference's, percent")
        ->check(limit);
    app.add_option("--epsilon", o.epsilon, "Epsilon of the relMSE (default 0.01)")
        ->check(between(0, 1e30, "0 to 1e30"));
    app.add_option("--pixels-per-degree", o.pixels_per_degree,
                   "Pixels per degree of visual angle, for FLIP (default 67)")
        ->check(between(1, 1000, "1 to 1000"));
    app.add_option("--exposure", o.exposure,
                   "Exposure of pictures and LDR-FLIP, EV (default: automatic)")
        ->check(between(-100, 100, "-100 to 100"));
}

/// The word to complain about: an option rather than the value behind it.
std::string worst_of(const std::vector<std::string>& strangers) {
    for (const std::string& word : strangers)
        if (word.starts_with('-')) return word;
    return strangers.back();
}

int complain(const CLI::App& app, const CLI::ParseError& e) {
    const CLI::App* used = &app;
    for (const CLI::App* sub : app.get_subcommands()) used = sub;
    const std::vector<std::string> strangers = used->remaining(false);
    const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr;
    std::cerr << "mir: " << (unknown ? "unknown argument '" + worst_of(strangers) + "'" : e.what());
    std::vector<std::string> known;
    for (const CLI::Option* option : used->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const CLI::App* sub : used->get_subcommands({})) known.push_back(sub->get_name());
    for (const std::string& word : strangers)
        if (const auto guess = nearest(word.substr(0, word.find('=')), known))
            std::cerr << "; did you mean " << *guess << "?";
    std::cerr << "\nmir: see 'mir" << (used == &app ? "" : " " + used->get_name()) << " --help'\n";
    return exit_usage;
}

}  // namespace

Parsed parse(int argc, char** argv) {
    RenderOptions render;
    InfoOptions info;
    ExportOptions exporting;
    CompareOptions compare;
    DevicesOptions devices;

    CLI::App app{"Metropolis Instant Radiosity: renders a glTF scene with virtual point lights",
                 "mir"};
    app.set_version_flag("--version", [] {
        return std::string("mir ") + mir::version + " (" + mir::cpu::description() + ")";
    });
    app.require_subcommand(1);
    const std::string scene = "glTF file (.gltf, .glb) or builtin:NAME";

    CLI::App* r = app.add_subcommand("render", "Render a scene to EXR and PNG");
    r->add_option("scene", render.scene, scene)->required();
    add_output(*r, render);
    add_image(*r, render);
    add_sampling(*r, render);
    add_chains(*r, render.settings);
    add_reference(*r, render.settings);
    add_execution(*r, render);

    CLI::App* i = app.add_subcommand("info", "Tell what a scene holds and what is not supported");
    i->add_option("scene", info.scene, scene)->required();
    i->add_flag("--json", info.json, "JSON on stdout");

    CLI::App* x = app.add_subcommand("export", "Write a scene as glTF binary");
    x->add_option("scene", exporting.scene, scene)->required();
    x->add_option("-o,--output", exporting.output, "File to write (.glb)")->required();

    CLI::App* c = app.add_subcommand("compare", "Compare a picture with a reference");
    add_compare(*c, compare);

    CLI::App* d = app.add_subcommand("devices", "List what can render on this machine");
    d->add_flag("--json", devices.json, "JSON on stdout");

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        return complain(app, e);
    }
    if (render.no_layers && render.layers.size() > 1)
        return complain(app, CLI::ValidationError("--aov", "none goes with no other layer"));
    if (r->parsed()) return Command{render};
    if (i->parsed()) return Command{info};
    if (x->parsed()) return Command{exporting};
    if (c->parsed()) return Command{compare};
    return Command{devices};
}

}  // namespace mirtool
