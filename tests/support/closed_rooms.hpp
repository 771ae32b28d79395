// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/core/frame.hpp"
#include "support/scene_places.hpp"
#include "support/segment_ends.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace mirtest {

/// A closed surface of triangles that share their vertices: a ball around the origin of 2 x `rings`
/// x `rings` quads cut in two, each vertex at a random distance from 1 - rough to 1, then turned,
/// scaled and moved. No vertex and no edge is there twice.
inline World closed_ball(std::uint32_t rings, float rough, std::uint64_t index, float scale = 1.0f,
                         mir::Vec3 move = {0, 0, 0}) {
    mir::Random random = test_random(index);
    const mir::Frame frame = mir::Frame::around(direction(random));
    const std::uint32_t sectors = 2 * rings;
    mir::Mesh mesh;
    const auto add = [&](float polar, float round) {
        const float r = scale * (1.0f - rough * random.next());
        const mir::Vec3 d(std::sin(polar) * std::cos(round), std::cos(polar),
                          std::sin(polar) * std::sin(round));
        mesh.positions.push_back(move + r * frame.to_world(d));
    };
    add(0.0f, 0.0f);
    for (std::uint32_t i = 1; i < rings; ++i)
        for (std::uint32_t j = 0; j < sectors; ++j)
            add(mir::pi * static_cast<float>(i) / static_cast<float>(rings),
                2.0f * mir::pi * static_cast<float>(j) / static_cast<float>(sectors));
    add(mir::pi, 0.0f);
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return 1 + (i - 1) * sectors + j % sectors;
    };
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (std::uint32_t j = 0; j < sectors; ++j) {
        mesh.triangles.push_back({0, at(1, j + 1), at(1, j)});
        for (std::uint32_t i = 1; i + 1 < rings; ++i) {
            mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        }
        mesh.triangles.push_back({last, at(rings - 1, j), at(rings - 1, j + 1)});
    }
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return World(std::move(scene));
}

/// What closed_ball() is asked for.
struct BallShape {
    std::uint32_t rings = 0;
    float rough = 0.0f;
    float scale = 1.0f;
    float away = 0.0f;  ///< metres along x; the ball moves along the other axes too

    [[nodiscard]] mir::Vec3 centre() const { return {away, 0.3f * away, -away}; }
    [[nodiscard]] World world() const { return closed_ball(rings, rough, 1, scale, centre()); }
    [[nodiscard]] std::string name() const {
        std::ostringstream text;
        text << "rings " << rings << ", rough " << rough << ", scale " << scale << ", moved by "
             << away;
        return text.str();
    }
};

/// Smooth and rough balls, tiny and huge ones, and some away from the origin.
inline const std::vector<BallShape>& leak_balls() {
    static const std::vector<BallShape> balls{
        {2, 0.0f},       {4, 0.0f},        {4, 0.4f},           {6, 0.2f, 1e-6f},
        {6, 0.2f, 1e6f}, {4, 0.3f, 1, 30}, {6, 0.3f, 0.01f, 10}};
    return balls;
}

/// True when a segment crosses a triangle within its edges as computed, without their margins.
inline bool is_inside_edges(const mir::TriangleRows& rows, SegmentEnds s) {
    const float s_from = mir::row_at(rows.s, s.from);
    const float s_to = mir::row_at(rows.s, s.to);
    return mir::detail::opposite(s_from, s_to) &&
           mir::detail::is_inside(
               mir::detail::crossing(mir::detail::rows_at_ends(rows, s.from, s.to, s_from, s_to)));
}

/// Planes of all triangles of a scene.
class TrianglePlanes {
 public:
    explicit TrianglePlanes(const mir::WorldGeometry& g) {
        for (std::uint32_t t = 0; t < g.triangles().size(); ++t)
            frames_.push_back(
                mir::detail::triangle_frame(g.corner(t, 0), g.corner(t, 1), g.corner(t, 2)));
    }

    /// True when `p` lies farther than `least` from each, metres.
    [[nodiscard]] bool keep_off(mir::Vec3 p, double least) const {
        return std::all_of(frames_.begin(), frames_.end(), [&](const auto& f) {
            return std::abs(glm::dot(mir::detail::Double3(p) - f.corner, f.normal)) >= least;
        });
    }

 private:
    std::vector<mir::detail::TriangleFrame> frames_;
};

