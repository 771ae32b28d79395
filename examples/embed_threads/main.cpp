// SPDX-License-Identifier: MIT
//
// embed_threads [PICTURE.png]
//
// Metropolis instant radiosity on the host's own thread pool, without oneTBB or Embree. The picture
// has the same bits on any number of threads; a cancelled render leaves the pool as it was.
#include "pool_executor.hpp"

#include <mir/accel/kd/kd_tree_scene.hpp>
#include <mir/fill_gbuffer.hpp>
#include <mir/io/png.hpp>
#include <mir/place_vpls.hpp>
#include <mir/reconstruct.hpp>
#include <mir/sampling/metropolis_sampler.hpp>
#include <mir/scenes.hpp>
#include <mir/sched/cpu_blocks.hpp>
#include <mir/shading/vpl_shading.hpp>
#include <mir/validation/executor.hpp>

#include <exception>
#include <iostream>
#include <stdexcept>

namespace {

using Picture = mir::Image<mir::Rgb>;

/// Every stage takes the executor, the building of the tree included.
template <mir::Executor E>
Picture render(const mir::Scene& scene, E& executor, mir::Monitor* monitor) {
    using Bsdf = mir::Lambert;
    const mir::WorldGeometry geometry(scene);
    const mir::SurfaceTable<Bsdf> surfaces(scene);
    const mir::LightTable lights(scene, geometry);
    const mir::KdTreeScene tree(geometry, executor);

    const mir::CameraRays rays{scene.cameras[0], {{96, 96}}};
    mir::BlockedGBuffer<Bsdf::Params> luxels(rays.grid.luxels(), {32, 32});
    fill_gbuffer(luxels, 0, rays, tree.ray_caster(), surfaces, executor);

    const mir::VplShading<Bsdf> shading{.bound = 20.0f};
    const mir::PathWorld world{geometry,          lights,      surfaces, tree.ray_caster(),
                               tree.visibility(), rays.camera, 1.0f,     shading.bound};
    mir::MetropolisOptions options;
    options.states = 256;
    options.emitter_vpls = true;
    const mir::PlacedVpls placed = place_vpls(mir::MetropolisSampler(world, options), luxels,
                                              tree.visibility(), shading, executor);
    return reconstruct(mir::sched::CpuBlocks{executor, monitor}, luxels, placed.vpls.span(),
                       tree.visibility(), shading);
}

void require(bool holds, const std::string& otherwise) {
    if (!holds) throw std::runtime_error(otherwise);
}

bool is_cancelled(const mir::Scene& scene, host::PoolExecutor& executor) {
    mir::Monitor monitor;
    monitor.cancelled = true;  // another thread may set it at any time
    try {
        render(scene, executor, &monitor);
    } catch (const mir::Error& e) {
        return e.code() == mir::ErrorCode::cancelled;
    }
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        host::ThreadPool pool(3);
        host::PoolExecutor executor(pool);
        host::ThreadPool full(3, 1);
        host::PoolExecutor short_of_help(full);
        mir::validation::Report report = mir::validation::check_executor(executor);
        report.add("full pool", mir::validation::check_executor(short_of_help));
        require(report.passed(), report.text());
        std::cout << report.checks() << " checks of the executor passed\n";

        const mir::Scene scene = mir::builtin::make("cornell-box");
        require(is_cancelled(scene, executor), "a cancelled render went on");
        const Picture picture = render(scene, executor, nullptr);
        mir::InlineExecutor one;
        const Picture alone = render(scene, one, nullptr);
        std::size_t different = 0;
        for (std::size_t i = 0; i < alone.pixels().size(); ++i)
            different += picture.pixels()[i] == alone.pixels()[i] ? 0 : 1;
        require(different == 0, std::to_string(different) + " pixels depend on the threads");
        std::cout << "the same picture on " << executor.concurrency() << " threads and on one\n";
        if (argc > 1) mir::write_png(argv[1], picture);
    } catch (const std::exception& e) {
        std::cerr << "embed_threads: " << e.what() << '\n';
        return 1;
    }
}
