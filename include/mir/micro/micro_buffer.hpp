// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/random.hpp"
#include "mir/core/warp.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/micro/surfel_traverse.hpp"

namespace mir {

/// A small picture of the hemisphere above a point: what each of its texels sees first of a tree of
/// discs. Texels are squares of the unit square under square_to_cosine_hemisphere(), so that each
/// stands for the same projected solid angle, pi / side^2, and is seen along one direction inside
/// it. A value without memory of its own, 14 kB; for host and device.
class MicroBuffer {
 public:
    static constexpr std::uint32_t largest_side = BufferGatherOptions::largest_side;

    /// `side` texels in each direction, 1 to largest_side, around a unit normal; `jitter` in
    /// [0, 1)^2 is the place of the directions inside their texels.
    MIR_HD MicroBuffer(std::uint32_t side, Vec3 normal, Vec2 jitter)
        : side_(side), frame_(Frame::around(normal)) {
        const float step = 1.0f / static_cast<float>(side);
        for (std::uint32_t i = 0; i < size(); ++i) {
            const Vec2 u = step * (Vec2(i % side, i / side) + jitter);
            direction_[i] = frame_.to_world(square_to_cosine_hemisphere(u));
        }
    }

    [[nodiscard]] MIR_HD std::uint32_t size() const { return side_ * side_; }
    /// Unit, in the world.
    [[nodiscard]] MIR_HD Vec3 direction(std::uint32_t texel) const { return direction_[texel]; }
    [[nodiscard]] MIR_HD const SurfelHit& hit(std::uint32_t texel) const { return hit_[texel]; }

    /// Draws a tree as seen from `origin`, above the tangent plane of `normal` (SurfelRay::normal),
    /// in one walk: down to discs, or to nodes whose solid angle is at most `solid_angle` (sr) and
    /// which closest_surfel() would stop at. A texel holds the nearest of those that its direction
    /// meets. Source: Ritschel et al. 2009, section 4; nodes are met by all texels that they cover,
    /// not splatted into one, which leaves holes.
    template <Space S>
    MIR_HD void draw(const SurfelTreeView<S>& tree, Vec3 origin, Vec3 normal, float solid_angle) {
        if (tree.empty()) return;
        const SurfelRay point{origin, {0, 0, 1}, normal, solid_angle};
        const float sine2 = cap_sine_squared(solid_angle);
        detail::WaitingSurfels waiting;
        std::uint32_t index = tree.root;
        while (index != SurfelHit::none) {
            const SurfelNode& node = tree.nodes[index];
            const Vec3 to_centre = node.centre - origin;
            const bool below = detail::lies_below(tree, index, normal, to_centre,
                                                  detail::padded_radius(node, to_centre));
            if (!below && !node.is_leaf() && !detail::stops_at(tree, index, point, sine2)) {
                waiting.push(node.right, 0.0f);
                ++index;
                continue;
            }
            if (!below) draw_node(tree, index, point);
            index = waiting.pop(0.0f);
        }
    }

 private:
    /// Texels from `first` to `last` on an axis.
    struct Span {
        std::uint32_t first;
        std::uint32_t last;
    };

    template <Space S>
    MIR_HD void draw_node(const SurfelTreeView<S>& tree, std::uint32_t index, SurfelRay ray) {
        const SurfelNode& node = tree.nodes[index];
        const Vec3 to_centre = node.centre - ray.origin;
        const float radius = detail::padded_radius(node, to_centre);
        const float distance = glm::length(to_centre);
        Span x{0, side_ - 1};
        Span y = x;
        if (radius < distance) {
            const Vec3 w = frame_.to_local(to_centre / distance);
            // Directions that meet the sphere lie at most this chord away: 2 sin(a / 2), sin a = s.
            const float s = radius / distance;
            const float chord = s * sqrtf(2.0f / (1.0f + sqrtf(1.0f - s * s)));
            const Vec2 centre = disc_to_square({w.x, w.y});
            x = covered(centre.x, chord);
            y = covered(centre.y, chord);
        }
        for (std::uint32_t j = y.first; j <= y.last; ++j)
            for (std::uint32_t i = x.first; i <= x.last; ++i) {
                const std::uint32_t texel = j * side_ + i;
                ray.direction = direction_[texel];
                detail::meet_disc(tree, index, ray, hit_[texel]);
            }
    }

    /// Texels whose place in the unit square may lie as far from `centre` as a chord leads. The
    /// map from the disc to [-1, 1]^2 lengthens no way more than sqrt(1 + (pi/4)^2) 4 / pi < 1.62
    /// times on an axis, that to the unit square by half; some of a texel is added for rounding.
    [[nodiscard]] MIR_HD Span covered(float centre, float chord) const {
        const auto texels = static_cast<float>(side_);
        const float reach = 0.81f * chord + 1e-4f;
        const float last = texels - 1.0f;
        const float low = smaller(larger((centre - reach) * texels - 1.0f, 0.0f), last);
        const float high = smaller(larger((centre + reach) * texels, 0.0f), last);
        return {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high)};
    }

    /// Inverse of square_to_disc(); of points outside of the disc, that of their direction.
    [[nodiscard]] MIR_HD static Vec2 disc_to_square(Vec2 p) {
        const float r = smaller(sqrtf(glm::dot(p, p)), 1.0f);
        if (r == 0.0f) return {0.5f, 0.5f};
        const bool wide = fabsf(p.x) > fabsf(p.y);
        const float share = 4.0f * inv_pi * atanf(wide ? p.y / p.x : p.x / p.y);
        const float a = wide ? copysignf(r, p.x) : copysignf(r, p.y) * share;
        const float b = wide ? copysignf(r, p.x) * share : copysignf(r, p.y);
        return {0.5f * (a + 1.0f), 0.5f * (b + 1.0f)};
    }

    std::uint32_t side_;
    Frame frame_;
    Vec3 direction_[largest_side * largest_side];
    SurfelHit hit_[largest_side * largest_side];
};

}  // namespace mir
