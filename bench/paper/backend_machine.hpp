// SPDX-License-Identifier: MIT
#pragma once

#include "backend_memory.hpp"
#include "kernel_bench.hpp"
#include "machine.hpp"
#include "mir/core/random.hpp"
#include "mir/core/stopwatch.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "mir/sched/shading_only.hpp"

#include <optional>

namespace mirpaper {

/// A Machine of any Backend. `Alloc` hands out the host memory from which its copies are fastest.
template <mir::Backend B, class Alloc>
class BackendMachine final : public Machine {
 public:
    BackendMachine(const B& backend, const Alloc& alloc, std::string name, std::string device,
                   Executor& executor)
        : backend_(backend),
          alloc_(alloc),
          name_(std::move(name)),
          device_(std::move(device)),
          executor_(executor) {}

    [[nodiscard]] std::string backend() const override { return name_; }
    [[nodiscard]] std::string device() const override { return device_; }
    [[nodiscard]] bool has_own_memory() const override { return B::space == mir::Space::device; }

    void enter(PaperScene& scene) override {
        uploaded_.reset();
        resident_.reset();
        there_.reset();
        scene_ = &scene;
        there_.emplace(backend_, scene);
    }

    std::vector<Run> run(const Job& job, unsigned repeat, bool warm) override {
        if (warm) make_image(job, Detail::ends);
        std::vector<Run> runs;
        for (unsigned i = 0; i < repeat; ++i) runs.push_back(make_image(job, Detail::ends));
        return runs;
    }

    Run trace(const Job& job) override { return make_image(job, Detail::all); }

    std::vector<KernelRun> kernels(const KernelChoice& choice, unsigned repeat) override {
        if (choice.start == RayStart::luxel)
            return kernels_with(choice, there_->with_shafts(FromLuxel<Rays>{there_->visibility()}),
                                repeat);
        if (choice.engine == RayEngine::wide_bvh)
            return kernels_with(choice, there_->with_shafts(there_->wide_visibility()), repeat);
        return kernels_with(choice, there_->with_shafts(there_->visibility()), repeat);
    }

    std::vector<LuxelRun> luxels(mir::Extent tile, unsigned repeat) override {
        const Uploaded& from = luxels_to_upload(tile);
        Resident to(backend_, from.extent(), tile);
        auto queue = backend_.queue();
        fill(queue, from, to);
        std::vector<LuxelRun> runs;
        for (unsigned i = 0; i < repeat; ++i) runs.push_back(fill(queue, from, to));
        return runs;
    }

 private:
    using Rays = mir::KdTreeVisibility<B::space>;
    using Uploaded = mir::BlockedGBuffer<Bsdf::Params, Alloc>;
    using Resident = mir::BackendGBuffer<B, Bsdf::Params>;

    [[nodiscard]] const Uploaded& luxels_to_upload(mir::Extent tile) {
        if (uploaded_ && uploaded_tile_ == tile) return *uploaded_;
        uploaded_.reset();
        uploaded_.emplace(retiled(scene_->luxels(), tile, executor_, alloc_));
        uploaded_tile_ = tile;
        return *uploaded_;
    }
    [[nodiscard]] const Resident& resident_luxels(mir::Extent tile) {
        if (resident_ && resident_tile_ == tile) return *resident_;
        resident_.reset();
        resident_.emplace(backend_, scene_->luxels().extent(), tile);
        resident_tile_ = tile;
        auto queue = backend_.queue();
        there_->trace(queue, *resident_);
        queue.record().sync();
        return *resident_;
    }

    LuxelRun fill(typename B::Queue& queue, const Uploaded& from, Resident& to) const {
        const auto begin = Marks<B>::mark(queue);
        to.upload(queue, from);
        const auto middle = Marks<B>::mark(queue);
        there_->trace(queue, to);
        const auto end = Marks<B>::mark(queue);
        queue.record().sync();
        return {Marks<B>::seconds(begin, middle), Marks<B>::seconds(middle, end)};
    }

