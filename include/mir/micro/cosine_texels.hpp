// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/strict_float.hpp"
#include "mir/core/warp.hpp"
#include "mir/micro/texel_reach.hpp"

namespace mir {

/// Texels of a micro-buffer of equal projected solid angle around a normal. They are those of the
/// unit square under square_to_cosine_hemisphere(). Host and device.
class CosineTexels {
 public:
    /// Whether the left and the right border of the square are one.
    static constexpr bool goes_around = false;

    /// Around +z.
    CosineTexels() = default;
    /// `normal` is a unit vector.
    MIR_HD explicit CosineTexels(Vec3 normal) : frame_(Frame::around(normal)) {}

    /// True when the same places of the square are the same directions.
    [[nodiscard]] MIR_HD bool is_like(const CosineTexels& other) const {
        return frame_.normal == other.frame_.normal;
    }
    /// Unit, in the world.
    [[nodiscard]] MIR_HD Vec3 direction(Vec2 u) const {
        return frame_.to_world(square_to_cosine_hemisphere(u));
    }
    /// Of directions, per steradian.
    [[nodiscard]] MIR_HD float density(Vec3 wi) const {
        return cosine_hemisphere_pdf(glm::dot(wi, frame_.normal));
    }
    /// The largest one at the zenith: nodes may be no larger than the smallest texel.
    [[nodiscard]] MIR_HD float largest_density(const SeenSphere&) const { return inv_pi; }
    /// What largest_density() is at least, of any sphere.
    [[nodiscard]] MIR_HD float least_density() const { return inv_pi; }
    /// And at most.
    [[nodiscard]] MIR_HD float most_density() const { return inv_pi; }

    /// Of directions that meet a sphere whose centre is `to_centre` away. Its cap of the
    /// hemisphere, seen from above, lies in a sector of a ring: between sin(theta - alpha) and
    /// sin(theta + alpha), theta the angle of its centre to the normal and alpha the sphere's, over
    /// 2 asin(sin(alpha) / sin(theta)) of azimuth. The map of the disc to the square keeps rings
    /// and turns azimuth into a share of their sides.
    [[nodiscard]] MIR_HD TexelReach reach(Vec3 to_centre, float radius) const {
        const float share = loose::inverse_root(dot(to_centre, to_centre));
        const float sine = radius * share;
        if (!(sine < 0.999f)) return {};
        const Vec3 w =
            share * Vec3(dot(to_centre, frame_.tangent), dot(to_centre, frame_.bitangent),
                         dot(to_centre, frame_.normal));
        const float cosine = root(1.0f - sine * sine);
        const float across = root(loose::mul_add(w.x, w.x, w.y * w.y));
        if (w.z * cosine + across * sine < -margin) return TexelReach::none();
        const bool to_horizon = !(w.z * cosine > across * sine);
        const float high = to_horizon ? 1.0f : loose::mul_add(w.z, sine, across * cosine);
        const float low = loose::mul_add(-w.z, sine, across * cosine);
        // Around the zenith, or below it around the nadir.
        if (!(low > 0.0f) || !(sine < across) || across < margin)
            return around({0.0f, 0.0f}, {high, high});
        return sector({w.x, w.y}, {low, high}, sine * loose::reciprocal(across));
    }

 private:
    /// For the approximations in reach(), asin() and atan() above all, and rounded
    /// directions.
    static constexpr float margin = 2e-4f;

    [[nodiscard]] MIR_HD static float dot(Vec3 a, Vec3 b) {
        return loose::mul_add(a.z, b.z, loose::mul_add(a.y, b.y, a.x * b.x));
    }
    [[nodiscard]] MIR_HD static float root(float a) {
        return a > 1e-12f ? a * loose::inverse_root(a) : 1e-6f;
    }
    /// (4 / pi) atan(q) for q from -1 to 1, to 1.1e-4. Least squares, weighted until errors were
    /// alike.
    [[nodiscard]] MIR_HD static float eighths(float q) {
        const float q2 = q * q;
        float sum = loose::mul_add(-0.0496390f, q2, 0.1862294f);
        sum = loose::mul_add(sum, q2, -0.4089325f);
        return q * loose::mul_add(sum, q2, 1.2722385f);
    }

    /// The square around `centre` -+ `half`, both of [-1, 1]^2.
    [[nodiscard]] MIR_HD static TexelReach around(Vec2 centre, Vec2 half) {
        const Vec2 middle{loose::mul_add(0.5f, centre.x, 0.5f),
                          loose::mul_add(0.5f, centre.y, 0.5f)};
        const Vec2 extent{loose::mul_add(0.5f, half.x, margin),
                          loose::mul_add(0.5f, half.y, margin)};
        return {middle - extent, middle + extent};
    }

    /// Rectangle around the sector of radii ring.x to ring.y. Its azimuth is that of `p` -+
    /// asin(`sine`). With t = 4 / pi times the azimuth from the nearest axis, that axis has a
    /// radius's share 1 up to |t| = 1 and 2 - |t| behind, up to 3, and the other t, up to 1.
    [[nodiscard]] MIR_HD static TexelReach sector(Vec2 p, Vec2 ring, float sine) {
        const bool wide = fabsf(p.x) > fabsf(p.y);
        const float main = wide ? p.x : p.y;
        const float t = eighths((wide ? p.y : p.x) * loose::reciprocal(main));
        // asin x is at most x + (pi / 2 - 1) x^3.
        const float turn = 4.0f * inv_pi * sine * loose::mul_add(0.5708f * sine, sine, 1.0f);
        const float share = smaller(1.0f, 2.0f - (fabsf(t) + turn));
        const float least = share * (share > 0.0f ? ring.x : ring.y);
        const float first = larger(t - turn, -1.0f);
        const float last = smaller(t + turn, 1.0f);
        const float low = first * (first > 0.0f ? ring.x : ring.y);
        const float high = last * (last > 0.0f ? ring.y : ring.x);
        const float sign = copysignf(0.5f, main);
        const Vec2 centre = sign * Vec2(least + ring.y, low + high);
        const Vec2 half = 0.5f * Vec2(ring.y - least, high - low);
        return wide ? around(centre, half) : around({centre.y, centre.x}, {half.y, half.x});
    }

    Frame frame_;
};

}  // namespace mir
