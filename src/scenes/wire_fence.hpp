// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/tube.hpp"

namespace mir::builtin {

/// Woven wire in a parallelogram. Its corners are p, p + a, p + a + b, p + b. Its wires lie `mesh`
/// metres apart and pass over and under each other in turn.
struct Fence {
    Vec3 p{0};               ///< a corner, metres
    Vec3 a{0};               ///< one side, metres
    Vec3 b{0};               ///< the other side, metres
    float mesh = 0.0677f;    ///< from wire to wire, metres
    float radius = 0.0028f;  ///< of a wire, metres
};

/// Adds the wires along `a`. With a and b exchanged it adds those along `b`, which are lifted to
/// the other side at every crossing, because a x b changes its sign.
inline void add_wires(Mesh& m, const Fence& f) {
    const float length_a = glm::length(f.a);
    const float length_b = glm::length(f.b);
    const Vec3 out = glm::normalize(glm::cross(f.a, f.b));
    const auto wires = static_cast<std::uint32_t>(length_b / f.mesh);
    const auto knots = static_cast<std::uint32_t>(length_a / f.mesh);
    const std::uint32_t steps = 4;
    std::vector<Vec3> line;
    for (std::uint32_t w = 0; w <= wires; ++w) {
        line.clear();
        for (std::uint32_t k = 0; k <= knots * steps; ++k) {
            // Over the crossing wire where k + w is even, under it where it is odd.
            const float turn = pi * (static_cast<float>(k) / steps + static_cast<float>(w));
            const float lift = 1.25f * f.radius * std::cos(turn);
            const float u = static_cast<float>(k) / static_cast<float>(knots * steps);
            const float v = static_cast<float>(w) / static_cast<float>(wires);
            line.push_back(f.p + u * f.a + v * f.b + lift * out);
        }
        add_tube(m, line, f.radius, 5);
    }
}

/// Both families of wires.
inline Mesh fence(std::string name, std::uint32_t material, const Fence& f) {
    Mesh m = empty_mesh(std::move(name), material);
    add_wires(m, f);
    add_wires(m, {f.p, f.b, f.a, f.mesh, f.radius});
    return m;
}

}  // namespace mir::builtin
