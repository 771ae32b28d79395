// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/discrete_distribution.hpp"
#include "support/scene_places.hpp"
#include "support/segment_ends.hpp"

#include <cstdlib>
#include <string>
#include <vector>

namespace mirtest {

/// How random segments are laid through a scene.
enum class SegmentKind : std::uint32_t {
    anywhere,    ///< uniform in the box around the scene
    shadow_ray,  ///< between lifted points of surfaces that face each other, uniform over their
                 ///< area
    nearby,      ///< from a surface, 1/2000 to 1/20 of the scene long
    aimed,       ///< at edges and corners; a fifth of them end there
    in_plane     ///< in the planes of triangles, half of them along an axis
};

/// True for kinds that meet edges by chance only.
[[nodiscard]] constexpr bool is_generic(SegmentKind kind) {
    return kind != SegmentKind::aimed && kind != SegmentKind::in_plane;
}

/// Segments from the environment variable MIR_TEST_SEGMENTS, or `otherwise` without it; a multiple
/// of 128, so that words of bits are full and every kind has its share.
[[nodiscard]] inline std::uint64_t segments_per_scene(std::uint64_t otherwise) {
    const char* wanted = std::getenv("MIR_TEST_SEGMENTS");
    return ((wanted == nullptr ? otherwise : std::stoull(wanted)) + 127) / 128 * 128;
}

/// Random segments through one scene: number i is a function of the scene and of i. Sixteen in a
/// row have one origin and one kind. All ends lie within the reach of a kd-tree over the scene. The
/// geometry must outlive it. Const use from any thread.
class RandomSegments {
 public:
    static constexpr std::uint32_t lanes = mir::PointPacket::width;

    explicit RandomSegments(const mir::WorldGeometry& geometry) : places_(geometry) {
        std::vector<float> areas;
        for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
            areas.push_back(geometry.area(t));
            if (flat_axis(t) >= 0) flat_.push_back(t);
        }
        by_area_ = mir::DiscreteDistribution(areas);
    }

    /// Three of eight packets are shadow rays, two go anywhere, the other kinds have one each.
    [[nodiscard]] static constexpr SegmentKind kind_of(std::uint64_t segment) {
        constexpr SegmentKind kinds[] = {SegmentKind::anywhere,   SegmentKind::shadow_ray,
                                         SegmentKind::aimed,      SegmentKind::shadow_ray,
                                         SegmentKind::anywhere,   SegmentKind::nearby,
                                         SegmentKind::shadow_ray, SegmentKind::in_plane};
        return kinds[segment / lanes % 8];
    }

    /// Segments [first, first + count), both multiples of `lanes`.
    template <mir::Executor E>
    [[nodiscard]] std::vector<SegmentEnds> make(std::uint64_t first, std::size_t count,
                                                E& executor) const {
        std::vector<SegmentEnds> segments(count);
        executor.for_each(count / lanes, [&](std::size_t packet) {
            make_packet(first + packet * lanes, &segments[packet * lanes]);
        });
        return segments;
    }

 private:
    /// What all segments of a packet share.
    struct Origin {
        mir::Vec3 point{0};
        mir::Vec3 normal{0};         ///< of the surface it lies on, if it does
        std::uint32_t triangle = 0;  ///< in whose plane it lies, if it does
    };

    void make_packet(std::uint64_t first, SegmentEnds* segments) const {
        mir::Random random = test_random(first / lanes);
        const SegmentKind kind = kind_of(first);
        const Origin origin = draw_origin(kind, random);
        for (std::uint32_t k = 0; k < lanes; ++k)
            segments[k] = {origin.point, draw_end(kind, origin, k, random)};
    }

