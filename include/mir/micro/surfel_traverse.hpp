// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/gather_options.hpp"
#include "mir/micro/solid_angle.hpp"
#include "mir/micro/surfel_ray.hpp"
#include "mir/micro/surfel_tree_view.hpp"

namespace mir {

namespace detail {

/// Length with every rounding of the tests below inside, for a node at `to_centre`. 64 units of
/// rounding of the distances that they are made of.
MIR_HD inline float padded_radius(const SurfelNode& node, Vec3 to_centre) {
    const float distance = fabsf(to_centre.x) + fabsf(to_centre.y) + fabsf(to_centre.z);
    return node.radius + 0x1p-18f * (distance + node.radius);
}

/// True when the tangent plane lets a disc be met: its centre is not below.
MIR_HD inline bool is_above(const SurfelRay& ray, Vec3 to_centre) {
    return glm::dot(ray.normal, to_centre) >= 0.0f;
}

/// True when nothing below a node is above a tangent plane. The plane is that of `normal` through
/// the point that the node's centre is `to_centre` away from; never true of what a ray above the
/// plane may meet. The sphere is asked first. Most nodes that it cuts belong to the wall that
/// gathers, whose discs lie in the plane: they are in a slab across the axis, whose extent along
/// the plane's normal is |cos| thickness + sin radius.
MIR_HD inline bool lies_below(const SurfelNode& node, Vec3 normal, Vec3 to_centre, float padded) {
    const float height = glm::dot(normal, to_centre);
    if (height < -padded) return true;
    if (!(height < 0.0f) || normal == Vec3(0.0f)) return false;
    const float cosine = glm::dot(normal, node.axis);
    const float sine = glm::length(glm::cross(normal, node.axis));
    const float pad = padded - node.radius;
    return height + fabsf(cosine) * node.thickness + sine * node.radius < -pad;
}

/// Takes a hit when it is nearer, or as near at a lower index.
MIR_HD inline void take_nearer(SurfelHit& hit, float t, std::uint32_t node, bool front) {
    if (t < hit.t || (t == hit.t && node < hit.node)) hit = {t, node, front};
}

/// True when a leaf's disc is met `off` away from its centre. `cosine` is that of the ray and the
/// normal. The edges of a piece are padded by the rounding of that place, which grows as the ray
/// grazes, and by that of the centre: no ray passes between two pieces. A ray below the tangent
/// plane, where shading normals may lead one, meets nothing above it, and no light enters there.
MIR_HD inline bool meets_piece(const Surfel& disc, Vec3 to_centre, Vec3 off, float cosine,
                               const SurfelRay& ray) {
    if (disc.is_whole()) return is_above(ray, to_centre);
    if (glm::dot(ray.normal, ray.direction) < 0.0f) return false;
    const Vec3 p = disc.position;
    const float distance = fabsf(to_centre.x) + fabsf(to_centre.y) + fabsf(to_centre.z);
    const float from_origin = fabsf(p.x) + fabsf(p.y) + fabsf(p.z);
    const float rounding = 0x1p-18f * (distance + disc.radius) + 0x1p-22f * from_origin;
    return disc.in_piece(off, rounding / fabsf(cosine));
}

/// A node as a disc of its radius across its axis. It holds what all rays from one point share that
/// meet it: of a leaf, the disc itself, as far as it lies in its piece.
struct SeenDisc {
    Vec3 to_centre{0};                       ///< from the point, metres
    float radius2 = 0.0f;                    ///< square of the radius, square metres
    Vec3 axis{0, 0, 1};                      ///< unit
    float height = 0.0f;                     ///< of the centre along the axis, metres
    std::uint32_t surfel = SurfelHit::none;  ///< of a leaf
    std::uint32_t node = SurfelHit::none;    ///< index of the node

    SeenDisc() = default;
    /// `n` is what lies at `index`, or a copy of it.
    MIR_HD SeenDisc(const SurfelNode& n, std::uint32_t index, Vec3 origin)
        : to_centre(n.centre - origin),
          radius2(n.radius * n.radius),
          axis(n.axis),
          height(glm::dot(n.axis, to_centre)),
          surfel(n.is_leaf() ? n.first : SurfelHit::none),
          node(index) {}

