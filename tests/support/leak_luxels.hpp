// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/wide_build.hpp"
#include "mir/shading/contribution.hpp"
#include "support/leak_blocks.hpp"
#include "support/shaft_words.hpp"
#include "support/soa_run.hpp"

namespace mirtest {

/// Luxels outside of a closed surface and VPLs inside of it, none of which sees another. Each block
/// of luxels is aimed past edges and vertices from one of the VPLs' places.
class LeakLuxels {
 public:
    LeakLuxels(LeakBlocks& leaks, std::size_t blocks) {
        add_vpls(leaks);
        std::vector<mir::Hit> luxels;
        for (std::size_t i = 0; i < blocks; ++i) {
            const LeakBlock block = leaks.next_from(vpls_[2 * (i % places)].position);
            for (const mir::Hit& luxel : block.luxels()) {
                segments_.push_back({block.from, luxel.position});
                luxels.push_back(luxel);
                facing_ += faces_one(luxel, i % places) ? 1 : 0;
            }
        }
        hits_ = HitRun(luxels);
    }

    /// Those that are aimed.
    [[nodiscard]] const std::vector<SegmentEnds>& segments() const { return segments_; }

    /// Number of them about which shafts are asked: luxel and VPL face each other.
    [[nodiscard]] std::size_t facing() const { return facing_; }

    /// All pairs. Valid while this object and the hierarchy of the surface stay where they are.
    [[nodiscard]] ShaftInput input(const mir::WideBvh& bvh) const {
        return {hits_.view(), vpls_, &bvh, mir::sigma_of_reach(bvh.view().reach)};
    }

 private:
    static constexpr std::size_t places = 8;  ///< of VPLs: two at each, back to back

    void add_vpls(LeakBlocks& leaks) {
        mir::Random random = test_random(4);
        for (std::size_t i = 0; i < places; ++i) {
            const mir::Vec3 place = leaks.place();
            const mir::Vec3 n = direction(random);
            vpls_.push_back({place, n, {1.0f, 1.0f, 1.0f}});
            vpls_.push_back({place, -n, {1.0f, 1.0f, 1.0f}});
        }
    }
    [[nodiscard]] bool faces_one(const mir::Hit& luxel, std::size_t place) const {
        return mir::faces(luxel, vpls_[2 * place]) || mir::faces(luxel, vpls_[2 * place + 1]);
    }

    std::vector<mir::Vpl> vpls_;
    std::vector<SegmentEnds> segments_;
    HitRun hits_{{}};
    std::size_t facing_ = 0;
};

/// Bits that are set.
inline std::size_t count_bits(const std::vector<std::uint32_t>& words) {
    std::size_t bits = 0;
    for (const std::uint32_t word : words) bits += static_cast<std::size_t>(std::popcount(word));
    return bits;
}

}  // namespace mirtest
