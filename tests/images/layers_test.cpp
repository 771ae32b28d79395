// SPDX-License-Identifier: MIT
//
// Every sampler and integrator against the path tracer on every opaque built-in scene with all
// materials Lambertian, and VPLs with caustics on the others as they are: the mean of each layer,
// with what renders say that their VPLs lack.
// agreement_test.cpp compares bounce by bounce and tile by tile, under one bound.
#include "layer_means.hpp"
#include "support/catch.hpp"
#include "support/lambertian_scene.hpp"

#include <algorithm>
#include <string_view>

using namespace mirtest;
using mir::RenderSettings;
using mir::SamplerKind;

namespace {

constexpr std::uint64_t path_seed = 900;  // of the path tracer's first run; the others begin at 0

/// Luxels move with the seed. Lamps may touch what they light, where few samples have long tails.
RenderSettings usual(std::uint32_t vpls) {
    RenderSettings s = small_settings(12, vpls);
    s.luxels_per_pixel = 4;
    s.direct_samples = 256;
    s.bound = {};
    s.measure_missing = true;
    return s;
}

RenderSettings light_paths(std::uint32_t vpls = 1024) {
    RenderSettings s = usual(vpls);
    s.sampler = SamplerKind::instant_radiosity;
    return s;
}
RenderSettings levels() {
    RenderSettings s = light_paths();
    s.termination = mir::Termination::levels;
    return s;
}
RenderSettings vpl_roulette() {
    RenderSettings s = light_paths(512);
    s.vpl_roulette = true;
    return s;
}
RenderSettings bidirectional() {
    RenderSettings s = usual(128);
    s.sampler = SamplerKind::bidirectional;
    return s;
}
/// Short chains and a short bootstrap save time. Fewer chains than VPLs, or nothing would mutate.
RenderSettings metropolis() {
    RenderSettings s = usual(256);
    s.sampler = SamplerKind::metropolis;
    s.metropolis.chains = 128;
    s.metropolis.stride = 16;
    s.metropolis.chain.tries = 4;
    s.metropolis.bootstrap = {1.0, 1u << 14, 1u << 14};
    return s;
}
RenderSettings lamps_as_vpls(RenderSettings s) {
    s.direct = mir::DirectLight::vpl;
    return s;
}
RenderSettings discs() {
    RenderSettings s = usual(1);
    s.integrator = mir::Integrator::micro;
    s.micro.surfels = 256;
    s.micro.surfel_rays = 4;
    s.micro.gather.rays = 8;
    return s;
}
RenderSettings paths() {
    RenderSettings s = usual(1);
    s.integrator = mir::Integrator::path;
    s.path.samples = 32;
    return s;
}

/// A way to make a picture, and the layers that are to be those of the path tracer.
struct Way {
    const char* name;
    RenderSettings settings;
    std::span<const Layer> layers = all_layers;
};

std::vector<Way> main_ways() { return {{"ir", light_paths()}, {"mir", metropolis()}}; }

/// VPLs on lamps bring direct light in the layer of indirect light. Light gathered from discs has a
/// bias (micro_test.cpp). Left out: spheres, which spread light (vsl_test.cpp), and lobes, which
/// Lambertian surfaces do not have (glossy_test.cpp).
std::vector<Way> other_ways() {
    static constexpr std::array sums{Layer::emission, Layer::beauty};
    static constexpr std::array exact{Layer::emission, Layer::direct};
    return {{"bir", bidirectional()},
            {"keller", levels()},
            {"roulette", vpl_roulette()},
            {"ir, lamps as VPLs", lamps_as_vpls(light_paths()), sums},
            {"bir, lamps as VPLs", lamps_as_vpls(bidirectional()), sums},
            {"mir, lamps as VPLs", lamps_as_vpls(metropolis()), sums},
            {"micro", discs(), exact}};
}

/// Scenes of more than 400 000 triangles, whose hierarchies take most of the time of small
/// pictures.
bool is_large(std::string_view name) { return name.starts_with("car") || name == "garage"; }

/// No light goes through any surface of it: Lambertian materials have no glass.
bool is_opaque(const mir::Scene& scene) {
    return std::ranges::none_of(scene.materials, [](const mir::Material& m) {
        return m.is_blended || m.transmission > 0.0f;
    });
}

std::vector<std::string_view> scenes(bool large) {
    std::vector<std::string_view> names;
    for (const mir::builtin::Entry& e : mir::builtin::scenes)
        if (is_large(e.name) == large && is_opaque(e.make())) names.push_back(e.name);
    return names;
}

/// Scenes of glass, mirrors and leaves.
std::vector<std::string_view> see_through_scenes() {
    std::vector<std::string_view> names;
    for (const mir::builtin::Entry& e : mir::builtin::scenes)
        if (!is_opaque(e.make())) names.push_back(e.name);
    return names;
}

std::vector<mir::RenderResult> rendered(const mir::Scene& scene, RenderSettings s,
                                        std::uint32_t runs, std::uint64_t first_seed = 0) {
    std::vector<mir::RenderResult> renders;
    for (s.seed = first_seed; renders.size() < runs; ++s.seed) renders.push_back(render(scene, s));
    return renders;
}

/// Compares with the path tracer; level 0.1 % over all scenes and ways.
void check(const std::vector<std::string_view>& names, const std::vector<Way>& ways,
           std::uint32_t runs) {
    const double level = sidak(1e-3, names.size() * ways.size());
    for (const std::string_view name : names) {
        const mir::Scene scene = all_lambertian(mir::builtin::make(name));
        const LayerMeans truth(rendered(scene, paths(), runs, path_seed));
        for (const Way& way : ways) {
            const LayerMeans means(rendered(scene, way.settings, runs));
            INFO(name << ", " << way.name << " and path\n" << beside(means, truth, way.layers));
            CHECK(agreement(means, truth, way.layers) > level);
        }
    }
}

}  // namespace

