// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"
#include "mir/shaft/device/kept_planes.hpp"
#include "mir/shaft/exact/cluster_record.hpp"
#include "mir/shaft/exact/occlusion.hpp"

#include <cstring>

namespace mir {

/// The segments between a VPL and 32 luxels, of a group. What triangles whose planes are kept do to
/// each of them. A lane knows of two luxels, lane % 16 and the one 16 behind it. Lanes 0 to 15 ask
/// the first half of the planes and the others the second, so that one is read for two luxels.
class PairSegments {
 public:
    /// Segments of the luxels from `first_luxel` on and the VPL of `pyramid`. The pyramid is that
    /// of the planes and has to stay.
    MIR_HD PairSegments(const LaneGroup& group, const SoaView<const Hit>& hits,
                        std::uint32_t first_luxel, const Pyramid& pyramid)
        : group_(group), pyramid_(pyramid) {
        group_.each([&](std::uint32_t lane) {
            Segments& s = segments_[lane];
            for (std::uint32_t j = 0; j < 2; ++j) {
                s.luxel[j] = hits.load(first_luxel + lane % half_width + j * half_width).position;
                s.end[j] = pyramid.local(s.luxel[j]);
                s.most[j] = 0.0f;
            }
            s.sure = 0;
        });
    }

    /// Luxels of `lit`, a bit each, that no triangle in `range` hides. The range is not empty.
    /// `triangles` are all by their place in the hierarchy. To be called once. Triangles that are
    /// not sure are asked exactly, and last: by then most of the segments are hidden.
    [[nodiscard]] MIR_HD std::uint32_t lit_behind(const KeptPlanes& planes, PlaneRange range,
                                                  const TriangleRows* triangles,
                                                  std::uint32_t lit) {
        const Halves halves = Halves::of(range);
        group_.each([&](std::uint32_t lane) {
            const std::uint32_t first = lane < half_width ? halves.first[0] : halves.first[1];
            for (std::uint32_t k = 0; k < halves.size; ++k)
                ask(planes.get(first + k), segments_[lane]);
        });
        for (std::uint32_t j = 0; j < 2; ++j) {
            const std::uint32_t hit =
                group_.ballot([&](std::uint32_t lane) { return segments_[lane].most[j] > 1.0f; });
            lit &= ~(((hit | hit >> half_width) & 0xFFFFu) << j * half_width);
        }
        for (std::uint32_t h = 0; h < 2 && lit != 0; ++h) {
            std::uint32_t asked = unsure_of(h, halves.size, lit);
            for (; asked != 0 && lit != 0; asked &= asked - 1) {
                const std::uint32_t kept =
                    halves.first[h] + halves.size - 1 - LaneGroup::lowest(asked);
                lit = lit_behind(triangles[planes.triangle(kept)], lit);
            }
        }
        return lit;
    }

 private:
    static constexpr std::uint32_t half_width = LaneGroup::width / 2;

    /// What a lane knows.
    struct Segments {
        Vec3 luxel[2];       ///< metres
        Vec3 end[2];         ///< in the pyramid's local coordinates, metres
        float most[2];       ///< largest value of a triangle there: above 1 where one surely hits
        std::uint32_t sure;  ///< bit k: the k-th triangle from the half's last one leaves none open
    };

    /// Planes in two halves of the same size: one in the middle is in both.
    struct Halves {
        std::uint32_t first[2];
        std::uint32_t size;

        [[nodiscard]] MIR_HD static Halves of(PlaneRange range) {
            const std::uint32_t size = (range.end - range.first + 1) / 2;
            return {{range.first, range.end - size}, size};
        }
    };

    MIR_HD static void ask(const SurePlanes& planes, Segments& s) {
        const float first = planes.at(s.end[0]);
        const float second = planes.at(s.end[1]);
        s.most[0] = fmaxf(s.most[0], first);
        s.most[1] = fmaxf(s.most[1], second);
        // A difference costs the device less than a comparison whose result becomes a number.
        s.sure = s.sure << 1 | sign_of(1.0f - fminf(fabsf(first), fabsf(second)));
    }
    /// 1 for negative numbers.
    MIR_HD static std::uint32_t sign_of(float x) {
        std::uint32_t bits = 0;
        memcpy(&bits, &x, sizeof bits);
        return bits >> 31;
    }

    /// Planes of half `h` that leave a luxel of `lit` open. There are `count`; the luxel is the
    /// lane's or its other one.
    [[nodiscard]] MIR_HD std::uint32_t unsure_of(std::uint32_t h, std::uint32_t count,
                                                 std::uint32_t lit) const {
        return group_.any_bits([&](std::uint32_t lane) {
            const bool is_asked =
                lane / half_width == h && (lit >> lane % half_width & 0x10001u) != 0;
            return is_asked ? ~segments_[lane].sure & LaneGroup::bits(0, count) : 0u;
        });
    }

    /// Luxels of `lit` whose segments hits_segment() denies.
    [[nodiscard]] MIR_HD std::uint32_t lit_behind(const TriangleRows& rows,
                                                  std::uint32_t lit) const {
        return lit & group_.ballot([&](std::uint32_t lane) {
            const Segments& s = segments_[lane];
            return (lit >> lane & 1u) != 0 &&
                   !hits_segment(rows, pyramid_.apex, lane < half_width ? s.luxel[0] : s.luxel[1]);
        });
    }

    const LaneGroup& group_;
    const Pyramid& pyramid_;
    LaneGroup::PerLane<Segments> segments_;
};

}  // namespace mir
