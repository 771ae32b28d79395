// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/accel/kd_tree.hpp"

#include <cmath>
#include <vector>

namespace mirtest {

/// A segment, and the scenes and segments on which conservative tests go wrong first.
struct HardSegment {
    mir::Vec3 from{0};
    mir::Vec3 to{0};
};

inline std::uint32_t random_index(mir::Random& random, std::size_t count) {
    return std::min(static_cast<std::uint32_t>(random.next() * static_cast<float>(count)),
                    static_cast<std::uint32_t>(count - 1));
}

/// `count` needles: one edge is 10 to 10^6 times as long as the height over it.
inline World needle_soup(std::uint32_t count, std::uint64_t index, float scale = 1.0f,
                         mir::Vec3 move = {0, 0, 0}) {
    mir::Random random = test_random(index);
    mir::Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const mir::Vec3 a = point_in_cube(random);
        const mir::Vec3 along = 0.7f * direction(random);
        const float thin = 0.1f * std::pow(10.0f, -5.0f * random.next());
        const mir::Vec3 aside = thin * direction(random);
        const mir::Vec3 apex = a + random.next() * along + aside;
        for (mir::Vec3 p : {a, a + along, apex}) mesh.positions.push_back(move + scale * p);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return World(std::move(scene));
}

/// Makes segments for one scene; every call gives the next of ten kinds.
class HardSegments {
 public:
    HardSegments(const mir::WorldGeometry& geometry, const std::vector<mir::KdNode>& nodes,
                 std::uint64_t index)
        : geometry_(&geometry), random_(test_random(index)) {
        for (mir::KdNode n : nodes)
            if (!n.is_leaf()) planes_.push_back(n);
    }

    HardSegment next() {
        switch (kind_++ % 10) {
            case 0:
                return {anywhere(), anywhere()};
            case 1:
                return through(anywhere(), on_edge());
            case 2:
                return through(anywhere(), corner());
            case 3:
                return in_plane();
            case 4:
                return along_axis(anywhere());
            case 5:
                return {on_plane(anywhere()), on_plane(anywhere())};
            case 6:
                return along_axis(on_plane(corner()));
            case 7:
                return {lifted(), lifted()};
            case 8:
                return through(1000.0f * anywhere(), on_edge());
            default:
                return nearly_on_edge();
        }
    }

    /// Aimed at a corner, where hits outside of the exact box of a triangle are most frequent.
    HardSegment at_corner() { return through(anywhere(), corner()); }

 private:
    float extent() const { return geometry_->bounds().diagonal(); }
    mir::Vec3 anywhere() {
        const mir::Vec3 half = 0.5f * (geometry_->bounds().high - geometry_->bounds().low);
        return geometry_->bounds().centre() + half * point_in_cube(random_);
    }
    std::uint32_t triangle() { return random_index(random_, geometry_->triangles().size()); }
    mir::Vec3 corner() { return geometry_->corner(triangle(), random_index(random_, 3)); }
    mir::Vec3 on_edge() {
        const std::uint32_t t = triangle();
        const std::uint32_t k = random_index(random_, 3);
        const float share = random_.next();
        return (1.0f - share) * geometry_->corner(t, k) + share * geometry_->corner(t, (k + 1) % 3);
    }
    /// Starts at `from`, goes through `at` and ends there or behind.
    HardSegment through(mir::Vec3 from, mir::Vec3 at) {
        const float reach = random_.next() < 0.2f ? 1.0f : 1.0f + random_.next();
        return {from, from + reach * (at - from)};
    }
    HardSegment in_plane() {
        const std::uint32_t t = triangle();
        const auto point = [&] {
            const float u = 4.0f * random_.next() - 2.0f;
            const float v = 4.0f * random_.next() - 2.0f;
            return (1.0f - u - v) * geometry_->corner(t, 0) + u * geometry_->corner(t, 1) +
                   v * geometry_->corner(t, 2);
        };
        return {point(), point()};
    }
    HardSegment along_axis(mir::Vec3 from) {
        mir::Vec3 to = from;
        to[static_cast<int>(random_index(random_, 3))] += extent() * (random_.next() - 0.5f);
        return random_.next() < 0.5f ? HardSegment{from, to} : HardSegment{to, from};
    }
    mir::Vec3 on_plane(mir::Vec3 p) {
        if (planes_.empty()) return p;
        const mir::KdNode n = planes_[random_index(random_, planes_.size())];
        p[static_cast<int>(n.axis())] = n.split();
        return p;
    }
    mir::Vec3 lifted() {
        const mir::SurfacePoint p = random_surface_point(*geometry_, random_);
        return mir::lift(p.position, p.geometric_normal, geometry_->ray_offset());
    }
    /// Passes an edge at some units in the last place, within its triangle's plane or almost.
    HardSegment nearly_on_edge() {
        HardSegment s = in_plane();
        const mir::Vec3 at = on_edge();
        const mir::Vec3 aside = 4.0f * geometry_->ray_offset() * point_in_cube(random_);
        s.from = at + 0.1f * (s.from - at) + aside;
        s.to = at - random_.next() * (s.from - at) + 0.1f * aside;
        return s;
    }

    const mir::WorldGeometry* geometry_;
    mir::Random random_;
    std::vector<mir::KdNode> planes_;
    std::uint32_t kind_ = 0;
};

}  // namespace mirtest
