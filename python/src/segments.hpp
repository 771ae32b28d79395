// SPDX-License-Identifier: MIT
#pragma once

#include "arrays.hpp"
#include "luxel_arrays.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/concepts/visibility.hpp"
#include "packed_bits.hpp"
#include "target_facing.hpp"

#include <algorithm>

namespace mirpy {

/// Segments from points of surfaces to targets, read where they lie.
struct Segments {
    const FloatArray& points;
    const FloatArray& normals;
    const FloatArray& targets;
    const FloatArray* target_normals;  ///< null: targets are seen from everywhere
    float ray_offset;                  ///< metres

    [[nodiscard]] static mir::Vec3 triple(const FloatArray& rows, std::size_t i) {
        return {rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)};
    }
};

/// Sixteen points that are asked about together.
class PointGroup {
 public:
    static constexpr std::size_t size = mir::PointPacket::width;

    PointGroup(const Segments& segments, std::size_t group)
        : first_(group * size), count_(std::min(size, segments.points.size(0) - first_)) {
        for (std::size_t k = 0; k < count_; ++k) {
            normals_[k] = Segments::triple(segments.normals, first_ + k);
            places_[k] = lifted(Segments::triple(segments.points, first_ + k), normals_[k],
                                segments.ray_offset);
        }
        for (std::size_t k = 0; k < size; ++k) {
            packet_.x[k] = places_[k].x;
            packet_.y[k] = places_[k].y;
            packet_.z[k] = places_[k].z;
        }
    }

    [[nodiscard]] const mir::PointPacket& packet() const { return packet_; }
    [[nodiscard]] std::size_t first() const { return first_; }
    /// Bits of the points that lie before each other's surfaces.
    [[nodiscard]] std::uint32_t facing(const Segments& segments, std::size_t target) const {
        const mir::Vec3 end = Segments::triple(segments.targets, target);
        mir::Vec3 side(0.0f);
        const mir::Vec3* front = nullptr;
        if (segments.target_normals != nullptr) {
            side = Segments::triple(*segments.target_normals, target);
            front = &side;
        }
        std::uint32_t faces = 0;
        for (std::size_t k = 0; k < count_; ++k)
            if (faces_target(places_[k], normals_[k], end, front)) faces |= 1u << k;
        return faces;
    }

 private:
    std::size_t first_;
    std::size_t count_;
    mir::Vec3 places_[size]{};
    mir::Vec3 normals_[size]{};
    mir::PointPacket packet_{};
};

/// Sets the bits of `rows`, which are zero, where point and target face and see each other.
template <mir::PacketVisibility V, mir::Executor E>
void find_visible(const Segments& segments, const V& visibility, std::uint8_t* rows, E& executor) {
    const std::size_t row = bytes_of_row(segments.targets.size(0));
    const std::size_t groups = (segments.points.size(0) + PointGroup::size - 1) / PointGroup::size;
    executor.for_each(groups, [&](std::size_t g) {
        const PointGroup group(segments, g);
        for (std::size_t j = 0; j < segments.targets.size(0); ++j) {
            const std::uint32_t faces = group.facing(segments, j);
            if (faces == 0) continue;
            const std::uint32_t seen = visibility.visible_packet(
                Segments::triple(segments.targets, j), group.packet(), faces);
            for (std::uint32_t k = 0; k < PointGroup::size; ++k)
                if ((seen >> k & 1u) != 0)
                    rows[(group.first() + k) * row + j / 8] |=
                        static_cast<std::uint8_t>(1u << (j % 8));
        }
    });
}

}  // namespace mirpy
