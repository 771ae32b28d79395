// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <array>

namespace mir::builtin {

// The car's frame: x to its left seen from the front, y up from the ground, nose towards -z, origin
// on the ground midway between the axles; metres.

inline constexpr float car_axle = 1.32f;           ///< z of the rear axle, -z of the front one
inline constexpr float car_wheel_height = 0.335f;  ///< y of the axles

/// Smooth hill of height 1 at t = 0 that ends at |t| = 1.
inline float hill(float t) {
    const float inside = larger(0.0f, 1.0f - t * t);
    return inside * inside;
}

/// t^4.
inline float fourth(float t) { return t * t * t * t; }

/// The car below its windows: a superellipsoid of exponent 4. Its top follows the line of bonnet
/// and boot. Swells over the wheels, is creased below the windows and drawn in above the sills.
struct LowerHull {
    /// Below 0 inside, above 0 outside, about linear along rays from the inside.
    float operator()(Vec3 p) const {
        const float waist = 0.56f;
        const float height = p.y > waist ? deck(p.x, p.z) - waist : waist + 0.3f;
        const float sum = fourth(p.x / half_width(p.y, p.z)) + fourth(p.z / 2.22f) +
                          fourth((p.y - waist) / height);
        return std::sqrt(std::sqrt(sum)) - 1.0f;
    }

 private:
    static float half_width(float y, float z) {
        float w = 0.915f + 0.018f * hill((y - 0.76f) / 0.08f) -
                  0.035f * hill((y - 0.44f) / 0.2f) * hill(z / 1.1f);
        for (const float axle : {-car_axle, car_axle}) {
            const float distance = std::sqrt((z - axle) * (z - axle) +
                                             (y - car_wheel_height) * (y - car_wheel_height));
            w += 0.03f * hill((distance - 0.38f) / 0.16f);
        }
        return w;
    }

    /// Height of the middle line before it is rounded off towards the ends. It has two folds along
    /// the bonnet.
    static float deck(float x, float z) {
        static constexpr std::array<float, 11> height{0.80f,  0.86f,  0.92f, 0.955f, 0.98f, 0.985f,
                                                      0.985f, 0.985f, 1.0f,  1.03f,  1.01f};
        const float t = larger(0.0f, smaller(9.999f, (z + 2.5f) * 2.0f));
        const auto i = static_cast<std::size_t>(t);
        const float f = t - static_cast<float>(i);
        const float s = f * f * (3.0f - 2.0f * f);
        const float along = height[i] + s * (height[i + 1] - height[i]);
        return along + 0.018f * hill((std::fabs(x) - 0.38f) / 0.16f) * hill((z + 1.4f) / 0.9f);
    }
};

/// The windows' hull: narrower towards the roof, with raked ends.
struct CabinHull {
    /// As LowerHull: below 0 inside, above 0 outside.
    float operator()(Vec3 p) const {
        const float up = p.y - 0.9f;
        const float front = -0.88f + 1.55f * up;
        const float rear = 1.66f - 1.45f * up;
        const float top = (p.y - 0.75f) / 0.62f;
        const float sum = fourth(p.x / (0.79f - 0.30f * up)) +
                          fourth((p.z - 0.5f * (front + rear)) / (0.5f * (rear - front))) +
                          fourth(top) * top * top;
        return std::sqrt(std::sqrt(sum)) - 1.0f;
    }
};

/// Box with rounded corners inside a hull, from which its surface is seen. Every point of the
/// surface has one coordinate `a` around the box (z along the side +x, then around the ends to the
/// other side) and one coordinate `b` upwards (y up to the box' top, then over its edge).
struct Core {
    float half_width = 0.0f;  ///< x of the sides, metres
    float front = 0.0f;       ///< z
    float rear = 0.0f;        ///< z
    float top = 0.0f;         ///< y

    static constexpr float turn = 0.4f;                ///< metres of `a` per radian at a corner
    static constexpr float roll = 0.3f;                ///< metres of `b` per radian at the top
    static constexpr float corner = 0.5f * pi * turn;  ///< `a` from side to end

    /// `a` in the middle of the nose or the tail.
    [[nodiscard]] float nose() const { return front - corner - half_width; }
    /// The same at the other end.
    [[nodiscard]] float tail() const { return rear + corner + half_width; }
    /// `b` where a point is straight above the box.
    [[nodiscard]] float above() const { return top + 0.5f * pi * roll; }

    /// Where the ray of (a, b) starts and, as unit vector, goes.
    [[nodiscard]] std::array<Vec3, 2> ray(Vec2 ab) const {
        float a = ab.x;
        float side = 1.0f;
        if (a < nose() || a > tail()) {
            a = (a < nose() ? 2.0f * nose() : 2.0f * tail()) - a;
            side = -1.0f;
        }
        const float z = larger(front, smaller(rear, a));
        const float past = larger(0.0f, larger(front - a, a - rear));
        const float angle = smaller(past / turn, 0.5f * pi);
        const float x = half_width - larger(0.0f, past - corner);
        const float end = a < front ? -1.0f : 1.0f;
        const Vec3 out(side * std::cos(angle), 0.0f, end * std::sin(angle));
        const float lift = larger(0.0f, (ab.y - top) / roll);
        return {Vec3(side * x, smaller(ab.y, top), z),
                std::cos(lift) * out + Vec3(0.0f, std::sin(lift), 0.0f)};
    }
};

inline constexpr Core lower_core{0.66f, -1.98f, 1.9f, 0.66f};  ///< of the body
inline constexpr Core cabin_core{0.42f, -0.1f, 0.85f, 1.22f};  ///< of the cabin

/// Where the ray from `origin`, inside the hull, along the unit vector `direction` leaves it. At
/// most 2 m away. Regula falsi (Illinois): a fixed number of steps, so that bits do not depend on
/// tolerances.
template <class Hull>
Vec3 surface_along(const Hull& hull, Vec3 origin, Vec3 direction) {
    float inside = 0.0f;
    float outside = 2.0f;
    float f_inside = hull(origin);
    float f_outside = hull(origin + outside * direction);
    float t = 0.0f;
    int last = 0;
    for (int step = 0; step < 12; ++step) {
        t = (inside * f_outside - outside * f_inside) / (f_outside - f_inside);
        const float f = hull(origin + t * direction);
        const int side = f > 0.0f ? 1 : -1;
        (side > 0 ? outside : inside) = t;
        (side > 0 ? f_outside : f_inside) = f;
        // The end that stays twice in a row is what makes plain regula falsi slow.
        if (side == last) (side > 0 ? f_inside : f_outside) *= 0.5f;
        if (f == 0.0f) break;
        last = side;
    }
    return origin + t * direction;
}

}  // namespace mir::builtin