    /// Where a ray meets it.
    struct Meeting {
        float t;       ///< distance, metres; 0: nowhere
        float cosine;  ///< of the ray and the axis
    };

    /// The ray starts at the point.
    template <Space S>
    [[nodiscard]] MIR_HD Meeting meet(const SurfelTreeView<S>& tree, const SurfelRay& ray) const {
        const float cosine = glm::dot(axis, ray.direction);
        const float t = height / cosine;
        const Vec3 off_centre = t * ray.direction - to_centre;
        if (!(t > 0.0f && length_squared(off_centre) <= radius2)) return {0.0f, cosine};
        const bool met = surfel == SurfelHit::none ||
                         meets_piece(tree.surfels[surfel], to_centre, off_centre, cosine, ray);
        return {met ? t : 0.0f, cosine};
    }
};

/// Meets the disc of a node that is not passed by as a whole.
template <Space S>
MIR_HD void meet_disc(const SurfelTreeView<S>& tree, const SurfelNode& node, std::uint32_t index,
                      const SurfelRay& ray, SurfelHit& hit) {
    const SeenDisc disc(node, index, ray.origin);
    if (!node.is_leaf() && !is_above(ray, disc.to_centre)) return;
    const SeenDisc::Meeting at = disc.meet(tree, ray);
    if (at.t > 0.0f) take_nearer(hit, at.t, index, at.cosine < 0.0f);
}

/// Meets the node's sphere from outside.
MIR_HD inline void meet_sphere(const SurfelNode& node, std::uint32_t index, const SurfelRay& ray,
                               SurfelHit& hit) {
    const Vec3 to_centre = node.centre - ray.origin;
    const float along = glm::dot(to_centre, ray.direction);
    const float inside2 =
        node.radius * node.radius - length_squared(to_centre - along * ray.direction);
    if (along > 0.0f && inside2 >= 0.0f && is_above(ray, to_centre))
        take_nearer(hit, along - sqrtf(inside2), index, glm::dot(node.axis, to_centre) < 0.0f);
}

/// True when all discs below a node show the same side to a point. However a normal of its cone is
/// tilted, all of the sphere lies on one side of the plane through the point across that normal.
/// Or, what flat walls seen at a slant need, all of the slab of the discs does. Or the point is so
/// deep in a slab so flat that what is in doubt is less than a thousandth of the node: a wall seen
/// edge-on.
MIR_HD inline bool shows_one_side(const SurfelNode& node, Vec3 to_centre) {
    const float cosine = node.cos_angle;
    if (!(cosine > 0.0f)) return false;
    const float sine2 = larger(0.0f, 1.0f - cosine * cosine);
    // How much nearer to the centre the plane may come because normals are tilted, squared.
    const float tilt2 = sine2 * length_squared(glm::cross(node.axis, to_centre));
    const auto is_beyond_tilt = [tilt2](float x) { return x > 0.0f && x * x > tilt2; };
    const float height = fabsf(glm::dot(node.axis, to_centre)) * cosine;
    const float padded = padded_radius(node, to_centre);
    if (is_beyond_tilt(height - padded)) return true;
    const float doubt =
        node.thickness * cosine + sqrtf(sine2) * node.radius + (padded - node.radius);
    return is_beyond_tilt(height - doubt) || is_beyond_tilt(0x1p-10f * node.radius - doubt);
}

/// True when a ray ends at an inner node. It is not inside, the node's solid angle is not larger
/// than the ray's (`sine2` is its cap_sine_squared()), and it shows one side. As a disc, it is
/// passed by when its centre lies below the tangent plane of `normal`: that is an end for nodes up
/// to an eighth of their distance alone: little of them is above the plane, and that at a slant.
MIR_HD inline bool stops_at(const SurfelNode& node, Vec3 normal, Vec3 to_centre, float sine2) {
    const float distance2 = length_squared(to_centre);
    const float radius2 = node.radius * node.radius;
    if (!(radius2 < distance2) || !(radius2 <= sine2 * distance2)) return false;
    if (glm::dot(normal, to_centre) < 0.0f && radius2 * 64.0f > distance2) return false;
    return shows_one_side(node, to_centre);
}

inline constexpr float never = std::numeric_limits<float>::infinity();

/// Distance from which on a ray may meet discs below a node, or infinity. Never too large: what
/// meet_disc() accepts of a leaf lies, rounding aside, inside the spheres of all nodes above it.
template <Space S>
MIR_HD float entry(const SurfelTreeView<S>& tree, std::uint32_t index, const SurfelRay& ray) {
    const SurfelNode& node = tree.nodes[index];
    const Vec3 to_centre = node.centre - ray.origin;
    const float radius = padded_radius(node, to_centre);
    const float along = glm::dot(to_centre, ray.direction);
    const float inside2 = radius * radius - length_squared(to_centre - along * ray.direction);
    if (!(inside2 >= 0.0f) || lies_below(node, ray.normal, to_centre, radius)) return never;
    const float half = sqrtf(inside2);
    return along + half < 0.0f ? never : along - half;
}

/// Nodes that wait while a walk goes down elsewhere. At most one for each on the way.
struct WaitingSurfels {
    std::uint32_t node[SurfelTreeOptions::depth_limit];
    float near[SurfelTreeOptions::depth_limit];
    std::uint32_t count = 0;

