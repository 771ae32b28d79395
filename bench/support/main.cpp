// SPDX-License-Identifier: MIT
#include "bench_scene.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/version.hpp"

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>

namespace mirbench {

BenchScene::BenchScene(mir::Scene from)
    : scene(std::move(from)),
      hash(mir::SceneHash(scene).hex()),
      geometry(scene),
      engine(geometry),
      lights(scene, geometry),
      surfaces(scene) {
    const float aspect =
        static_cast<float>(paper_image.width) / static_cast<float>(paper_image.height);
    visible_area = mir::visible_area(scene.cameras.front(), aspect,
                                     mir::LuxelTracer{engine.ray_caster(), surfaces.view()});
}

GBuffer BenchScene::gbuffer(mir::Extent image, mir::Extent tile) const {
    GBuffer gbuffer(image, tile);
    mir::TbbExecutor executor;
    const mir::CameraRays rays{scene.cameras.front(), mir::luxel_grid(image, 1), 0};
    mir::fill_gbuffer<Bsdf>(gbuffer, 0, rays, engine.ray_caster(), surfaces, executor);
    return gbuffer;
}

mir::VplList BenchScene::vpls(std::uint32_t count) const {
    mir::InstantRadiosityOptions options;
    options.vpls = count + count / 4 + 64;
    mir::InlineExecutor executor;
    const mir::InstantRadiositySampler<Bsdf, mir::cpu::EmbreeRayCaster> sampler(
        {geometry, lights, surfaces, engine.ray_caster()}, options);
    const mir::VplList all = mir::aggregate(sampler.sample(executor));
    mir::VplList some;
    for (std::uint32_t i = 0; i < std::min(count, all.size()); ++i)
        some.push_back(all.vpls()[i], all.origins()[i]);
    return some;
}

mir::VplShading<Bsdf> BenchScene::shading(std::uint32_t vpls) const {
    return {mir::default_bound(visible_area, vpls)};
}

const BenchScene& bench_scene(const std::string& name) {
    static std::map<std::string, std::unique_ptr<BenchScene>> cache;
    std::unique_ptr<BenchScene>& entry = cache[name];
    const std::string prefix = "builtin:";
    if (!entry && name.starts_with(prefix))
        entry = std::make_unique<BenchScene>(mir::builtin::make(name.substr(prefix.size())));
    if (!entry) entry = std::make_unique<BenchScene>(mir::read_gltf(name).scene);
    return *entry;
}

std::vector<std::string> scenes_of_run() {
    const char* list = std::getenv("MIR_BENCH_SCENES");
    std::istringstream words(list != nullptr ? list : "builtin:sphere");
    std::vector<std::string> names;
    for (std::string name; std::getline(words, name, ',');) names.push_back(name);
    return names;
}

mir::WideBvhOptions wide_options_of_run() {
    mir::WideBvhOptions options;
    if (const char* splits = std::getenv("MIR_BENCH_SPLITS"))
        options.splits = std::strtof(splits, nullptr);
    mir::check(options);
    return options;
}

std::uint64_t count_facing(const GBuffer& gbuffer, const mir::VplList& vpls,
                           mir::TbbExecutor& executor) {
    std::atomic<std::uint64_t> facing{0};
    executor.for_each(gbuffer.tiles().size(), [&](std::size_t t) {
        const auto view = gbuffer.view(static_cast<mir::TileIndex>(t));
        std::uint64_t here = 0;
        for (mir::LuxelIndex i = 0; i < view.size(); ++i)
            for (const mir::Vpl& vpl : vpls.vpls()) here += mir::faces(view.hit(i), vpl) ? 1 : 0;
        facing += here;
    });
    return facing;
}

}  // namespace mirbench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::AddCustomContext("mir_version", mir::version);
    benchmark::AddCustomContext("compiler", MIR_COMPILER);
    benchmark::AddCustomContext("embree", RTC_VERSION_STRING);
    try {
        for (const std::string& name : mirbench::scenes_of_run())
            benchmark::AddCustomContext("scene_hash " + name, mirbench::bench_scene(name).hash);
        benchmark::AddCustomContext("splits",
                                    std::to_string(mirbench::wide_options_of_run().splits));
        benchmark::RunSpecifiedBenchmarks();
    } catch (const mir::Error& e) {
        std::fprintf(stderr, "bench: %s\n", e.what());
        return 3;
    }
    benchmark::Shutdown();
    return 0;
}
