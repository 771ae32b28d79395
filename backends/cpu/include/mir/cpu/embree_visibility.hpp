// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/cpu/detail/embree_opacity.hpp"

#include <limits>

namespace mir::cpu {

/// Segment visibility through Embree, one at a time or sixteen from one origin. Model of
/// Visibility and PacketVisibility; a handle that the EmbreeScene outlives, usable from any thread.
struct EmbreeVisibility {
    static constexpr Space space = Space::host;  ///< asked by the host alone

    RTCScene scene = nullptr;  ///< belongs to the EmbreeScene

    /// Tests the closed segment by one ray from `a`, with Embree's robust intersector.
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const {
        const detail::Segments segments{a, &b.x, &b.y, &b.z};
        return !meets(a, b, &segments);
    }

    /// True when a triangle lies between the points. One that is seen through does, too.
    [[nodiscard]] bool is_blocked(Vec3 a, Vec3 b) const { return meets(a, b, nullptr); }

    /// As PacketVisibility says, by one packet of sixteen rays from `origin`. Segments that touch
    /// an edge or a vertex to the last bit may be judged otherwise than by visible().
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const {
        RTCRay16 rays;
        alignas(64) int valid[16];
        const InstructionSet set = best_instruction_set();
        run_with(set, [&] { fill(rays, valid, origin, points, active); });
        const detail::Segments segments{origin, points.x, points.y, points.z};
        detail::occluded16(valid, scene, rays, &segments);
        std::uint32_t seen = 0;
        run_with(set, [&] {
            for (std::uint32_t k = 0; k < 16; ++k)
                seen |= static_cast<std::uint32_t>(rays.tfar[k] >= 0.0f) << k;
        });
        return seen & active;
    }

 private:
    [[nodiscard]] bool meets(Vec3 a, Vec3 b, const detail::Segments* segments) const {
        const Vec3 d = b - a;
        RTCRay ray{};
        ray.org_x = a.x;
        ray.org_y = a.y;
        ray.org_z = a.z;
        ray.dir_x = d.x;
        ray.dir_y = d.y;
        ray.dir_z = d.z;
        ray.tfar = 1.0f;
        ray.mask = detail::all_rays;
        detail::occluded1(scene, ray, segments);
        return ray.tfar < 0.0f;
    }
    static void fill(RTCRay16& rays, int* valid, Vec3 origin, const PointPacket& points,
                     std::uint32_t active) {
        for (std::uint32_t k = 0; k < 16; ++k) {
            const bool on = (active >> k & 1u) != 0;
            rays.org_x[k] = origin.x;
            rays.org_y[k] = origin.y;
            rays.org_z[k] = origin.z;
            // Without AVX-512 Embree cuts the packet up and looks at lanes that are off, which may
            // hold anything: they get an empty interval and a direction that is a number.
            rays.dir_x[k] = on ? points.x[k] - origin.x : 1.0f;
            rays.dir_y[k] = on ? points.y[k] - origin.y : 1.0f;
            rays.dir_z[k] = on ? points.z[k] - origin.z : 1.0f;
            rays.tnear[k] = on ? 0.0f : 1.0f;
            rays.tfar[k] = on ? 1.0f : 0.0f;
            rays.time[k] = 0.0f;
            rays.mask[k] = detail::all_rays;
            rays.id[k] = k;
            valid[k] = on ? -1 : 0;
        }
    }
};

static_assert(PacketVisibility<EmbreeVisibility>);

}  // namespace mir::cpu