/// Segments from inside of a closed surface that is star-shaped around `centre` to points outside
/// of it, aimed at its edges and vertices. Each must meet the surface. The geometry must outlive
/// them.
class LeakSegments {
 public:
    LeakSegments(const mir::WorldGeometry& geometry, mir::Vec3 centre, std::uint64_t index)
        : places_(geometry), planes_(geometry), centre_(centre), random_(test_random(index)) {
        for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t)
            for (std::uint32_t k = 0; k < 3; ++k)
                radius_ = std::max(radius_, glm::length(geometry.corner(t, k) - centre));
    }

    /// Far past the edge or vertex.
    SegmentEnds next() {
        return keep_drawing([&] { return draw_far(start()); });
    }

    /// The same, all from one place.
    SegmentEnds next_from(mir::Vec3 from) {
        return keep_drawing([&] { return draw_far(from); });
    }

    /// To a distance from the centre, in radii of the surface. Up to 1.4 structures over a surface
    /// around the origin reach.
    SegmentEnds next_near(mir::Vec3 from, float distance) {
        return keep_drawing([&] { return to_distance(from, aim(), distance); });
    }

    /// The same past the edge of a triangle from corner `side` on, or past that corner; past any
    /// where such ends lie in planes.
    SegmentEnds next_past(mir::Vec3 from, std::uint32_t triangle, std::uint32_t side,
                          float distance) {
        for (int tries = 0; tries < 16; ++tries) {
            const bool at_edge = random_.next() < 0.75f;
            const mir::Vec3 at = at_edge ? places_.on_edge(triangle, side, random_)
                                         : places_.geometry().corner(triangle, side);
            const SegmentEnds s = to_distance(from, at, distance);
            if (keeps_off_planes(s)) return s;
        }
        return next_near(from, distance);
    }

    /// A place from which segments may go to any end that is drawn here.
    mir::Vec3 place() {
        const float farthest = mir::max_abs(centre_) + radius_ + 2.0f * places_.extent();
        for (;;) {
            const mir::Vec3 p = start();
            if (planes_.keep_off(p, off_planes * static_cast<double>(farthest))) return p;
        }
    }

    /// Any one, for next_past().
    std::uint32_t triangle() { return places_.triangle(random_); }
    /// Any one, for next_near() and next_past().
    float distance() { return 1.0f + 0.4f * random_.next(); }

 private:
    /// Of the largest coordinate: the bound that detail/thick_triangle.hpp asks for.
    static constexpr double off_planes = 100.0 * 0x1p-24;

    template <class Draw>
    SegmentEnds keep_drawing(const Draw& once) {
        for (;;) {
            const SegmentEnds s = once();
            if (keeps_off_planes(s)) return s;
        }
    }
    /// Anywhere between the centre and the surface, close to it in one draw of two, so that many
    /// segments lean.
    mir::Vec3 start() {
        const float way = random_.next();
        const float in = random_.next() < 0.5f ? 1.0f - std::pow(10.0f, -4.0f * way) : way;
        return centre_ + 0.9999f * in * (on_surface() - centre_);
    }
    mir::Vec3 aim() {
        return random_.next() < 0.5f ? places_.on_edge(random_) : places_.corner(random_);
    }
    /// Past an edge or vertex to where nothing is.
    SegmentEnds draw_far(mir::Vec3 from) {
        const mir::Vec3 at = aim();
        const float extent = places_.extent();
        const float beyond = extent / std::max(glm::length(at - from), 1e-6f * extent);
        return {from, at + (1.0f + random_.next()) * beyond * (at - from)};
    }
    /// Through `at` to where the line leaves the ball of `distance` radii, and a rounding farther.
    [[nodiscard]] SegmentEnds to_distance(mir::Vec3 from, mir::Vec3 at, float distance) const {
        using mir::detail::Double3;
        const Double3 start = Double3(from) - Double3(centre_);
        const Double3 way = glm::normalize(Double3(at) - Double3(from));
        const double radius = 1.0001 * static_cast<double>(distance * radius_);
        const double along = glm::dot(start, way);
        const double length =
            std::sqrt(along * along + radius * radius - glm::dot(start, start)) - along;
        return {from, mir::Vec3(Double3(from) + length * way)};
    }
    mir::Vec3 on_surface() {
        const mir::Vec2 uv = mir::square_to_triangle(random_.next_2d());
        return places_.geometry().view().position(places_.triangle(random_), uv);
    }
    [[nodiscard]] bool keeps_off_planes(const SegmentEnds& s) const {
        const double least =
            off_planes * static_cast<double>(mir::larger(mir::max_abs(s.from), mir::max_abs(s.to)));
        return planes_.keep_off(s.from, least) && planes_.keep_off(s.to, least);
    }

    ScenePlaces places_;
    TrianglePlanes planes_;
    mir::Vec3 centre_;
    float radius_ = 0.0f;  ///< of a ball around the surface, metres
    mir::Random random_;
};

}  // namespace mirtest
