// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/shaft/host/candidate_lanes.hpp"
#include "mir/shaft/host/detail/packet_columns.hpp"

#include <algorithm>
#include <array>

namespace mir {

/// What the cascade of the host knows about the 256 luxels of a block. Their positions in packets
/// of sixteen, and records of the block and of its packets. Made once per block, for all VPLs.
struct BlockRecords {
    static constexpr std::uint32_t packets = BlockMask::packets;  ///< of a block, 16 luxels each

    /// A cluster as a shaft's end and as a pyramid's base.
    struct Cluster {
        ClusterRecord record;    ///< its box and half-space
        detail::ClusterBox box;  ///< the record's box by centre and half edges, metres
        bool within = false;     ///< reach; false as well for clusters without luxels
    };

    PointPacket points[packets];  ///< positions in blocked order, metres
    Cluster packet[packets];      ///< of each packet alone
    Cluster pair[packets / 2];    ///< of two packets side by side
    Cluster all;                  ///< of the whole block
    float sigma = 0.0f;           ///< of the scene, metres

    /// Of the first 256 luxels of `hits`, finite or not. `reach` as for the hierarchy and `sigma`
    /// as for records of clusters, metres.
    BlockRecords(const SoaView<const Hit>& hits, float reach, float scene_sigma)
        : sigma(scene_sigma) {
        constexpr std::uint32_t width = PointPacket::width;
        for (std::uint32_t g = 0; g < packets; ++g)
            for (std::uint32_t k = 0; k < width; ++k) {
                const Vec3 p = hits.load(g * width + k).position;
                points[g].x[k] = p.x;
                points[g].y[k] = p.y;
                points[g].z[k] = p.z;
            }
        const detail::PacketColumns columns(hits);
        const auto sums = columns.sums();
        set_clusters<1>(columns, sums, reach, packet);
        set_clusters<2>(columns, sums, reach, pair);
        set_clusters<packets>(columns, sums, reach, &all);
    }

 private:
    /// Clusters of `Size` packets each.
    template <std::uint32_t Size>
    void set_clusters(const detail::PacketColumns& columns,
                      const std::array<detail::ClusterSum, packets>& sums, float reach,
                      Cluster* clusters) {
        detail::ClusterSum joined[packets / Size];
        detail::LaneRows fronts;
        for (std::uint32_t c = 0; c < packets / Size; ++c) {
            for (std::uint32_t g = c * Size; g < (c + 1) * Size; ++g) joined[c].add(sums[g]);
            const AffineRow front = detail::direction_row(joined[c].normals);
            for (std::uint32_t g = c * Size; g < (c + 1) * Size; ++g) fronts.set(g, front);
        }
        const detail::LaneFloats least = columns.least_at(fronts);
        for (std::uint32_t c = 0; c < packets / Size; ++c) {
            const std::uint32_t first = c * Size;
            const float its_least = *std::min_element(least.at + first, least.at + first + Size);
            if (joined[c].luxels != 0)
                clusters[c] =
                    cluster(upright_record(joined[c], fronts.row(first), its_least, sigma), reach);
        }
    }
    static Cluster cluster(const ClusterRecord& record, float reach) {
        return {record, detail::cluster_box(record), within_reach(record, reach)};
    }
};

}  // namespace mir
