// SPDX-License-Identifier: MIT
#include "cuda/segments/gpu_segment_bits.hpp"
#include "mir/accel/kd/kd_rays.hpp"
#include "mir/accel/wide/wide_rays.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/resident/uploaded_trees.hpp"
#include "support/fused_visibility.hpp"
#include "support/segment_bits.hpp"
#include "support/uploaded_wide_bvh.hpp"

namespace mirtest {

std::vector<std::uint32_t> gpu_segment_bits(const mir::cuda::Backend& backend,
                                            const mir::KdTree& tree,
                                            std::span<const SegmentEnds> segments,
                                            Rounding rounding) {
    auto queue = backend.queue();
    const mir::UploadedKdTree<mir::cuda::Backend> there(backend, queue, tree);
    queue.record().sync();
    if (rounding == Rounding::fused)
        return segment_bits(backend, FusedVisibility<mir::Space::device>{there.view()}, segments);
    return segment_bits(backend, mir::KdTreeVisibility<mir::Space::device>{there.view()}, segments);
}

std::vector<std::uint32_t> gpu_segment_bits(const mir::cuda::Backend& backend,
                                            const mir::WideBvh& bvh,
                                            std::span<const SegmentEnds> segments) {
    auto queue = backend.queue();
    const UploadedWideBvh<mir::cuda::Backend> there(backend, queue, bvh);
    queue.record().sync();
    return segment_bits(backend, mir::WideBvhVisibility<mir::Space::device>{there.view()},
                        segments);
}

}  // namespace mirtest
