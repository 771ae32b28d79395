// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"

#include <algorithm>

namespace mirtest {

/// Uniform over [0, count).
inline std::uint32_t random_index(mir::Random& random, std::size_t count) {
    return std::min(static_cast<std::uint32_t>(random.next() * static_cast<float>(count)),
                    static_cast<std::uint32_t>(count - 1));
}

/// Random places on and around the triangles of a scene, metres: what segments of tests are made
/// of. The geometry must outlive it. Const use from any thread.
class ScenePlaces {
 public:
    explicit ScenePlaces(const mir::WorldGeometry& geometry) : geometry_(&geometry) {}

    [[nodiscard]] const mir::WorldGeometry& geometry() const { return *geometry_; }

    /// Length of the diagonal of the box around the scene.
    [[nodiscard]] float extent() const { return geometry_->bounds().diagonal(); }

    /// Uniform in the box around the scene.
    [[nodiscard]] mir::Vec3 anywhere(mir::Random& random) const {
        const mir::Vec3 half = 0.5f * (geometry_->bounds().high - geometry_->bounds().low);
        return geometry_->bounds().centre() + half * point_in_cube(random);
    }
    [[nodiscard]] std::uint32_t triangle(mir::Random& random) const {
        return random_index(random, geometry_->triangles().size());
    }
    [[nodiscard]] mir::Vec3 corner(mir::Random& random) const {
        const std::uint32_t k = random_index(random, 3);
        return geometry_->corner(triangle(random), k);
    }
    [[nodiscard]] mir::Vec3 on_edge(mir::Random& random) const {
        const std::uint32_t t = triangle(random);
        return on_edge(t, random_index(random, 3), random);
    }
    /// On the edge of triangle `t` that starts at corner k.
    [[nodiscard]] mir::Vec3 on_edge(std::uint32_t t, std::uint32_t k, mir::Random& random) const {
        const float share = random.next();
        return (1.0f - share) * geometry_->corner(t, k) + share * geometry_->corner(t, (k + 1) % 3);
    }
    /// In the plane of triangle `t` but for rounding, up to five of its sizes away from it.
    [[nodiscard]] mir::Vec3 in_plane(std::uint32_t t, mir::Random& random) const {
        const float u = 4.0f * random.next() - 2.0f;
        const float v = 4.0f * random.next() - 2.0f;
        return (1.0f - u - v) * geometry_->corner(t, 0) + u * geometry_->corner(t, 1) +
               v * geometry_->corner(t, 2);
    }
    /// The other end of a segment from `from` along a random axis, up to half the extent long.
    [[nodiscard]] mir::Vec3 along_axis(mir::Vec3 from, mir::Random& random) const {
        from[static_cast<int>(random_index(random, 3))] += extent() * (random.next() - 0.5f);
        return from;
    }

 private:
    const mir::WorldGeometry* geometry_;
};

}  // namespace mirtest
