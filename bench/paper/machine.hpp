// SPDX-License-Identifier: MIT
#pragma once

#include "kernel_choice.hpp"
#include "mir/data/image.hpp"
#include "paper_scene.hpp"
#include "timeline.hpp"

#include <memory>

namespace mirpaper {

/// The paper's algorithms that need a backend.
enum class Algorithm { os, rc, rcvp };

/// One image to make.
struct Job {
    Algorithm algorithm = Algorithm::rc;
    mir::Extent tile{256, 256};
    std::uint32_t vpls = 256;
    bool resident = false;  ///< luxels were traced there before the clock starts
};

/// One image made.
struct Run {
    double seconds = 0.0;  ///< from the first upload to the last luxel at home, by events
    double wall = 0.0;     ///< of the whole call, allocations and the image on the host included
    StageSeconds stages;   ///< of traced runs
    double mean_luminance = 0.0;
};

/// All luxels brought to a backend's memory, in seconds.
struct LuxelRun {
    double uploaded = 0.0;  ///< copied from the host
    double traced = 0.0;    ///< found there
};

/// A backend that images can be made on, whatever it is made of. Not thread-safe.
class Machine {
 public:
    Machine() = default;
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;
    virtual ~Machine() = default;

    [[nodiscard]] virtual std::string backend() const = 0;  ///< as in --backend
    [[nodiscard]] virtual std::string device() const = 0;   ///< what it is, for the report
    /// True when luxels can stay in its memory, apart from the host's.
    [[nodiscard]] virtual bool has_own_memory() const = 0;

    /// Takes in a scene, which must outlive its use. What follows is about this one.
    virtual void enter(PaperScene& scene) = 0;

    /// Makes the image once to warm up if `warm`, then `repeat` times.
    virtual std::vector<Run> run(const Job& job, unsigned repeat, bool warm) = 0;

    /// The same once, with a note of every operation of its queues.
    virtual Run trace(const Job& job) = 0;

    /// Kernels alone on all luxels at once, everything in the backend's memory; warmed up once.
    virtual std::vector<KernelRun> kernels(const KernelChoice& choice, unsigned repeat) = 0;

    /// Brings the luxels there in both ways; warmed up once.
    virtual std::vector<LuxelRun> luxels(mir::Extent tile, unsigned repeat) = 0;
};

/// The host as a backend.
std::unique_ptr<Machine> make_host_machine(Executor& executor);

/// The first GPU, or nothing when this build has no CUDA.
/// @throws Error(no_device) when there is none.
std::unique_ptr<Machine> make_cuda_machine(Executor& executor);

/// The paper's "CPU", without a backend: the plain loop of sched::Cpu, or sched::CpuBlocks.
Run run_plain_loop(PaperScene& scene, std::uint32_t vpls, Executor& executor);
Run run_blocks(PaperScene& scene, mir::Extent tile, std::uint32_t vpls, Executor& executor);

/// run_blocks() with Embree's rays, where this build has Embree: else nothing.
std::vector<Run> run_embree(PaperScene& scene, mir::Extent tile, std::uint32_t vpls,
                            unsigned repeat, Executor& executor);

/// Mean over all luxels: what tells that two algorithms made the same image.
double mean_luminance(const mir::Image<mir::Rgb>& image);

}  // namespace mirpaper