    [[nodiscard]] Origin draw_origin(SegmentKind kind, mir::Random& random) const {
        if (kind == SegmentKind::shadow_ray || kind == SegmentKind::nearby)
            return on_surface(direction(random), random);
        if (kind != SegmentKind::in_plane) return {places_.anywhere(random)};
        const std::uint32_t t =
            flat_.empty() ? places_.triangle(random) : flat_[random_index(random, flat_.size())];
        return {in_plane(t, random), mir::Vec3(0), t};
    }

    [[nodiscard]] mir::Vec3 draw_end(SegmentKind kind, const Origin& origin, std::uint32_t lane,
                                     mir::Random& random) const {
        switch (kind) {
            case SegmentKind::anywhere:
                return places_.anywhere(random);
            case SegmentKind::shadow_ray:
                return facing(origin, random);
            case SegmentKind::nearby: {
                // Much shorter ones would end exactly on their surface's plane too often.
                const float length = (0.0005f + 0.0495f * random.next()) * places_.extent();
                return origin.point + length * direction(random);
            }
            case SegmentKind::aimed:
                return at_or_behind(
                    origin.point, lane % 2 == 0 ? places_.on_edge(random) : places_.corner(random),
                    random);
            case SegmentKind::in_plane:
                break;
        }
        return lane % 2 == 0 ? inside(places_.along_axis(origin.point, random))
                             : in_plane(origin.triangle, random);
    }

    /// Uniform over the area of all triangles, lifted off the side that is seen along `towards`.
    [[nodiscard]] Origin on_surface(mir::Vec3 towards, mir::Random& random) const {
        const mir::WorldGeometry& geometry = places_.geometry();
        const std::uint32_t t = by_area_.sample(random.next());
        const auto p =
            geometry.surface_point(t, mir::square_to_triangle(random.next_2d()), towards);
        return {mir::lift(p), p.geometric_normal, t};
    }

    /// On a surface in front of the origin's surface and turned to it, if one of eight tries is.
    [[nodiscard]] mir::Vec3 facing(const Origin& origin, mir::Random& random) const {
        mir::Vec3 end{0};
        for (int i = 0; i < 8; ++i) {
            const Origin p = on_surface(direction(random), random);
            end = p.point;
            if (glm::dot(end - origin.point, origin.normal) > 0.0f &&
                glm::dot(origin.point - end, p.normal) > 0.0f)
                break;
        }
        return end;
    }

    /// `at` itself or a point up to a quarter farther, which is within reach wherever `at` lies.
    [[nodiscard]] static mir::Vec3 at_or_behind(mir::Vec3 from, mir::Vec3 at, mir::Random& random) {
        const bool ends_there = random.next() < 0.2f;
        const float farther = 1.0f + 0.25f * random.next();
        return ends_there ? at : from + farther * (at - from);
    }

    [[nodiscard]] mir::Vec3 inside(mir::Vec3 p) const {
        const mir::Bounds& box = places_.geometry().bounds();
        return glm::clamp(p, box.low, box.high);
    }

    /// Exactly so for triangles whose plane an axis is normal to.
    [[nodiscard]] mir::Vec3 in_plane(std::uint32_t t, mir::Random& random) const {
        mir::Vec3 p = inside(places_.in_plane(t, random));
        const int axis = flat_axis(t);
        if (axis >= 0) p[axis] = places_.geometry().corner(t, 0)[axis];
        return p;
    }

    /// Axis along which all corners of a triangle have the same coordinate, or -1.
    [[nodiscard]] int flat_axis(std::uint32_t t) const {
        const mir::WorldGeometry& geometry = places_.geometry();
        for (int axis = 0; axis < 3; ++axis)
            if (geometry.corner(t, 0)[axis] == geometry.corner(t, 1)[axis] &&
                geometry.corner(t, 0)[axis] == geometry.corner(t, 2)[axis])
                return axis;
        return -1;
    }

    ScenePlaces places_;
    mir::DiscreteDistribution by_area_;
    std::vector<std::uint32_t> flat_;  ///< triangles whose plane an axis is normal to
};

}  // namespace mirtest
