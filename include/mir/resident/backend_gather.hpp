// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/kernels/gather_pass.hpp"
#include "mir/micro/buffer_gather.hpp"
#include "mir/micro/ray_gather.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/resident/backend_layer.hpp"
#include "mir/resident/uploaded_surfel_tree.hpp"
#include "mir/resident/wait_at_end.hpp"

namespace mir {

/// gather_light() on a backend: the tree stays there, luxels and light go up, radiance comes home.
/// Bits are those of gather_light() where host and device round alike. One thread at a time.
template <Backend B, Bsdf F>
class BackendGather {
 public:
    using Luxels = BlockedGBuffer<typename F::Params>;

    /// Copies the tree.
    /// @throws What the backend throws when it has no memory left.
    BackendGather(const B& backend, const SurfelTree& tree)
        : backend_(backend), queue_(backend.queue()), tree_(backend, queue_, tree) {
        queue_.record().sync();
    }

    /// `radiance` is that of the tree's nodes.
    /// @throws Error(invalid_argument) on options out of range.
    [[nodiscard]] Image<Rgb> operator()(const Luxels& luxels,
                                        std::span<const SurfelRadiance> radiance,
                                        const GatherOptions& options, const LuxelBand& band) {
        return gather<RayGather<B::space, F>>(luxels, radiance, options, band);
    }
    [[nodiscard]] Image<Rgb> operator()(const Luxels& luxels,
                                        std::span<const SurfelRadiance> radiance,
                                        const BufferGatherOptions& options, const LuxelBand& band) {
        return gather<BufferGather<B::space, F>>(luxels, radiance, options, band);
    }

 private:
    template <class Gather, class Options>
    Image<Rgb> gather(const Luxels& luxels, std::span<const SurfelRadiance> radiance,
                      const Options& options, const LuxelBand& band) {
        check(options);
        const Tile& first = luxels.tiles().front();
        BackendGBuffer<B, typename F::Params> there(backend_, luxels.extent(),
                                                    {first.width, first.height});
        BackendLayer<B> layer(backend_, there.grid());
        std::vector<std::uint32_t> words(layer.words().size());
        UploadedArray<B, SurfelRadiance> light(backend_, queue_, radiance);
        const WaitAtEnd wait(queue_);
        there.upload(queue_, luxels);
        const Gather at{tree_.view(), light.data(), options};
        for (TileIndex t = 0; t < there.tiles().size(); ++t) {
            const auto view = there.view(t);
            queue_.for_each(view.size(),
                            GatherPass{view, there.tiles()[t], at, band, layer.tile(t)});
        }
        queue_.download(layer.words(), std::span(words));
        queue_.record().sync();
        return image_of({words.data(), layer.grid()});
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
