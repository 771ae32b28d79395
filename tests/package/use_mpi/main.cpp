// SPDX-License-Identifier: MIT
#include <mir/mpi/render_on_ranks.hpp>
#include <mir/render.hpp>
#include <mir/scenes.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace {

void render_together() {
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    mir::RenderSettings settings;
    settings.image = {24, 40};
    settings.vpls = 16;
    settings.threads = 1;
    settings.backend = mir::BackendKind::cpu;
    const std::optional<mir::RenderResult> picture =
        mir::mpi::render_on_ranks(MPI_COMM_WORLD, scene, settings);
    if (!picture) return;
    int ranks = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const mir::RenderResult one = mir::render(scene, settings);
    const bool same = std::ranges::equal(picture->beauty.pixels(), one.beauty.pixels());
    std::printf("%d ranks, %s picture\n", ranks, same ? "the same" : "another");
}

}  // namespace

int main(int argc, char** argv) {
    int threads = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    render_together();
    MPI_Finalize();
}
