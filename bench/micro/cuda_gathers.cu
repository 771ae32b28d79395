// SPDX-License-Identifier: MIT
#include "gpu_gathers.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/micro/gather_pass.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/resident/backend_layer.hpp"
#include "mir/resident/uploaded_trees.hpp"

namespace mirbench {
namespace {

using mir::Lambert;
using B = mir::cuda::Backend;

class CudaGathers final : public GpuGathers {
 public:
    CudaGathers(const mir::cuda::Device& device, const GatherInput& in)
        : backend_(device),
          queue_(backend_.queue()),
          tree_(backend_, queue_, in.tree),
          radiance_(backend_, queue_, in.radiance),
          luxels_(backend_, in.luxels.extent(), in.luxels.extent()),
          band_(in.band),
          layer_(backend_, luxels_.grid()) {
        luxels_.upload(queue_, in.luxels);
        queue_.record().sync();
    }

    double by_rays(const mir::GatherOptions& options) override {
        const mir::RayGather<B::space, Lambert> gather{tree_.view(), radiance_.data(), options};
        return seconds_of([&](const auto& tile, std::uint32_t luxels) {
            queue_.for_each(luxels, mir::GatherPass{tile, gather, 0});
        });
    }
    double by_buffers(const mir::BufferGatherOptions& options) override {
        return mir::with_buffer_side(options.side, [&](auto side) {
            const mir::BufferGather<B::space, Lambert, side.value> gather{
                tree_.view(), radiance_.data(), options};
            return seconds_of([&](const auto& tile, std::uint32_t luxels) {
                const mir::BufferGatherPass pass{tile, gather, 0};
                queue_.for_each_group(luxels / pass.luxels, pass);
            });
        });
    }

    [[nodiscard]] mir::Image<mir::Rgb> image() override {
        std::vector<std::uint32_t> words(layer_.words().size());
        queue_.download(layer_.words(), std::span(words));
        queue_.record().sync();
        const mir::LayerView here{words.data(), layer_.grid()};
        mir::Image<mir::Rgb> image(luxels_.extent());
        for (std::uint32_t y = 0; y < image.height(); ++y)
            for (std::uint32_t x = 0; x < image.width(); ++x) image(x, y) = here(x, y);
        return image;
    }

 private:
    template <class Start>
    double seconds_of(const Start& start) {
        const auto view = luxels_.view(0);
        const mir::cuda::Event begin = queue_.record();
        start(mir::GatherTile{view, luxels_.tiles()[0], band_, layer_.tile(0)}, view.size());
        return seconds_between(begin, queue_.record());
    }

    B backend_;
    B::Queue queue_;
    mir::UploadedSurfelTree<B> tree_;
    mir::UploadedArray<B, mir::SurfelRadiance> radiance_;
    mir::BackendGBuffer<B, Lambert::Params> luxels_;
    mir::LuxelBand band_;
    mir::BackendLayer<B> layer_;
};

}  // namespace

bool has_cuda() { return true; }

std::unique_ptr<GpuGathers> make_gpu_gathers(const GatherInput& input) {
    return std::make_unique<CudaGathers>(mir::cuda::select_device(), input);
}

}  // namespace mirbench
