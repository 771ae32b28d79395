// SPDX-License-Identifier: MIT
#pragma once

#include "luxel_order.hpp"
#include "machine.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/kernels/fused.hpp"
#include "mir/kernels/shading_pass.hpp"
#include "mir/kernels/visibility_pass.hpp"
#include "mir/kernels/word_shading.hpp"
#include "mir/shaft/device/backend_shafts.hpp"
#include "tracing_backend.hpp"

#include <algorithm>
#include <bit>
#include <optional>

namespace mirpaper {

/// The same answers by rays that start at the other end.
template <mir::Visibility V>
struct FromLuxel {
    static constexpr mir::Space space = V::space;

    V visibility;

    [[nodiscard]] MIR_HD bool visible(mir::Vec3 a, mir::Vec3 b) const {
        return visibility.visible(b, a);
    }
};

/// One luxel, one VPL, rays and shading; adds to what is there, but for the first VPL.
template <mir::GBuffer G, mir::VplSet P, mir::Visibility V, mir::Shading F>
struct AddOneVpl {
    G luxels;
    P vpls;
    mir::VplIndex vpl = 0;
    V visibility;
    F shade;
    mir::SoaView<mir::Rgb> radiance;

    MIR_HD void operator()(mir::LuxelIndex i) const {
        const mir::Hit hit = luxels.hit(i);
        mir::Rgb sum = vpl == 0 ? mir::Rgb{} : radiance.load(i);
        if (!mir::is_empty(hit))
            sum += mir::contribution(hit, luxels.surface(i), vpls[vpl], visibility, shade);
        radiance.store(i, sum);
    }
};
template <class G, class P, class V, class F>
AddOneVpl(G, P, mir::VplIndex, V, F, mir::SoaView<mir::Rgb>) -> AddOneVpl<G, P, V, F>;

/// Kernels on all luxels of a scene, which are in the backend's memory from the beginning.
template <mir::Backend B, mir::ShaftableVisibility V>
class KernelBench {
 public:
    /// `luxels` and `vpls` are copied. Rays are visibility.segments alone, shafts all of it.
    KernelBench(const B& backend, const LuxelWords& luxels, std::span<const mir::Vpl> vpls,
                const V& visibility, const Shading& shading, bool needs_bits)
        : backend_(backend),
          queue_(backend.queue()),
          count_(luxels.count),
          layout_(luxels.layout),
          hits_(backend.template buffer<std::uint32_t>(luxels.hits.size())),
          surfaces_(backend.template buffer<std::uint32_t>(luxels.surfaces.size())),
          radiance_(backend.template buffer<std::uint32_t>(radiance_words())),
          vpls_(backend.template buffer<mir::Vpl>(vpls.size())),
          bits_(backend.template buffer<std::uint32_t>(
              needs_bits ? Bits::count(count_, static_cast<std::uint32_t>(vpls.size())) : 0)),
          visibility_(visibility),
          shading_(shading) {
        queue_.upload(std::span<const std::uint32_t>(luxels.hits), hits_);
        queue_.upload(std::span<const std::uint32_t>(luxels.surfaces), surfaces_);
        queue_.upload(vpls, vpls_);
        queue_.record().sync();
    }

    KernelRun run(KernelVariant variant) {
        if (variant == KernelVariant::split) return run_split();
        if (variant == KernelVariant::shafts) return run_shafts();
        const auto begin = Marks<B>::mark(queue_);
        if (variant == KernelVariant::fused)
            queue_.for_each(
                count_, mir::FusedKernel{view(), vpls(), visibility_.segments, shading_, sums()});
        else
            for (mir::VplIndex j = 0; j < vpls().size(); ++j)
                queue_.for_each(
                    count_, AddOneVpl{view(), vpls(), j, visibility_.segments, shading_, sums()});
        const auto end = Marks<B>::mark(queue_);
        queue_.record().sync();
        KernelRun run;
        run.seconds = Marks<B>::seconds(begin, end);
        return run;
    }

