// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/core/space.hpp"

#include <cstdint>

namespace mir {

/// Who asks a LightTree for a lamp: a place and the sides on which light is reflected there.
struct LightReceiver {
    Vec3 position{0};   ///< metres
    Vec3 shading{0};    ///< unit normal; light from behind it is not reflected
    Vec3 geometric{0};  ///< unit normal; nor is light from behind this one
};

/// A node of a LightTree: a sphere around lamps and a cone around their directions.
struct LightNode {
    Vec3 centre{0};             ///< of the sphere, metres
    float radius = 0.0f;        ///< of the sphere, metres
    Vec3 axis{0, 0, 1};         ///< of the cone, unit
    float cos_spread = 1.0f;    ///< of theta_o: normals lie so near to the axis
    float sin_spread = 0.0f;    ///< of theta_o
    float cos_emission = 0.0f;  ///< of theta_e: so far from its normal each lamp shines
    float share = 1.0f;         ///< of the power of both children of its parent
    std::uint32_t link = 0;     ///< see the bits below

    static constexpr std::uint32_t leaf_bit = 0x80000000u;    ///< the rest is the lamp
    static constexpr std::uint32_t double_bit = 0x40000000u;  ///< the axis counts both ways
    static constexpr std::uint32_t rest_bits = 0x3FFFFFFFu;   ///< lamp, or first of two children

    /// True when it is one lamp.
    [[nodiscard]] MIR_HD bool is_leaf() const { return (link & leaf_bit) != 0; }
    /// True when lamps shine along -axis as along axis.
    [[nodiscard]] MIR_HD bool is_double() const { return (link & double_bit) != 0; }
    /// Index of the lamp, or of the first child, whose neighbour is the second one.
    [[nodiscard]] MIR_HD std::uint32_t rest() const { return link & rest_bits; }

    /// What two computations of a cosine may differ by, and the least that one counts as.
    static constexpr float slack = 0x1p-10f;

    /// The importance measure of the paper without power: |cos theta_i'| cos theta' / d^2. It is
    /// 0 only where no lamp of the node can light the receiver: theta_i' and theta' are the least
    /// angles that the sphere and the cone leave. m^-2.
    [[nodiscard]] MIR_HD float importance(const LightReceiver& at) const;
};

/// A lamp that a LightTree chose.
struct LightPick {
    static constexpr std::uint32_t none = 0xFFFFFFFFu;  ///< light: nothing can light the receiver

    std::uint32_t light = none;  ///< as LightTable counts
    double probability = 1.0;    ///< of this choice for this receiver

    /// True when there is a lamp.
    [[nodiscard]] MIR_HD bool is_found() const { return light != none; }
};

/// A LightTree as kernels read it. A view; thread-safe.
template <Space S>
struct LightTreeView {
    static constexpr Space space = S;  ///< where the nodes lie

    const LightNode* nodes = nullptr;  ///< the root first
    std::uint32_t size = 0;            ///< nodes

    /// True without lamps.
    [[nodiscard]] MIR_HD bool empty() const { return size == 0; }

    /// Probability of the first of a node's two children, or -1 if neither can light the receiver.
    [[nodiscard]] MIR_HD float chance_of_first(const LightNode& node,
                                               const LightReceiver& at) const;

    /// The lamp that a number in [0, 1) chooses: one walk from the root. The number is stretched
    /// at each step, so that numbers spread evenly stay so. Must not be empty().
    [[nodiscard]] MIR_HD LightPick pick(const LightReceiver& at, double u) const;
};

namespace detail {

/// cos max(a - b, 0) of two angles in [0, pi].
MIR_HD inline float cosine_of_rest(float cos_a, float sin_a, float cos_b, float sin_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
/// sin max(a - b, 0) of two angles in [0, pi].
MIR_HD inline float sine_of_rest(float cos_a, float sin_a, float cos_b, float sin_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}
/// Sine of an angle in [0, pi].
MIR_HD inline float sine_of(float cosine) { return sqrtf(larger(1.0f - cosine * cosine, 0.0f)); }

}  // namespace detail

MIR_HD inline float LightNode::importance(const LightReceiver& at) const {
    const Vec3 to = centre - at.position;
    const float r2 = radius * radius;
    // The least square whose inverse, times 1, is a float.
    const float d2 = larger(length_squared(to), 0x1p-120f);
    // Inside the sphere nothing is known of angles.
    if (!(d2 > r2)) return 1.0f / r2;
    const float inverse = 1.0f / sqrtf(d2);
    const Vec3 w = to * inverse;
    const float sin_u = radius * inverse;
    const float cos_u = detail::sine_of(sin_u);
    const float cos_g = glm::dot(w, at.geometric);
    const float cos_s = glm::dot(w, at.shading);
    // Behind a plane: further from its normal than a right angle and the sphere's own angle.
    if (smaller(cos_g, cos_s) < -sin_u - slack) return 0.0f;
    const float received = detail::cosine_of_rest(cos_s, detail::sine_of(cos_s), cos_u, sin_u);

    const float along = -glm::dot(w, axis);
    const float cosine = is_double() ? fabsf(along) : along;
    const float sine = detail::sine_of(cosine);
    const float cos_x = detail::cosine_of_rest(cosine, sine, cos_spread, sin_spread);
    const float sin_x = detail::sine_of_rest(cosine, sine, cos_spread, sin_spread);
    const float emitted = detail::cosine_of_rest(cos_x, sin_x, cos_u, sin_u);
    if (emitted < cos_emission - slack) return 0.0f;
    return larger(received, slack) * larger(emitted, slack) / d2;
}

template <Space S>
MIR_HD float LightTreeView<S>::chance_of_first(const LightNode& node,
                                               const LightReceiver& at) const {
    const LightNode& first = nodes[node.rest()];
    const LightNode& second = nodes[node.rest() + 1];
    const float a = first.importance(at);
    const float b = second.importance(at);
    if (!(a > 0.0f)) return b > 0.0f ? 0.0f : -1.0f;
    if (!(b > 0.0f)) return 1.0f;
    // What can light the receiver keeps a chance, whatever rounds to zero.
    constexpr float least = 0x1p-16f;
    const float chance = first.share * a / (first.share * a + second.share * b);
    return smaller(larger(chance, least), 1.0f - least);
}

template <Space S>
MIR_HD LightPick LightTreeView<S>::pick(const LightReceiver& at, double u) const {
    LightPick pick;
    const LightNode* node = nodes;
    while (!node->is_leaf()) {
        const float chance = chance_of_first(*node, at);
        if (chance < 0.0f) return pick;
        const double p = static_cast<double>(chance);
        const bool is_first = u < p;
        const double own = is_first ? p : 1.0 - p;
        u = (is_first ? u : u - p) / own;
        u = u < 1.0 ? u : 1.0 - 0x1p-53;
        pick.probability *= own;
        node = nodes + node->rest() + (is_first ? 0 : 1);
    }
    pick.light = node->rest();
    return pick;
}

}  // namespace mir
