// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/core/strict_float.hpp"
#include "mir/micro/surfel_traverse.hpp"
#include "mir/micro/texel_reach.hpp"

namespace mir::detail {

/// What becomes of a node in a walk for one point or for some.
enum class Fate {
    passed_by,  ///< nothing of it is seen
    opened,     ///< its children are looked at
    ended,      ///< it is seen as a whole, or is a leaf
    unsure      ///< to be told for each point
};

/// Points close to each other that look at the same nodes, as two balls. One is around the points
/// and one around their normals; they tell of a node what holds for all points. Whatever is
/// rounded, it errs on one side: all slack is at least eight times what single precision rounds
/// there.
class PointGroup {
 public:
    /// Group of the `points` whose bits are set in `chosen`. MicroPoints stop at nodes of up to
    /// `share` steradians over the density of their texels.
    template <class Point>
    MIR_HD PointGroup(const Point* points, std::uint32_t chosen, float share) {
        float count = 0.0f;
        Vec3 normals(0.0f);
        float least = 1.0f;
        float most = 0.0f;
        each(points, chosen, [&](const Point& p) {
            centre_ += p.origin;
            normals += p.normal;
            count += 1.0f;
            least = smaller(least, cap_sine_squared(share / p.texels.most_density()));
            most = larger(most, cap_sine_squared(share / p.texels.least_density()));
        });
        open_from_ = (1.0f - slack) / sqrtf(most);
        end_from_ = (1.0f + slack) / sqrtf(least);
        centre_ = centre_ / count;
        const Vec3 normal = normals / count;
        normal_ = normal;
        normal2_ = dot(normal, normal);
        float tilt = 0.0f;
        const Point& first = points[LaneGroup::lowest(chosen)];
        each(points, chosen, [&](const Point& p) {
            radius_ = larger(radius_, glm::length(p.origin - centre_));
            tilt = larger(tilt, glm::length(p.normal - normal));
            is_alike_ = is_alike_ && p.texels.is_like(first.texels);
        });
        radius_ = (1.0f + slack) * radius_;
        tilt_ = tilt + slack;
    }

    /// What becomes of a node for all points, where that is sure; never Fate::passed_by.
    [[nodiscard]] MIR_HD Fate fate(const SurfelNode& node) const {
        const Vec3 to_centre = node.centre - centre_;
        const float distance2 = dot(to_centre, to_centre);
        const float distance = root(distance2);
        const float farthest = (1.0f + slack) * distance + radius_;
        // How high the centre is at least above a plane, for its tilt and its point's place.
        const float height = dot(normal_, to_centre) - (tilt_ * farthest + radius_);
        const bool is_above = height > 0.0f;
        if (node.is_leaf()) return is_above ? Fate::ended : Fate::unsure;
        if (!is_above && !reaches_up(node, height, farthest)) return Fate::unsure;
        if (node.radius * open_from_ > farthest) return Fate::opened;
        const Sides sides = sides_of(node, to_centre, distance2, farthest);
        if (sides == Sides::both) return Fate::opened;
        const bool is_small = node.radius * end_from_ < (1.0f - slack) * distance - radius_;
        return is_small && is_above && sides == Sides::one ? Fate::ended : Fate::unsure;
    }

    /// True when reach() for all points covers few more texels than for one. All must have the same
    /// texels, and the ball around the points must be small against the node or, seen from there,
    /// against a texel of `side` x `side`.
    [[nodiscard]] MIR_HD bool is_far(const SurfelNode& node, std::uint32_t side) const {
        const Vec3 to_centre = node.centre - centre_;
        const float small = 64.0f * static_cast<float>(side * side) * radius_ * radius_;
        return is_alike_ && (4.0f * radius_ < node.radius || small < dot(to_centre, to_centre));
    }

    /// What a node may cover of any point's texels, where those are alike. As seen from all points
    /// it lies in a ball that is larger by theirs, seen from their centre.
    template <class Texels>
    [[nodiscard]] MIR_HD TexelReach reach(const Texels& texels, const SurfelNode& node) const {
        const Vec3 to_centre = node.centre - centre_;
        return texels.reach(to_centre, padded_radius(node, to_centre) + radius_);
    }

 private:
    static constexpr float slack = 1e-4f;

    /// Which sides of its discs a node shows to a point, as shows_one_side() sees it.
    enum class Sides { one, both, unsure };

    /// True only when lies_below() is true for no point. The point's plane has the node's centre at
    /// `height` or above it.
    [[nodiscard]] MIR_HD bool reaches_up(const SurfelNode& node, float height,
                                         float farthest) const {
        const float along = dot(normal_, node.axis);
        const float across = root(normal2_ - along * along - slack);
        const float slab = larger(0.0f, fabsf(along) - tilt_) * node.thickness +
                           larger(0.0f, across - tilt_) * node.radius;
        const float least = smaller(slab, (1.0f - slack) * node.radius);
        return height + least > slack * farthest;
    }

    [[nodiscard]] MIR_HD Sides sides_of(const SurfelNode& node, Vec3 to_centre, float distance2,
                                        float farthest) const {
        const float cosine = node.cos_angle;
        if (!(cosine > 0.0f)) return Sides::both;
        const float sine2 = 1.0f - cosine * cosine;
        const float along = dot(node.axis, to_centre);
        const float aside2 = distance2 - along * along;
        // As large and as small as rounding and the points' places let them be.
        const float sine = root(sine2 + 1e-6f);
        const float aside = root(aside2 + 1e-5f * distance2) + radius_;
        const float doubt = node.thickness + sine * node.radius + slack * (farthest + node.radius);
        const float height = (fabsf(along) - radius_) * cosine;
        if (height - doubt > (1.0f + slack) * sine * aside) return Sides::one;
        const float least_sine = (1.0f - slack) * root(sine2 - 1e-6f);
        const float least_aside = larger(0.0f, root(aside2 - 1e-5f * distance2) - radius_);
        const float least_doubt = node.thickness * cosine + least_sine * node.radius;
        const float most_height = (fabsf(along) + radius_) * cosine + slack * farthest;
        const bool is_flat = least_doubt < 0x1p-9f * node.radius;
        return !is_flat && most_height - smaller(least_doubt, node.radius) <
                               (1.0f - slack) * least_sine * least_aside
                   ? Sides::both
                   : Sides::unsure;
    }

    [[nodiscard]] MIR_HD static float dot(Vec3 a, Vec3 b) {
        return loose::mul_add(a.z, b.z, loose::mul_add(a.y, b.y, a.x * b.x));
    }
    [[nodiscard]] MIR_HD static float root(float a) {
        return a > 0.0f ? a * loose::inverse_root(a) : 0.0f;
    }

    template <class Point, class F>
    MIR_HD static void each(const Point* points, std::uint32_t chosen, const F& f) {
        for (std::uint32_t k = 0; chosen >> k != 0; ++k)
            if ((chosen >> k & 1u) != 0) f(points[k]);
    }

    Vec3 centre_{0};
    Vec3 normal_{0};          ///< mean, at most a unit long
    float normal2_ = 0.0f;    ///< square of its length
    float radius_ = 0.0f;     ///< of the ball around the points, metres
    float tilt_ = 0.0f;       ///< of the ball around the normals
    float open_from_ = 0.0f;  ///< nearer than that many radii of a node no point stops there
    float end_from_ = 0.0f;   ///< farther than that many its size stops none
    bool is_alike_ = true;
};

}  // namespace mir::detail
