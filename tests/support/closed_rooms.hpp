// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/triangle_rows.hpp"
#include "mir/core/frame.hpp"
#include "support/scene_places.hpp"
#include "support/segment_ends.hpp"

#include <cmath>

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

/// Segments from inside of a closed surface that is star-shaped around `centre` to points outside
/// of it, aimed at its edges and vertices. Each must meet the surface.
class LeakSegments {
 public:
    LeakSegments(const mir::WorldGeometry& geometry, mir::Vec3 centre, std::uint64_t index)
        : places_(geometry), centre_(centre), random_(test_random(index)) {}

    SegmentEnds next() {
        return keep_drawing([&] { return draw(start()); });
    }

    /// The same, all from one place.
    SegmentEnds next_from(mir::Vec3 from) {
        return keep_drawing([&] { return draw(from); });
    }

 private:
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
    /// Past an edge or vertex to where nothing is.
    SegmentEnds draw(mir::Vec3 from) {
        const mir::Vec3 at =
            random_.next() < 0.5f ? places_.on_edge(random_) : places_.corner(random_);
        const float beyond = places_.extent() / std::max(glm::length(at - from), 1e-6f);
        return {from, at + (1.0f + random_.next()) * beyond * (at - from)};
    }
    mir::Vec3 on_surface() {
        const mir::Vec2 uv = mir::square_to_triangle(random_.next_2d());
        return places_.geometry().view().position(places_.triangle(random_), uv);
    }
    /// By the bound that detail/thick_triangle.hpp asks for.
    [[nodiscard]] bool keeps_off_planes(const SegmentEnds& s) const {
        const mir::WorldGeometry& g = places_.geometry();
        const double least =
            100.0 * 0x1p-24 *
            static_cast<double>(mir::larger(mir::max_abs(s.from), mir::max_abs(s.to)));
        for (std::uint32_t t = 0; t < g.triangles().size(); ++t) {
            const mir::detail::TriangleFrame f =
                mir::detail::triangle_frame(g.corner(t, 0), g.corner(t, 1), g.corner(t, 2));
            for (const mir::Vec3 p : {s.from, s.to})
                if (std::abs(glm::dot(mir::detail::Double3(p) - f.corner, f.normal)) < least)
                    return false;
        }
        return true;
    }

    ScenePlaces places_;
    mir::Vec3 centre_;
    mir::Random random_;
};

}  // namespace mirtest