    MIR_HD void push(std::uint32_t n, float t) {
        node[count] = n;
        near[count++] = t;
    }
    /// The last one that may hold something nearer than `t`, or SurfelHit::none.
    MIR_HD std::uint32_t pop(float t) {
        while (count > 0)
            if (near[--count] <= t) return node[count];
        return SurfelHit::none;
    }
};

/// The nearer child that the ray may meet, or SurfelHit::none; the other one waits.
template <Space S>
MIR_HD std::uint32_t descend(const SurfelTreeView<S>& tree, std::uint32_t index,
                             const SurfelRay& ray, float t, WaitingSurfels& waiting) {
    const std::uint32_t left = index + 1;
    const std::uint32_t right = tree.nodes[index].right;
    const float to_left = entry(tree, left, ray);
    const float to_right = entry(tree, right, ray);
    const bool left_first = to_left <= to_right;
    const std::uint32_t first = left_first ? left : right;
    const float near = smaller(to_left, to_right);
    const float far = larger(to_left, to_right);
    if (!(near <= t) || !is_finite(near)) return waiting.pop(t);
    if (far <= t && is_finite(far)) waiting.push(left_first ? right : left, far);
    return first;
}

}  // namespace detail

/// What a ray sees first of the discs of a tree. The nearest disc, or an inner node where the ray's
/// solid angle is not smaller than the node's, whose discs all show it the same side. With a solid
/// angle of 0 it is the nearest disc of all, in every bit, and at equal distances the first in the
/// order of the tree. Where it stops, a node counts as large as its sphere, but only as far as the
/// ray also meets the spheres above it. Nothing is allocated; thread-safe. Source: Ritschel et al.
/// 2009, section 4; cap_solid_angle() instead of its pi r^2 / d^2.
template <Space S>
[[nodiscard]] MIR_HD SurfelHit closest_surfel(const SurfelTreeView<S>& tree, const SurfelRay& ray,
                                              StopShape shape = StopShape::disc) {
    SurfelHit hit;
    if (tree.empty()) return hit;
    const float sine2 = cap_sine_squared(ray.solid_angle);
    detail::WaitingSurfels waiting;
    std::uint32_t index = tree.root;
    while (index != SurfelHit::none) {
        const SurfelNode& node = tree.nodes[index];
        if (!node.is_leaf() &&
            !detail::stops_at(node, ray.normal, node.centre - ray.origin, sine2)) {
            index = detail::descend(tree, index, ray, hit.t, waiting);
            continue;
        }
        if (node.is_leaf() || shape == StopShape::disc)
            detail::meet_disc(tree, node, index, ray, hit);
        else
            detail::meet_sphere(node, index, ray, hit);
        index = waiting.pop(hit.t);
    }
    return hit;
}

/// closest_surfel() of one tree. A functor for host and device; thread-safe.
template <Space S>
struct TreeRays {
    SurfelTreeView<S> tree;             ///< what is seen
    StopShape shape = StopShape::disc;  ///< as what a node is met where a ray stops

    /// What the ray sees first.
    [[nodiscard]] MIR_HD SurfelHit operator()(const SurfelRay& ray) const {
        return closest_surfel(tree, ray, shape);
    }
};

}  // namespace mir
