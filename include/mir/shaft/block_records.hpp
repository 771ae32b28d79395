// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/shaft/candidate_lanes.hpp"

namespace mir {

/// What the cascade of the host knows about the 256 luxels of a block: their positions in packets
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
        : all(cluster(hits, 0, BlockMask::luxels, reach, scene_sigma)), sigma(scene_sigma) {
        constexpr std::uint32_t width = PointPacket::width;
        for (std::uint32_t g = 0; g < packets / 2; ++g)
            pair[g] = cluster(hits, g * 2 * width, 2 * width, reach, sigma);
        for (std::uint32_t g = 0; g < packets; ++g) {
            packet[g] = cluster(hits, g * width, width, reach, sigma);
            for (std::uint32_t k = 0; k < width; ++k) {
                const Vec3 p = hits.load(g * width + k).position;
                points[g].x[k] = p.x;
                points[g].y[k] = p.y;
                points[g].z[k] = p.z;
            }
        }
    }

 private:
    static Cluster cluster(const SoaView<const Hit>& hits, std::uint32_t first, std::uint32_t count,
                           float reach, float sigma) {
        Cluster c;
        c.record = upright_record(hits, first, count, sigma);
        c.box = detail::cluster_box(c.record);
        c.within = c.record.luxels != 0 && within_reach(c.record, reach);
        return c;
    }
};

}  // namespace mir
