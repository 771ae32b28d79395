// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/gbuffer.hpp"
#include "mir/data/image.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/micro/buffer_gather.hpp"
#include "mir/micro/ray_gather.hpp"
#include "mir/shading/lambert.hpp"

#include <memory>
#include <string>

// What the suite starts on a GPU: declared for files of the C++ compiler, defined in
// cuda_gathers.cu, or in without_cuda.cpp where there is no nvcc.

namespace mirbench {

/// Suites of micro-rendering shade the Lambertian model, which discs are taken for.
using MicroLuxels = mir::BlockedGBuffer<mir::Lambert::Params>;

/// A picture's luxels and the discs that light them. A view.
struct GatherInput {
    const MicroLuxels& luxels;  ///< of one tile
    const mir::SurfelTree& tree;
    std::span<const mir::SurfelRadiance> radiance;
    mir::LuxelBand band;
};

/// A GatherInput in the memory of a GPU.
class GpuGathers {
 public:
    virtual ~GpuGathers() = default;

    /// Gathers at every luxel; seconds by the GPU's clock.
    virtual double by_rays(const mir::GatherOptions& options) = 0;
    virtual double by_buffers(const mir::BufferGatherOptions& options) = 0;
    /// What the last gather found.
    [[nodiscard]] virtual mir::Image<mir::Rgb> image() = 0;
};

/// True where the program was built with CUDA.
bool has_cuda();

/// Copies what `input` views to a GPU.
/// @throws Error(no_device) where there is none.
std::unique_ptr<GpuGathers> make_gpu_gathers(const GatherInput& input);

}  // namespace mirbench