// H0: equal means of emission, direct light, indirect light and beauty. Welch's test over 12 seeds
// each, 0 to 11 and for the path tracer 900 to 911, over the picture and for direct light in 4
// tiles; level 0.1 % over 10 scenes and 2 samplers.
TEST_CASE("IR and MIR bring each layer of the path tracer to every small scene", "[statistical]") {
    check(scenes(false), main_ways(), 12);
}

// H0 and test as above, over 8 seeds, 10 scenes and 7 ways.
TEST_CASE("every other sampler and integrator brings layers of the path tracer to small scenes",
          "[statistical][extended]") {
    check(scenes(false), other_ways(), 8);
}

// H0 and test as above, over 6 seeds, 5 scenes and 2 samplers.
TEST_CASE("IR and MIR bring each layer of the path tracer to every large scene",
          "[statistical][extended]") {
    check(scenes(true), main_ways(), 6);
}

namespace {

/// Renders with caustics twice, made of such with and without them from the same seeds.
std::vector<mir::RenderResult> with_caustics_twice(std::vector<mir::RenderResult> with,
                                                   const std::vector<mir::RenderResult>& without) {
    for (std::size_t i = 0; i < with.size(); ++i)
        for (const auto layer : {&mir::RenderResult::direct, &mir::RenderResult::indirect}) {
            auto&& pixels = (with[i].*layer).pixels();
            for (std::size_t k = 0; k < pixels.size(); ++k)
                pixels[k] += pixels[k] - (without[i].*layer).pixels()[k];
        }
    return with;
}

}  // namespace

