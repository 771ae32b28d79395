// SPDX-License-Identifier: MIT
#include "micro_scene.hpp"

#include "mir/core/warp.hpp"
#include "mir/micro/surfel_albedo.hpp"
#include "mir/micro/surfel_direct_light.hpp"

#include <memory>

namespace mirbench {
namespace {

/// Points on lamps that light one side of a disc.
constexpr std::uint32_t lamp_samples = 4;

MicroLuxels luxels_of(const BenchScene& scene, const mir::LuxelGrid& grid) {
    MicroLuxels luxels(grid.luxels(), grid.luxels());
    mir::TbbExecutor executor;
    const mir::SurfaceTable<mir::Lambert> surfaces(scene.scene);
    const mir::CameraRays rays{scene.scene.cameras.front(), grid, 0};
    mir::fill_gbuffer<mir::Lambert>(luxels, 0, rays, scene.engine.ray_caster(), surfaces, executor);
    return luxels;
}

std::vector<mir::SurfelRadiance> light_of(const BenchScene& scene, const mir::SurfelTree& tree) {
    mir::TbbExecutor executor;
    const mir::SurfaceTable<mir::Lambert> surfaces(scene.scene);
    const mir::SurfelDirectLight<mir::Lambert, mir::cpu::EmbreeRayCaster,
                                 mir::cpu::EmbreeVisibility>
        direct({scene.geometry, scene.lights, surfaces, scene.engine.ray_caster(),
                scene.engine.visibility()},
               lamp_samples, 1);
    return mir::light_surfels(mir::SurfelPatches(tree), direct, scene.geometry.ray_offset(),
                              executor);
}

}  // namespace

std::vector<mir::Surfel> surfels_of(const BenchScene& scene, double count) {
    mir::TbbExecutor executor;
    mir::SurfelOptions options;
    options.max_area = static_cast<float>(surface_area(scene.geometry) / count);
    return make_surfels(scene.geometry, options, {}, executor);
}

mir::SurfelTree tree_of(const BenchScene& scene, double count,
                        const mir::SurfelTreeOptions& options) {
    mir::TbbExecutor executor;
    const mir::SurfaceTable<mir::Lambert> surfaces(scene.scene);
    return {surfels_of(scene, count), mir::SurfelAlbedo<mir::Lambert>(surfaces, scene.geometry),
            options, executor};
}

std::vector<mir::SurfelRay> gather_rays(const BenchScene& scene, std::uint32_t count) {
    const MicroLuxels luxels = luxels_of(scene, mir::luxel_grid({256, 256}, 1));
    const auto view = luxels.view(0);
    std::vector<mir::SurfelRay> rays;
    mir::Random random(1, mir::Stream::test, 0);
    while (rays.size() < count) {
        const auto at = static_cast<float>(view.size()) * random.next();
        const mir::Hit hit = view.hit(std::min(static_cast<mir::LuxelIndex>(at), view.size() - 1));
        const mir::Vec3 local = mir::square_to_cosine_hemisphere(random.next_2d());
        if (is_empty(hit) || !(local.z > 0.0f)) continue;
        const mir::Vec3 wi = mir::Frame::around(hit.normal).to_world(local);
        rays.push_back({hit.position, wi, hit.normal, 0.0f});
    }
    return rays;
}

MicroScene::MicroScene(const BenchScene& from, mir::Extent image, double discs)
    : tree(tree_of(from, discs)),
      radiance(light_of(from, tree)),
      luxels(luxels_of(from, mir::luxel_grid(image, 1))),
      band{0, mir::luxel_grid(image, 1), 1} {}

const MicroScene& micro_scene(const std::string& name, mir::Extent image, double discs) {
    static std::string key;
    static std::unique_ptr<MicroScene> scene;
    const std::string wanted = name + ' ' + std::to_string(image.width) + 'x' +
                               std::to_string(image.height) + ' ' + std::to_string(discs);
    if (key != wanted) {
        scene = std::make_unique<MicroScene>(bench_scene(name), image, discs);
        key = wanted;
    }
    return *scene;
}

}  // namespace mirbench