    /// Bits of the last run that are not those of a ray per pair.
    [[nodiscard]] std::size_t wrong_bits() {
        std::vector<std::uint32_t> made(bits_.size());
        std::vector<std::uint32_t> truth(bits_.size());
        queue_.download(bits_, std::span<std::uint32_t>(made));
        queue_.fill_bits(count_, vpls().size(),
                         mir::VisibilityPass{view(), vpls(), visibility_.segments}, bits_.data());
        queue_.download(bits_, std::span<std::uint32_t>(truth));
        queue_.record().sync();
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < made.size(); ++i)
            wrong += static_cast<std::size_t>(std::popcount(made[i] ^ truth[i]));
        return wrong;
    }

    /// Summed luminance of what the last run left.
    [[nodiscard]] double total_luminance() {
        std::vector<std::uint32_t> words(radiance_words());
        queue_.download(radiance_, std::span<std::uint32_t>(words));
        queue_.record().sync();
        const mir::SoaView<const mir::Rgb> radiance{words.data(), count_};
        double total = 0.0;
        for (std::uint32_t i = 0; i < count_; ++i)
            total += static_cast<double>(mir::luminance(radiance.load(i)));
        return total;
    }

 private:
    using View = mir::GBufferView<B::space, Bsdf::Params>;
    using Bits = mir::VisibilityWords<B::space>;

    KernelRun run_split() {
        const auto begin = Marks<B>::mark(queue_);
        queue_.fill_bits(count_, vpls().size(),
                         mir::VisibilityPass{view(), vpls(), visibility_.segments}, bits_.data());
        const auto middle = Marks<B>::mark(queue_);
        queue_.for_each(count_, mir::ShadingPass{view(), vpls(), Bits{bits_.data(), vpls().size()},
                                                 shading_, sums()});
        const auto end = Marks<B>::mark(queue_);
        queue_.record().sync();
        KernelRun run;
        run.visibility = Marks<B>::seconds(begin, middle);
        run.shading = Marks<B>::seconds(middle, end);
        run.seconds = Marks<B>::seconds(begin, end);
        return run;
    }

    KernelRun run_shafts() {
        Trace<B> trace(Detail::all);
        const TracingBackend<B> traced(backend_, trace);
        if (!shafts_) shafts_.emplace(traced, count_, vpls().size());
        {
            auto queue = traced.queue();
            shafts_->fill(queue, view().hits, layout_, vpls(), visibility_, bits_.data());
            queue.for_each_group(count_ / 32,
                                 mir::WordShading{view(), vpls(), bits_.data(), shading_, sums()});
            queue.record().sync();
        }
        KernelRun run;
        run.stages = trace.stages();
        run.seconds = run.stages->span;
        return run;
    }

    [[nodiscard]] std::size_t radiance_words() const {
        return std::size_t{mir::SoaView<mir::Rgb>::words} * count_;
    }
    [[nodiscard]] View view() const { return {{hits_.data(), count_}, {surfaces_.data(), count_}}; }
    [[nodiscard]] mir::VplSpan<B::space> vpls() const {
        return {vpls_.data(), static_cast<std::uint32_t>(vpls_.size())};
    }
    [[nodiscard]] mir::SoaView<mir::Rgb> sums() { return {radiance_.data(), count_}; }

    B backend_;
    typename B::Queue queue_;
    std::uint32_t count_;
    std::optional<mir::BlockedLayout> layout_;
    typename B::template Buffer<std::uint32_t> hits_;
    typename B::template Buffer<std::uint32_t> surfaces_;
    typename B::template Buffer<std::uint32_t> radiance_;
    typename B::template Buffer<mir::Vpl> vpls_;
    typename B::template Buffer<std::uint32_t> bits_;
    V visibility_;
    Shading shading_;
    std::optional<mir::BackendShafts<TracingBackend<B>>> shafts_;
};

}  // namespace mirpaper
