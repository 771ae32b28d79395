// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/soa.hpp"
#include "mir/shaft/device/work_queue.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

namespace mir {

/// Decides the pairs of 32 luxels and a VPL that no shaft could. Kernel for groups, a pair at a
/// time and a luxel per lane, by single segments.
template <VplSet P, Visibility V>
struct OpenSegments {
    /// Groups need no memory.
    struct Workspace {};

    SoaView<const Hit> hits;         ///< in cluster order
    P vpls;                          ///< those of the words
    V visibility;                    ///< asked VPL first, where both face each other
    std::uint32_t* words = nullptr;  ///< as VisibilityWords
    WorkQueue<OpenPair> open;        ///< clusters

    /// Takes pairs from `open` until none is left. Any number of groups does all the work.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t /*i*/, Workspace&) const {
        const std::uint32_t count = open.size();
        for (std::uint32_t at = open.take(group, 1); at < count; at = open.take(group, 1))
            decide(group, open.items[at]);
    }

 private:
    MIR_HD void decide(const LaneGroup& group, OpenPair pair) const {
        const Vec3 apex = vpls[pair.vpl].position;
        std::uint32_t& word = words[std::size_t{pair.cluster} * vpls.size() + pair.vpl];
        const std::uint32_t facing = word;
        const std::uint32_t lit = group.ballot([&](std::uint32_t lane) {
            return (facing >> lane & 1u) != 0 &&
                   visibility.visible(apex,
                                      hits.load(pair.cluster * cluster_luxels + lane).position);
        });
        group.each([&](std::uint32_t lane) {
            if (lane == 0) word = lit;
        });
    }
};
template <class P, class V>
OpenSegments(SoaView<const Hit>, P, V, std::uint32_t*, WorkQueue<OpenPair>) -> OpenSegments<P, V>;

}  // namespace mir
