// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/accel/exact/accept_box.hpp"
#include "mir/accel/kd/kd_tree.hpp"
#include "support/scene_places.hpp"
#include "support/segment_ends.hpp"

#include <cmath>
#include <vector>

namespace mirtest {

/// One of the segments on which conservative tests go wrong first.
using HardSegment = SegmentEnds;

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
        : places_(geometry), random_(test_random(index)) {
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
    mir::Vec3 anywhere() { return places_.anywhere(random_); }
    mir::Vec3 corner() { return places_.corner(random_); }
    mir::Vec3 on_edge() { return places_.on_edge(random_); }
    /// Starts at `from`, goes through `at` and ends there or behind.
    HardSegment through(mir::Vec3 from, mir::Vec3 at) {
        const float reach = random_.next() < 0.2f ? 1.0f : 1.0f + random_.next();
        return {from, from + reach * (at - from)};
    }
    HardSegment in_plane() {
        const std::uint32_t t = places_.triangle(random_);
        const mir::Vec3 from = places_.in_plane(t, random_);
        return {from, places_.in_plane(t, random_)};
    }
    HardSegment along_axis(mir::Vec3 from) {
        const mir::Vec3 to = places_.along_axis(from, random_);
        return random_.next() < 0.5f ? HardSegment{from, to} : HardSegment{to, from};
    }
    mir::Vec3 on_plane(mir::Vec3 p) {
        if (planes_.empty()) return p;
        const mir::KdNode n = planes_[random_index(random_, planes_.size())];
        p[static_cast<int>(n.axis())] = n.split();
        return p;
    }
    mir::Vec3 lifted() {
        const mir::SurfacePoint p = random_surface_point(places_.geometry(), random_);
        return mir::lift(p);
    }
    /// Passes an edge at some units in the last place, within its triangle's plane or almost.
    HardSegment nearly_on_edge() {
        HardSegment s = in_plane();
        const mir::Vec3 at = on_edge();
        const float magnitude = mir::magnitude_of(places_.geometry().bounds());
        const auto units = static_cast<float>(2.0 * mir::sigma_of(magnitude));
        const mir::Vec3 aside = units * point_in_cube(random_);
        s.from = at + 0.1f * (s.from - at) + aside;
        s.to = at - random_.next() * (s.from - at) + 0.1f * aside;
        return s;
    }

    ScenePlaces places_;
    mir::Random random_;
    std::vector<mir::KdNode> planes_;
    std::uint32_t kind_ = 0;
};

}  // namespace mirtest
