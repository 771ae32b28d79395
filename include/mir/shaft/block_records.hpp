// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/candidate_lanes.hpp"

namespace mir {

/// What the cascade of the host knows about the 256 luxels of a block: their positions in packets
/// of sixteen, and records of the block, of its quarters and of its packets. Made once per block,
/// for all VPLs.
struct BlockRecords {
    static constexpr std::uint32_t packets = BlockMask::packets;
    static constexpr std::uint32_t parts = 1;
    static constexpr std::uint32_t part_packets = packets / parts;

    /// A cluster as a shaft's end and as a pyramid's base.
    struct Cluster {
        ClusterRecord record;
        detail::ClusterBox box;
        bool within = false;  ///< reach; false as well for clusters without luxels
    };

    PointPacket points[packets];
    Cluster packet[packets];
    Cluster part[parts];
    Cluster all;
    float sigma = 0.0f;  ///< of the scene, metres

    /// Of the first 256 luxels of `hits`. `reach` as for the hierarchy, metres.
    BlockRecords(const SoaView<const Hit>& hits, float reach, float scene_sigma)
        : all(cluster(hits, 0, BlockMask::luxels, reach, scene_sigma)), sigma(scene_sigma) {
        constexpr std::uint32_t luxels = PointPacket::width;
        for (std::uint32_t p = 0; p < parts; ++p)
            part[p] = cluster(hits, p * part_packets * luxels, part_packets * luxels, reach, sigma);
        for (std::uint32_t g = 0; g < packets; ++g) {
            packet[g] = cluster(hits, g * luxels, luxels, reach, sigma);
            for (std::uint32_t k = 0; k < luxels; ++k) {
                const Vec3 p = hits.load(g * luxels + k).position;
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
        c.record = cluster_record(hits, first, count, sigma);
        c.box = detail::cluster_box(c.record);
        c.within = c.record.luxels != 0 && within_reach(c.record, reach);
        return c;
    }
};

}  // namespace mir
