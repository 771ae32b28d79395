// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/micro/check_gather.hpp"
#include "mir/micro/gather_light.hpp"
#include "mir/micro/gather_pass.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/resident/backend_layer.hpp"
#include "mir/resident/uploaded_trees.hpp"
#include "mir/resident/wait_at_end.hpp"

namespace mir {

/// gather_light() on a backend. The tree stays there, luxels and light go up, radiance comes home.
/// Bits are those of gather_light() where host and device round alike. One thread at a time.
template <Backend B, Bsdf F>
class BackendGather {
 public:
    /// G-buffers that it takes, on the host.
    using Luxels = BlockedGBuffer<typename F::Params>;

    /// Copies the tree.
    /// @throws What the backend throws when it has no memory left.
    BackendGather(const B& backend, const SurfelTree& tree)
        : backend_(backend), queue_(backend.queue()), tree_(backend, queue_, tree) {
        queue_.record().sync();
    }

    /// `radiance` is that of the tree's nodes. After every portion of n luxels, some milliseconds
    /// of a GPU, it calls done(n), which may throw.
    /// @throws Error(invalid_argument) on options out of range, and what done() throws.
    template <class Done = decltype(no_progress)>
    [[nodiscard]] Image<Rgb> operator()(const Luxels& luxels,
                                        std::span<const SurfelRadiance> radiance,
                                        const GatherOptions& options, const LuxelBand& band,
                                        const Done& done = no_progress) {
        check(options);
        return gather(luxels, radiance, band, done, [&](const auto& tile, auto light) {
            const RayGather<B::space, F> by_rays{tree_.view(), light, options};
            return [this, pass = GatherPass{tile, by_rays, 0}](LuxelIndex first,
                                                               std::uint32_t n) mutable {
                pass.first = first;
                queue_.for_each(n, pass);
            };
        });
    }
    /// The same by micro-buffers, as gather_light() does with these options.
    template <class Done = decltype(no_progress)>
    [[nodiscard]] Image<Rgb> operator()(const Luxels& luxels,
                                        std::span<const SurfelRadiance> radiance,
                                        const BufferGatherOptions& options, const LuxelBand& band,
                                        const Done& done = no_progress) {
        check(options);
        return with_buffer_side(options.side, [&](auto side) {
            return gather(luxels, radiance, band, done, [&](const auto& tile, auto light) {
                const BufferGather<B::space, F, side.value> by_buffers{tree_.view(), light,
                                                                       options};
                return [this, pass = BufferGatherPass{tile, by_buffers, 0}](
                           LuxelIndex first, std::uint32_t n) mutable {
                    pass.first = first;
                    queue_.for_each_group(n / pass.luxels, pass);
                };
            });
        });
    }

 private:
    /// Luxels between two looks at whether to go on: whole blocks.
    static constexpr std::uint32_t portion = 256 * BlockedLayout::block_size;

    /// make(GatherTile, radiance) gives what starts the work of a run of luxels of the tile.
    template <class Done, class Make>
    Image<Rgb> gather(const Luxels& luxels, std::span<const SurfelRadiance> radiance,
                      const LuxelBand& band, const Done& done, const Make& make) {
        const Tile& first = luxels.tiles().front();
        BackendGBuffer<B, typename F::Params> there(backend_, luxels.extent(),
                                                    {first.width, first.height});
        BackendLayer<B> layer(backend_, there.grid());
        std::vector<std::uint32_t> words(layer.words().size());
        UploadedArray<B, SurfelRadiance> light(backend_, queue_, radiance);
        const WaitAtEnd wait(queue_);
        there.upload(queue_, luxels);
        for (TileIndex t = 0; t < there.tiles().size(); ++t) {
            const auto view = there.view(t);
            auto start =
                make(GatherTile{view, there.tiles()[t], band, layer.tile(t)}, light.data());
            for (LuxelIndex i = 0; i < view.size(); i += portion) {
                const std::uint32_t n = std::min(portion, view.size() - i);
                start(i, n);
                queue_.record().sync();
                done(luxels_of_run(there.tiles()[t], i, n));
            }
        }
        queue_.download(layer.words(), std::span(words));
        queue_.record().sync();
        return image_of({words.data(), layer.grid()});
    }

    /// Luxels of a run of whole blocks, without the padding.
    [[nodiscard]] static std::uint64_t luxels_of_run(const Tile& tile, LuxelIndex first,
                                                     std::uint32_t count) {
        const auto layout = BlockedLayout::of(tile);
        std::uint64_t sum = 0;
        for (LuxelIndex i = first; i < first + count; i += BlockedLayout::block_size) {
            const Tile area = layout.block_area(tile, i / BlockedLayout::block_size);
            sum += std::uint64_t{area.width} * area.height;
        }
        return sum;
    }

    [[nodiscard]] static Image<Rgb> image_of(const LayerView& layer) {
        Image<Rgb> image(layer.grid.image);
        for (std::uint32_t y = 0; y < image.height(); ++y)
            for (std::uint32_t x = 0; x < image.width(); ++x) image(x, y) = layer(x, y);
        return image;
    }

    B backend_;
    typename B::Queue queue_;
    UploadedSurfelTree<B> tree_;
};

}  // namespace mir
