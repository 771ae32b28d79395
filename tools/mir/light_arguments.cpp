// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "option_types.hpp"

#include <cmath>

namespace mirtool {
namespace {

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
           "How VPLs are placed: mir, where they matter to the image, by Metropolis sampling "
           "(default for --vpls up to 8192); bir, where they matter, by paths from both ends; ir, "
           "wherever light goes (instant radiosity, default otherwise); roulette, the same, kept "
           "by what they give to the image; keller, a fixed share survives each bounce")
        ->type_name("mir|bir|ir|roulette|keller");
}

void add_chains(CLI::App& app, mir::RenderSettings& s) {
    begin_group(app, group_of_chains);
    mir::MetropolisTuning& m = s.metropolis;
    add_choice<mir::NormalisationPolicy>(
        app, "--normalise", s.normalisation,
        {{"full", mir::NormalisationPolicy::full},
         {"prepass", mir::NormalisationPolicy::prepass},
         {"proposal", mir::NormalisationPolicy::proposal}},
        "Where the light that a VPL gives to the image is measured: on all luxels (full, default), "
        "on a few (prepass), or while sampling (proposal)");
    add_count(app, "--prepass-luxels", s.prepass_luxels, 1, 1 << 24,
              "Luxels of --normalise prepass (default 4096)");
    add_count(app, "--chains", m.chains, 1, 1 << 22,
              "Markov chains at most (default: as many as VPLs)");
    add_count(app, "--stride", m.stride, 1, 1 << 20,
              "Mutations from one recorded state to the next (default 64)");
    add_count(app, "--tries", m.chain.tries, 1, 254, "Candidates of a large step (default 8)");
    app.add_option("--large-steps", m.chain.large_step_probability,
                   "Share of large steps among mutations (default 0.5)")
        ->check(between(1e-6, 1, "above 0 to 1"));
    add_choice<mir::Mutation>(
        app, "--mutation", m.chain.mutation,
        {{"primary", mir::Mutation::primary}, {"bidirectional", mir::Mutation::bidirectional}},
        "The other mutations: of the random numbers behind a path (primary, default) or of the "
        "path itself (bidirectional)");
    add_choice<mir::PathTechniques>(app, "--paths", m.techniques,
                                    {{"camera", mir::PathTechniques::camera},
                                     {"bidirectional", mir::PathTechniques::bidirectional}},
                                    "How whole paths are built: from the camera alone, or from "
                                    "both ends (bidirectional, default)");
    add_count(app, "--suffix-refresh", m.suffix_refresh, 0, 255,
              "Further light paths behind each recorded VPL (default 8)");
    app.add_option("--bootstrap-error", m.bootstrap.relative_error,
                   "Standard error wanted of the brightness of the indirect light, a share of it "
                   "(default 0.57 / sqrt(chains), at most 0.05: 0.018 for 1024 VPLs)")
        ->check(between(1e-6, 1, "above 0 to 1"));
    add_choice<mir::ChainStop>(
        app, "--stop", m.stop, {{"fixed", mir::ChainStop::fixed}, {"paper", mir::ChainStop::paper}},
        "End of the chains: a fixed number of states (fixed, default) or of new VPLs, as the paper "
        "prints it, biased (paper)");
}

void add_path_tracer(CLI::App& app, mir::RenderSettings& s) {
    begin_group(app, "Path tracer (--integrator path)");
    add_count(app, "--samples", s.path.samples, 1, 1 << 24, "Camera paths per luxel (default 64)");
    add_choice<mir::LightSearch>(app, "--light-search", s.path.light,
                                 {{"mis", mir::LightSearch::mis},
                                  {"lamps", mir::LightSearch::lamps},
                                  {"directions", mir::LightSearch::directions}},
                                 "How paths find lamps: by samples of the lamps and by scattered "
                                 "directions (mis, default), or by one of them alone");
    add_count(app, "--directions", s.path.directions, 1, 65536,
              "Paths that go on from the first hit (default 1)");
}

void add_micro(CLI::App& app, mir::RenderSettings& s) {
    begin_group(app, "Micro-rendering (--integrator micro)");
    mir::MicroSettings& m = s.micro;
    app.add_option("--surfels", m.surfels,
                   "Discs wanted on the surfaces of the scene (default 16384)")
        ->check(between(1, 1.6e7, "1 to 16000000"));
    add_choice<mir::MicroGather>(
        app, "--gather", m.luxels,
        {{"exact", mir::MicroGather::exact},
         {"rays", mir::MicroGather::rays},
         {"buffers", mir::MicroGather::buffers}},
        "How a luxel gathers light: by rays to the triangles (exact, default), by rays that stop "
        "at groups of discs (rays), or by a small picture of those (buffers)");
    add_count(app, "--buffer-size", m.buffer_side, 1, mir::BufferGatherOptions::largest_side,
              "Texels a side of the small picture of --gather buffers (default 16)");
    add_choice<mir::BufferWarp>(
        app, "--buffer-warp", m.buffer_warp,
        {{"hemisphere", mir::BufferWarp::hemisphere}, {"importance", mir::BufferWarp::importance}},
        "Where its texels look: into the hemisphere, by the cosine (hemisphere, default), or on "
        "glossy surfaces also into their lobe, by a second picture (importance)");
    add_count(app, "--gather-rays", m.gather.rays, 1, 65536,
              "Rays with which a luxel gathers (default 128)");
    add_choice<mir::GatherDirections>(
        app, "--gather-directions", m.gather.directions,
        {{"cosine", mir::GatherDirections::cosine}, {"uniform", mir::GatherDirections::uniform}},
        "Density of these rays over the hemisphere (default cosine)");
    app.add_option(
           "--gather-threshold", m.gather.threshold,
           "How large a group of discs may look where --gather rays or buffers stops at it, "
           "in the solid angle of a ray or texel; 0 is exact (default 1)")
        ->check(between(0, 1e6, "0 to 1000000"));
    add_count(app, "--surfel-rays", m.surfel_rays, 1, 65536,
              "Rays with which each side of a disc gathers later bounces (default 32)");
    add_choice<mir::GatherCheck>(app, "--gather-check", m.check,
                                 {{"none", mir::GatherCheck::none},
                                  {"measure", mir::GatherCheck::measure},
                                  {"correct", mir::GatherCheck::correct}},
                                 "What is done about the difference from the light of paths: none; "
                                 "measure, at 2048 places; correct, in the picture too (default)");
}

