// SPDX-License-Identifier: MIT
//
// To be run by several ranks: they render together, disagree, and render together again.
#include "mir/mpi/rank_peers.hpp"
#include "mir/mpi/render_on_ranks.hpp"
#include "mir/render.hpp"
#include "mir/scenes.hpp"

#include <algorithm>
#include <cstdio>

namespace {

int rank_of_this() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

mir::RenderSettings small_picture() {
    mir::RenderSettings s;
    s.image = {40, 50};
    s.vpls = 16;
    s.threads = 1;
    s.backend = mir::BackendKind::cpu;
    return s;
}

bool is_right(const mir::Scene& scene) {
    const auto picture = mir::mpi::render_on_ranks(MPI_COMM_WORLD, scene, small_picture());
    if (!picture) return rank_of_this() != 0;
    const mir::RenderResult one = mir::render(scene, small_picture());
    return rank_of_this() == 0 && std::ranges::equal(picture->beauty.pixels(), one.beauty.pixels());
}

/// True when `work` throws an error whose words have `words` in them.
template <class Work>
bool fails(const Work& work, const char* words) {
    try {
        work();
    } catch (const mir::Error& e) {
        return std::string(e.what()).find(words) != std::string::npos;
    }
    return false;
}

int& failures() {
    static int count = 0;
    return count;
}

void require(bool ok, const char* what) {
    if (ok) return;
    std::fprintf(stderr, "rank %d: not so: %s\n", rank_of_this(), what);
    ++failures();
}

/// All ranks send to all others before any of them receives, more than MPI takes in by itself.
bool letters_cross() {
    mir::mpi::RankPeers ranks(MPI_COMM_WORLD);
    const mir::mpi::RankPeers::Bytes message(std::size_t{1} << 22, std::byte(ranks.rank()));
    for (std::uint32_t to = 0; to < ranks.count(); ++to)
        if (to != ranks.rank()) ranks.send(to, message);
    for (std::uint32_t come = 1; come < ranks.count();) {
        const auto letter = ranks.receive();
        if (!letter) continue;
        ++come;
        if (letter->bytes != mir::mpi::RankPeers::Bytes(message.size(), std::byte(letter->from)))
            return false;
    }
    return true;
}

void try_ranks() {
    require(letters_cross(), "letters that cross arrive");
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    require(is_right(scene), "rank 0 gets the picture");
    mir::Scene other = scene;
    if (rank_of_this() == 1) other.meshes.front().positions.front().x += 0.125f;
    require(fails([&] { static_cast<void>(is_right(other)); }, "it has another scene"),
            "a rank with another scene is an error of all");
    mir::RenderSettings bad = small_picture();
    if (rank_of_this() == 2) bad.scheduler = "nobody";
    require(fails([&] { static_cast<void>(mir::mpi::render_on_ranks(MPI_COMM_WORLD, scene, bad)); },
                  "nobody"),
            "a rank without a renderer is an error of all");
    require(is_right(scene), "ranks render again after errors");
}

}  // namespace

int main(int argc, char** argv) {
    require(fails([] { static_cast<void>(is_right(mir::Scene{})); }, "before MPI began"),
            "nothing is rendered before MPI has begun");
    int threads = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    try_ranks();
    MPI_Finalize();
    return failures() == 0 ? 0 : 1;
}
