// SPDX-License-Identifier: MIT
#include "command_line.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "mir/mpi/rank_peers.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/picture_team.hpp"
#include "process.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

/// Ranks of one machine take one GPU each. Open MPI and Slurm say which of them this one is.
void take_device(mirtool::RenderOptions& o) {
    mir::DeviceChoice& devices = o.settings.devices;
    if (devices.all || !devices.numbers.empty() || o.settings.backend == mir::BackendKind::cpu)
        return;
    std::uint32_t gpus = 0;
    for (const mir::DeviceReport& device : mir::list_devices().devices)
        gpus += device.name.starts_with("cuda:") ? 1 : 0;
    for (const char* name : {"OMPI_COMM_WORLD_LOCAL_RANK", "SLURM_LOCALID"})
        if (const char* rank = std::getenv(name); rank != nullptr && gpus > 0) {
            devices.numbers = {static_cast<std::uint32_t>(std::strtoul(rank, nullptr, 10)) % gpus};
            return;
        }
}

int run_command(int argc, char** argv, mir::PictureTeam& team) {
    const mirtool::Parsed parsed = mirtool::parse(argc, argv);
    if (const int* code = std::get_if<int>(&parsed)) return *code;
    const auto* options = std::get_if<mirtool::RenderOptions>(&std::get<mirtool::Command>(parsed));
    mir::expects(
        options != nullptr,
        "ranks of MPI only render (nothing else is shared out); use mir for other commands");
    mirtool::RenderOptions o = *options;
    take_device(o);
    return mirtool::run_in_team(o, team);
}

/// Runs the command; the team hears of failures.
int run_with(mir::PictureTeam& team, int argc, char** argv) {
    try {
        return run_command(argc, argv, team);
    } catch (const mir::Error& e) {
        team.fail(e);
        mirtool::say_failure(e.what());
        return mirtool::exit_code_of(e.code());
    } catch (const std::exception& e) {
        const std::string sentence = mirtool::sentence_of(e);
        team.fail(mir::Error(mir::ErrorCode::internal, sentence));
        mirtool::say_failure(sentence);
        return mirtool::exit_failure;
    }
}

/// What other ranks have to say comes from rank 0.
void be_silent() {
    for (std::FILE* stream : {stdout, stderr})
        if (std::freopen("/dev/null", "w", stream) == nullptr) return;
}

int render_on_all_ranks(int argc, char** argv) {
    mir::mpi::RankPeers peers(MPI_COMM_WORLD);
    if (peers.rank() != 0) be_silent();
    mir::PictureTeam team(peers);
    const int code = run_with(team, argc, argv);
    return team.is_lead() ? code : mirtool::exit_done;
}

}  // namespace

int main(int argc, char** argv) {
    mirtool::prepare_process();
    int threads = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    int code = mirtool::exit_failure;
    try {
        code = render_on_all_ranks(argc, argv);
    } catch (const std::exception& e) {
        mirtool::say_failure(mirtool::sentence_of(e));
    }
    MPI_Finalize();
    return mirtool::end_results(code);
}
