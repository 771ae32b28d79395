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
           "How VPLs are placed: mir, Metropolis sampling (default but with --sum cuts; up to "
           "--chains VPLs are "
           "independent draws, further ones mutations of those); bir, bidirectional with "
           "resampling; ir, instant radiosity (default with --sum cuts); roulette, the same with "
           "roulette on what a VPL "
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

/// Fills in what --sum cuts leaves open: light paths bring many VPLs at next to no cost.
void choose_for_cuts(const CLI::App& app, mir::RenderSettings& s) {
    if (s.sum != mir::LightSum::cuts) return;
    if (app.count("--vpls") == 0) s.vpls = 1u << 18;
    if (app.count("--sampler") == 0) s.sampler = mir::SamplerKind::instant_radiosity;
}

void add_sampling(CLI::App& app, mir::RenderSettings& s) {
    add_sampler(app, s);
    add_choice<mir::Sequence>(
        app, "--sequence", s.sequence,
        {{"random", mir::Sequence::random}, {"halton", mir::Sequence::halton}},
        "Numbers behind the light paths (default random)");
    app.add_option("--vpls", s.vpls, "Geometric VPLs wanted (default 1024; 262144 with --sum cuts)")
        ->check(between(1, 4e6, "1 to 4000000"));
    add_choice<mir::LightSum>(
        app, "--sum", s.sum,
        {{"auto", mir::LightSum::automatic},
         {"all", mir::LightSum::all},
         {"cuts", mir::LightSum::cuts}},
        "VPLs that a luxel gathers: all, a few of many, picked from cuts of a tree, or what suits "
        "their number (default)");
    add_count(app, "--picks", s.picks, 1, 65536, "VPLs of a luxel by cuts (default 128)");
    app.parse_complete_callback([&app, &s] { choose_for_cuts(app, s); });
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

}  // namespace

void add_light(CLI::App& app, mir::RenderSettings& settings) {
    add_sampling(app, settings);
    add_chains(app, settings);
    add_reference(app, settings);
    add_micro(app, settings);
}

}  // namespace mirtool