void add_sampling(CLI::App& app, mir::RenderSettings& s) {
    begin_group(app, "Light");
    app.add_option("--vpls", s.vpls,
                   "Virtual point lights wanted: more give smoother light (default: by --quality, "
                   "262144; 1024 with --sampler, --sum all, --vsl or --glossy)")
        ->check(between(1, 4e6, "1 to 4000000"));
    add_sampler(app, s);
    add_choice<mir::Integrator>(app, "--integrator", s.integrator,
                                {{"vpl", mir::Integrator::vpl},
                                 {"path", mir::Integrator::path},
                                 {"micro", mir::Integrator::micro}},
                                "Where the light comes from: VPLs (vpl, default), paths for "
                                "reference (path), or discs on the surfaces (micro)");
    add_choice<mir::Sequence>(
        app, "--sequence", s.sequence,
        {{"random", mir::Sequence::random}, {"halton", mir::Sequence::halton}},
        "Numbers behind the light paths of --sampler ir and keller (default random)");
    add_choice<mir::LightSum>(
        app, "--sum", s.sum,
        {{"auto", mir::LightSum::automatic},
         {"all", mir::LightSum::all},
         {"cuts", mir::LightSum::cuts}},
        "VPLs that a luxel gathers: all; a few of many, picked from cuts of a tree (cuts); or what "
        "suits their number (auto, default)");
    add_count(app, "--picks", s.picks, 1, 65536,
              "VPLs of a luxel by cuts (default: by --quality, 256)");
    add_choice<mir::DirectLight>(
        app, "--direct", s.direct,
        {{"separate", mir::DirectLight::separate}, {"vpl", mir::DirectLight::vpl}},
        "Direct light by samples of the lamps (separate, default), or by VPLs on them and, of an "
        "environment, at infinity (vpl)");
    app.add_option("--direct-samples", s.direct_samples,
                   "Lamp samples per pixel (default: by --quality, 32)")
        ->check(between(1, 65536, "1 to 65536"));
    add_count(app, "--bounces", s.max_bounce, 1, 254,
              "Most reflections of light on its way to the camera (default 32; no limit with "
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
           "Limit of what one VPL gives to a near place, per square metre, against bright spots "
           "near edges: auto (default: found for the scene), none, or a number")
        ->type_name("auto|none|B");
    add_count(app, "--compensate", s.compensate, 0, 65536,
              "Paths per pixel that bring back the light that the bound removed (default: by "
              "--quality, 1; 0: none)");
    app.add_option_function<std::string>(
           "--caustics",
           [&s](const std::string& text) {
               s.skip_faint_caustics = text == "auto";
               if (text == "auto") return;
               s.caustics = 0;
               if (text == "none") return;
               if (!CLI::detail::lexical_cast(text, s.caustics) || s.caustics > 65536)
                   throw CLI::ValidationError(
                       "--caustics",
                       "'" + text + "' is neither auto, none nor a number up to 65536");
           },
           "Light paths per pixel that bring what mirrors and glass throw on surfaces: auto "
           "(default: by --quality, left out where they bring less than a thousandth of the "
           "light), none, or a number")
        ->type_name("auto|none|N");
    app.add_option("--seed", s.seed, "Seed of all random numbers (default 0)")
        ->check(seed_number());
}

/// VPLs that are more than points.
void add_kinds_of_vpls(CLI::App& app, mir::RenderSettings& s) {
    begin_group(app, "Spheres and lobes instead of points");
    CLI::Option* vsl =
        app.add_flag("--vsl", s.vsl.enabled,
                     "VPLs light as spheres, which spread the light that a bound would "
                     "remove");
    add_count(app, "--vsl-samples", s.vsl.samples, 1, 1024,
              "Directions towards each sphere, and as many by the surface's BSDF (default 8)")
        ->needs(vsl);
    app.add_option("--vsl-scale", s.vsl.scale, "Factor of the spheres' radii (default 1)")
        ->check(between(1e-3, 1e3, "0.001 to 1000"))
        ->needs(vsl);
    CLI::Option* glossy = app.add_flag("--glossy", s.glossy.enabled,
                                       "VPLs on glossy surfaces send out the lobe of their surface "
                                       "(only with --sampler ir or keller)");
    app.add_option("--glossy-roughness", s.glossy.least_roughness,
                   "Smoother surfaces send out lobes of this roughness (default 0.5)")
        ->check(between(0.0, 1.0, "0 to 1"))
        ->needs(glossy);
}

}  // namespace

void add_light(CLI::App& app, mir::RenderSettings& settings) {
    add_sampling(app, settings);
    add_kinds_of_vpls(app, settings);
    add_chains(app, settings);
    add_path_tracer(app, settings);
    add_micro(app, settings);
}

}  // namespace mirtool