// H0: equal means of emission, direct light, indirect light and beauty, with the scenes' own
// materials: VPLs, and light paths for what mirrors and glass throw on surfaces, against the path
// tracer. Test and seeds as above, level 1 % over 4 scenes. Rejected where caustics are left out or
// counted twice, in the scenes that they light.
TEST_CASE("VPLs and caustics together bring the light of the path tracer through glass",
          "[statistical][extended]") {
    const auto names = see_through_scenes();
    REQUIRE(names.size() == 4);
    const double level = sidak(1e-2, names.size());
    RenderSettings s = light_paths();
    s.caustics = 64;
    RenderSettings without = s;
    without.caustics = 0;
    RenderSettings reference = paths();
    reference.path.samples = 192;
    for (const std::string_view name : names) {
        const mir::Scene scene = mir::builtin::make(name);
        const LayerMeans truth(rendered(scene, reference, 12, path_seed));
        const auto renders = rendered(scene, s, 12);
        const LayerMeans means(renders);
        INFO(name << '\n' << beside(means, truth, all_layers));
        CHECK(agreement(means, truth, all_layers) > level);
        if (name != "caustics" && name != "sphere-behind-glass") continue;
        const auto dark = rendered(scene, without, 12);
        const LayerMeans less(dark);
        const LayerMeans more(with_caustics_twice(renders, dark));
        INFO("without caustics:\n"
             << beside(less, truth, all_layers) << "with them twice:\n"
             << beside(more, truth, all_layers));
        CHECK(agreement(less, truth, all_layers) < level);
        CHECK(agreement(more, truth, all_layers) < level);
    }
}

namespace {

/// The renders with `factor` times as much light in one layer.
std::vector<mir::RenderResult> with_more(std::vector<mir::RenderResult> renders,
                                         mir::Image<mir::Rgb> mir::RenderResult::*layer,
                                         float factor) {
    for (mir::RenderResult& r : renders)
        for (mir::Rgb& p : (r.*layer).pixels()) p = p * factor;
    return renders;
}

/// The renders, silent about what they lack.
std::vector<mir::RenderResult> silent(std::vector<mir::RenderResult> renders) {
    for (mir::RenderResult& r : renders) {
        r.statistics.cut.reset();
        r.statistics.removed.reset();
    }
    return renders;
}

}  // namespace

// H0 and test as in the first test, level 0.1 % over 2 ways to lack light: true of renders that say
// what they lack, rejected of those that do not.
TEST_CASE("what a render says that it lacks is what the path tracer has more", "[statistical]") {
    const double level = sidak(1e-3, 2);
    RenderSettings bounded = light_paths();
    bounded.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
    RenderSettings short_paths = light_paths();
    short_paths.max_bounce = 3;
    for (const auto& [name, s] :
         {std::pair{"corner", bounded}, std::pair{"cornell-box", short_paths}}) {
        const mir::Scene scene = mir::builtin::make(name);
        const LayerMeans truth(rendered(scene, paths(), 12, path_seed));
        const auto renders = rendered(scene, s, 12);
        const LayerMeans means(renders);
        const LayerMeans less(silent(renders));
        INFO(name << '\n'
                  << beside(means, truth, all_layers) << "silent:\n"
                  << beside(less, truth, all_layers));
        CHECK(agreement(means, truth, all_layers) > level);
        CHECK(agreement(less, truth, all_layers) < level);
    }
}

// H0 and test as in the first test, rejected.
TEST_CASE("a layer with 5 % more light is not that of the path tracer", "[statistical]") {
    using Picture = mir::Image<mir::Rgb> mir::RenderResult::*;
    const double level = sidak(1e-3, scenes(false).size() * main_ways().size());
    const auto check_more = [&](const char* name, const std::vector<Picture>& pictures) {
        const mir::Scene scene = mir::builtin::make(name);
        const LayerMeans truth(rendered(scene, paths(), 12, path_seed));
        const auto renders = rendered(scene, metropolis(), 12);
        for (const Picture picture : pictures) {
            const LayerMeans means(with_more(renders, picture, 1.05f));
            INFO(name << '\n' << beside(means, truth, all_layers));
            CHECK(agreement(means, truth, all_layers) < level);
        }
    };
    check_more("furnace", {&mir::RenderResult::emission, &mir::RenderResult::indirect});
    check_more("cornell-box", {&mir::RenderResult::direct});
}
