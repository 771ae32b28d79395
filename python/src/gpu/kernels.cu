// SPDX-License-Identifier: MIT
#include "gpu/kernels.hpp"
#include "mir/accel/kd/kd_rays.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/kernels/fused.hpp"
#include "mir/kernels/shading_pass.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "target_facing.hpp"

namespace mirpy::gpu {
namespace {

using Shading = mir::VplShading<mir::CookTorrance>;
using Sight = mir::KdTreeVisibility<mir::Space::device>;

/// Most threads of one launch.
constexpr std::size_t most_threads = std::size_t{1} << 30;

/// Calls launch(first, count) for parts of `all` that one launch can count.
template <class Launch>
void in_parts(std::size_t all, const Launch& launch) {
    for (std::size_t first = 0; first < all; first += most_threads)
        launch(first,
               static_cast<std::uint32_t>(all - first < most_threads ? all - first : most_threads));
}

/// Kernel over elements: marks those that are no numbers.
struct NotFinite {
    StridedFloats array;
    std::size_t first;
    std::size_t columns;
    std::size_t depth;
    std::uint32_t* mark;

    MIR_HD void operator()(std::uint32_t n) const {
        const std::size_t i = first + n;
        const float x = array.at(i / (columns * depth), i / depth % columns, i % depth);
        // All threads that write, write the same.
        if (!(x - x == 0.0f)) *mark = 1;
    }
};

/// Kernel over bytes of bits, eight targets of one point each.
struct VisibleByte {
    SegmentArrays segments;
    Sight sight;
    std::size_t first;
    std::size_t row_bytes;
    std::uint8_t* bytes;

    MIR_HD void operator()(std::uint32_t n) const {
        const std::size_t byte = first + n;
        const std::size_t point = byte / row_bytes;
        const auto begin = static_cast<std::uint32_t>(byte % row_bytes * 8);
        const mir::Vec3 normal = segments.normals.row(point);
        const mir::Vec3 place = lifted(segments.points.row(point), normal, segments.ray_offset);
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < 8 && begin + k < segments.target_count; ++k)
            if (sees(place, normal, begin + k)) seen |= 1u << k;
        bytes[byte] = static_cast<std::uint8_t>(seen);
    }

 private:
    [[nodiscard]] MIR_HD bool sees(mir::Vec3 place, mir::Vec3 normal, std::uint32_t target) const {
        const mir::Vec3 end = segments.targets.row(target);
        mir::Vec3 side(0.0f);
        const bool has_front = segments.target_normals.exists();
        if (has_front) side = segments.target_normals.row(target);
        return faces_target(place, normal, end, has_front ? &side : nullptr) &&
               sight.visible(end, place);
    }
};

/// Kernel over luxels: planes of colours become three floats one behind the other.
struct Interleave {
    mir::SoaView<const mir::Rgb> from;
    float* to;

    MIR_HD void operator()(std::uint32_t i) const {
        const mir::Rgb c = from.load(i);
        float* const pixel = to + std::size_t{i} * 3;
        pixel[0] = c.r;
        pixel[1] = c.g;
        pixel[2] = c.b;
    }
};

}  // namespace

void mark_not_finite(Queue& queue, const StridedFloats& array,
                     const std::array<std::size_t, 3>& sizes, std::uint32_t* mark) {
    in_parts(sizes[0] * sizes[1] * sizes[2], [&](std::size_t first, std::uint32_t count) {
        queue.for_each(count, NotFinite{array, first, sizes[1], sizes[2], mark});
    });
}

void find_visible(Queue& queue, const SegmentArrays& segments, const Tree& tree,
                  std::uint8_t* bytes, std::size_t row_bytes) {
    in_parts(segments.point_count * row_bytes, [&](std::size_t first, std::uint32_t count) {
        queue.for_each(count, VisibleByte{segments, {tree}, first, row_bytes, bytes});
    });
}

void gather(Queue& queue, const Luxels& luxels, const VplArrays& vpls, const Tree& tree,
            float bound, std::uint32_t* scratch, float* light) {
    queue.for_each(luxels.size(), mir::FusedKernel{luxels, vpls, Sight{tree}, Shading{bound},
                                                   mir::SoaView<mir::Rgb>{scratch, luxels.size()}});
    queue.for_each(luxels.size(), Interleave{{scratch, luxels.size()}, light});
}

void reshade(Queue& queue, const Luxels& luxels, const VplArrays& vpls, const ByteRows& bits,
             float bound, std::uint32_t* scratch, float* light) {
    queue.for_each(luxels.size(), mir::ShadingPass{luxels, vpls, bits, Shading{bound},
                                                   mir::SoaView<mir::Rgb>{scratch, luxels.size()}});
    queue.for_each(luxels.size(), Interleave{{scratch, luxels.size()}, light});
}

}  // namespace mirpy::gpu
