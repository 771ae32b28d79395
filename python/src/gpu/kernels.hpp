// SPDX-License-Identifier: MIT
#pragma once

#include "luxel_arrays.hpp"
#include "mir/accel/kd/kd_tree_view.hpp"
#include "mir/core/space.hpp"
#include "mir/cuda/queue.hpp"
#include "mir/data/tile.hpp"
#include "mir/data/vpl.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mirpy::gpu {

/// The luxels of G-buffer arrays of a GPU, row by row. Model of mir::GBuffer.
struct Luxels {
    static constexpr mir::Space space = mir::Space::device;
    using Surface = LuxelArrays::Surface;

    LuxelArrays arrays;
    std::uint32_t width = 0;
    std::uint32_t count = 0;  ///< width times height

    [[nodiscard]] MIR_HD std::uint32_t size() const { return count; }
    [[nodiscard]] MIR_HD mir::Hit hit(mir::LuxelIndex i) const {
        return arrays.hit(i / width, i % width);
    }
    [[nodiscard]] MIR_HD Surface surface(mir::LuxelIndex i) const {
        return arrays.surface(i / width, i % width);
    }
};

/// VPLs in arrays of a GPU. Model of mir::VplSet.
struct VplArrays {
    static constexpr mir::Space space = mir::Space::device;

    StridedFloats positions;    ///< (n, 3), metres
    StridedFloats normals;      ///< (n, 3), unit
    StridedFloats intensities;  ///< (n, 3), W sr^-1
    std::uint32_t count = 0;

    [[nodiscard]] MIR_HD std::uint32_t size() const { return count; }
    [[nodiscard]] MIR_HD mir::Vpl operator[](mir::VplIndex j) const {
        const mir::Vec3 light = intensities.row(j);
        return {positions.row(j), normals.row(j), {light.x, light.y, light.z}};
    }
};

/// Segments from points of surfaces to targets, in arrays of a GPU.
struct SegmentArrays {
    StridedFloats points;          ///< (n, 3), metres
    StridedFloats normals;         ///< (n, 3), unit
    StridedFloats targets;         ///< (m, 3), metres
    StridedFloats target_normals;  ///< (m, 3), or none: targets are seen from everywhere
    std::size_t point_count = 0;
    std::uint32_t target_count = 0;
    float ray_offset = 0.0f;  ///< metres
};

/// Bits of visibility in memory of a GPU: a row of bytes for each luxel, the lowest bit first.
struct ByteRows {
    const std::uint8_t* bytes = nullptr;
    std::size_t row_bytes = 0;

    [[nodiscard]] MIR_HD bool sees(mir::LuxelIndex i, mir::VplIndex j) const {
        return (bytes[i * row_bytes + j / 8] >> (j % 8) & 1u) != 0;
    }
};

using Tree = mir::KdTreeView<mir::Space::device>;
using Queue = mir::cuda::Queue;

/// Starts to set *mark to 1 if an element is NaN or infinite.
void mark_not_finite(Queue& queue, const StridedFloats& array,
                     const std::array<std::size_t, 3>& sizes, std::uint32_t* mark);
/// Starts to fill rows of bytes of who sees whom; no mask cuts triangles of the tree.
void find_visible(Queue& queue, const SegmentArrays& segments, const Tree& tree,
                  std::uint8_t* bytes, std::size_t row_bytes);
/// Starts to find the light of VPLs, W m^-2 sr^-1; `light` are three floats a luxel, `scratch` too.
void gather(Queue& queue, const Luxels& luxels, const VplArrays& vpls, const Tree& tree,
            float bound, std::uint32_t* scratch, float* light);
/// The same by bits that were found before.
void reshade(Queue& queue, const Luxels& luxels, const VplArrays& vpls, const ByteRows& bits,
             float bound, std::uint32_t* scratch, float* light);

}  // namespace mirpy::gpu