    Run make_image(const Job& job, Detail detail) {
        if (job.resident) return schedule(job, resident_luxels(job.tile), detail);
        return schedule(job, luxels_to_upload(job.tile), detail);
    }

    template <class G>
    Run schedule(const Job& job, const G& luxels, Detail detail) {
        namespace sched = mir::sched;
        Trace<B> trace(detail);
        const TracingBackend<B> traced(backend_, trace);
        if constexpr (mir::PackedGBuffer<G>)
            if (job.algorithm == Algorithm::os)
                return timed(job, luxels, sched::ShadingOnly{traced, executor_},
                             scene_->visibility(), trace);
        if (job.algorithm == Algorithm::rc)
            return timed(job, luxels, sched::Reconstruct{traced}, there_->visibility(), trace);
        return timed(job, luxels, sched::ReconstructVisibilityParallel{traced},
                     there_->visibility(), trace);
    }

    template <class G, class S, class V>
    Run timed(const Job& job, const G& luxels, const S& scheduler, const V& visibility,
              const Trace<B>& trace) {
        const mir::VplList& vpls = scene_->vpls(job.vpls);
        const Shading shading = scene_->shading(job.vpls);
        Run run;
        mir::Image<mir::Rgb> image;
        {
            const mir::Stopwatch watch(run.wall);
            image = mir::reconstruct(scheduler, luxels, vpls.span(), visibility, shading);
        }
        run.seconds = trace.seconds();
        run.stages = trace.stages();
        run.mean_luminance = mean_luminance(image);
        return run;
    }

    [[nodiscard]] static bool needs_bits(KernelVariant variant) {
        return variant == KernelVariant::split || variant == KernelVariant::shafts;
    }

    [[nodiscard]] std::vector<mir::Vpl> vpls_in(VplOrder order, std::uint32_t count) {
        const auto sorted = scene_->vpls(count).vpls();
        std::vector<mir::Vpl> vpls(sorted.begin(), sorted.end());
        if (order == VplOrder::morton) return vpls;
        mir::Random random(1, mir::Stream::test, 0);
        for (std::size_t i = vpls.size(); i > 1; --i)
            std::swap(vpls[i - 1],
                      vpls[static_cast<std::size_t>(random.next() * static_cast<float>(i))]);
        return vpls;
    }

    template <class V>
    std::vector<KernelRun> kernels_with(const KernelChoice& choice, const V& visibility,
                                        unsigned repeat) {
        const std::vector<mir::Vpl> vpls = vpls_in(choice.vpl_order, choice.vpls);
        KernelBench<B, V> bench(backend_, luxels_in(choice.luxels, scene_->luxels(), executor_),
                                vpls, visibility, scene_->shading(choice.vpls),
                                needs_bits(choice.variant));
        bench.run(choice.variant);
        // Asked once: the bits that it compares with stay in place of the run's.
        const std::size_t wrong = choice.variant == KernelVariant::shafts ? bench.wrong_bits() : 0;
        if (wrong != 0)
            throw mir::Error(mir::ErrorCode::internal, "shafts changed " + std::to_string(wrong) +
                                                           " bits in the scene '" + scene_->name() +
                                                           "'");
        std::vector<KernelRun> runs;
        for (unsigned i = 0; i < repeat; ++i) runs.push_back(bench.run(choice.variant));
        const double mean =
            bench.total_luminance() / static_cast<double>(scene_->luxels().extent().area());
        for (KernelRun& run : runs) run.mean_luminance = mean;
        return runs;
    }

    B backend_;
    Alloc alloc_;
    std::string name_;
    std::string device_;
    Executor& executor_;
    PaperScene* scene_ = nullptr;
    std::optional<SceneOnBackend<B>> there_;
    std::optional<Uploaded> uploaded_;
    std::optional<Resident> resident_;
    mir::Extent uploaded_tile_;
    mir::Extent resident_tile_;
};

}  // namespace mirpaper
