// SPDX-License-Identifier: MIT
#pragma once

// The only file that includes GLM. nvcc reports a host-only annotation of GLM's defaulted members
// hundreds of times; the diagnostic is silenced around this include and nowhere else.
#if defined(__CUDACC__)
#include <cuda.h>
#pragma nv_diagnostic push
#pragma nv_diag_suppress 20012
#endif
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#if defined(__CUDACC__)
#pragma nv_diagnostic pop
#endif

#include "mir/core/hd.hpp"

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace mir {

using Vec2 = glm::vec2;  ///< two floats
using Vec3 = glm::vec3;  ///< three floats; metres where it is a place
using Vec4 = glm::vec4;  ///< four floats
using Mat3 = glm::mat3;  ///< 3 x 3 floats, column by column
using Mat4 = glm::mat4;  ///< 4 x 4 floats, column by column

/// Three doubles: places in the world before an origin is chosen (Scene::origin).
using DVec3 = glm::dvec3;
/// 4 x 4 doubles, column by column: placements before an origin is chosen.
using DMat4 = glm::dmat4;

// Host and device code exchange these types as bytes.
static_assert(sizeof(Vec3) == 12 && alignof(Vec3) == 4);
static_assert(std::is_trivially_copyable_v<Vec3> && std::is_trivially_copyable_v<Mat4>);

inline constexpr float pi = 3.14159265358979323846f;      ///< of a circle
inline constexpr float inv_pi = 0.31830988618379067154f;  ///< 1 / pi

/// Larger and smaller of two numbers, `b` when they cannot be compared. Plain selects: unlike fmaxf
/// they are one instruction in vectorised loops and equal in bits on every backend.
MIR_HD constexpr float larger(float a, float b) { return a > b ? a : b; }
/// See larger().
MIR_HD constexpr float smaller(float a, float b) { return a < b ? a : b; }

/// True when `x` is neither NaN nor infinite.
MIR_HD constexpr bool is_finite(double x) { return x - x == 0.0; }

/// Largest absolute component. Same unit as `v`.
MIR_HD inline float max_abs(Vec3 v) { return larger(fabsf(v.x), larger(fabsf(v.y), fabsf(v.z))); }

/// Squared Euclidean length.
MIR_HD inline float length_squared(Vec3 v) { return glm::dot(v, v); }

/// True when no component is NaN or infinite.
inline bool is_finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace mir
