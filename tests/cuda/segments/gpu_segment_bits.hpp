// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_tree.hpp"
#include "mir/accel/wide/wide_bvh.hpp"
#include "mir/cuda/backend.hpp"
#include "support/segment_ends.hpp"

#include <span>
#include <vector>

// What the tests start on the GPU: declared for files with assertions, defined in
// gpu_segment_bits.cu.

namespace mirtest {

/// How a GPU tests triangles; `fused` is the mistake that the comparison has to notice.
enum class Rounding { strict, fused };

/// segment_bits() of a kd-tree that was copied to the GPU.
std::vector<std::uint32_t> gpu_segment_bits(const mir::cuda::Backend& backend,
                                            const mir::KdTree& tree,
                                            std::span<const SegmentEnds> segments,
                                            Rounding rounding = Rounding::strict);

/// The same of a wide hierarchy.
std::vector<std::uint32_t> gpu_segment_bits(const mir::cuda::Backend& backend,
                                            const mir::WideBvh& bvh,
                                            std::span<const SegmentEnds> segments);

}  // namespace mirtest
