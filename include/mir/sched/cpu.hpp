// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/block_list.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/core/monitor.hpp"
#include "mir/reconstruct.hpp"
#include "mir/shading/contribution.hpp"

#include <algorithm>

namespace mir::sched {

/// The oracle: algorithm 3 of the paper, a plain loop over luxels and VPLs. It shares only the
/// parts of contribution() with faster schedulers, so that it does not repeat their mistakes. Given
/// a KnownVisibility it traces no ray.
template <Executor E>
struct Cpu {
    E& executor;                 ///< runs blocks of luxels
    Monitor* monitor = nullptr;  ///< may be null

    /// Model of mir::Pipeline for one image; what it is given must outlive it.
    template <class In>
    class Pipeline {
     public:
        /// Reads `in` and writes the radiance of luxels, W m^-2 sr^-1, to `image`. `monitor` may be
        /// null.
        Pipeline(const In& in, Image<Rgb>& image, E& executor, Monitor* monitor)
            : in_(in), image_(image), executor_(executor), monitor_(monitor) {}

        /// Only notes the tile.
        void submit(TileIndex t) { blocks::append_blocks(blocks_, t, in_.gbuffer.tiles()[t]); }

        /// Computes all tiles that were submitted, block by block on the executor.
        /// @throws Error(cancelled) when the monitor asks to stop.
        void finish() {
            executor_.for_each(blocks_.size(), [this](std::size_t i) { run(blocks_[i]); });
        }

     private:
        void run(blocks::Block b) const {
            const Tile tile = in_.gbuffer.tiles()[b.tile];
            const auto layout = BlockedLayout::of(tile);
            const Tile area = layout.block_area(tile, b.block);
            const auto luxels = in_.gbuffer.view(b.tile);
            if (monitor_ != nullptr) monitor_->check();
            for (std::uint32_t y = area.y; y < area.y + area.height; ++y)
                for (std::uint32_t x = area.x; x < area.x + area.width; ++x)
                    image_(tile.x + x, tile.y + y) = gather(b.tile, luxels, layout(x, y));
            if (monitor_ != nullptr)
                monitor_->contributions +=
                    std::uint64_t{area.width} * area.height * in_.vpls.size();
        }

        [[nodiscard]] Rgb gather(TileIndex t, const auto& luxels, LuxelIndex i) const {
            const Hit hit = luxels.hit(i);
            if (is_empty(hit)) return {};
            const auto surface = luxels.surface(i);
            Rgb sum;
            if constexpr (KnownVisibility<decltype(In::visibility)>)
                run_with(best_instruction_set(), [&] {
                    for (VplIndex j = 0; j < in_.vpls.size(); ++j)
                        if (in_.visibility.sees(t, i, j))
                            sum += in_.shading(hit, surface, in_.vpls[j]);
                });
            else
                for (VplIndex j = 0; j < in_.vpls.size(); j += portion)
                    sum = gather(hit, surface, j, std::min(in_.vpls.size() - j, portion), sum);
            return sum;
        }

        /// `sum` and the contributions of some VPLs. Shading has the processor's instructions: with
        /// those that every x86-64 has it takes thirty times as long.
        [[nodiscard]] Rgb gather(const Hit& hit, const auto& surface, VplIndex first,
                                 VplIndex count, Rgb sum) const {
            Rgb shaded[portion];
            run_with(best_instruction_set(), [&] {
                for (VplIndex k = 0; k < count; ++k)
                    shaded[k] = unshadowed(hit, surface, in_.vpls[first + k], in_.shading);
            });
            for (VplIndex k = 0; k < count; ++k) {
                if (is_black(shaded[k])) continue;
                const Vpl vpl = in_.vpls[first + k];
                if (in_.visibility.visible(vpl.position, hit.position)) sum += shaded[k];
            }
            return sum;
        }

        static constexpr VplIndex portion = 64;

        const In& in_;
        Image<Rgb>& image_;
        E& executor_;
        Monitor* monitor_;
        std::vector<blocks::Block> blocks_;
    };

    /// A pipeline for one image, whose size is that of the G-buffer.
    template <class In>
    Pipeline<In> open(const In& in, Image<Rgb>& image) const {
        static_assert(AccessibleFrom<decltype(in.visibility), Space::host>,
                      "mir: sched::Cpu needs a Visibility that lives in host memory");
        return {in, image, executor, monitor};
    }
};
template <Executor E>
Cpu(E&) -> Cpu<E>;
template <Executor E>
Cpu(E&, Monitor*) -> Cpu<E>;

}  // namespace mir::sched
