// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/core/ray.hpp"

#include <cstdint>
#include <cstring>

namespace mir {

/// Numbers that a ray decides by: a function of its bits. Whoever traces a ray so follows it to the
/// same end: luxels, probes of the image, paths from the camera and kernels. A small value.
class RayNumbers {
 public:
    /// Begins with `first`, or with a number of `ray` where that is negative.
    MIR_HD explicit RayNumbers(const Ray& ray, float first = -1.0f)
        : first_(first),
          random_(pair(ray.direction.x, ray.direction.y), Stream::specular_chain,
                  pair(ray.direction.z, ray.origin.x) ^
                      pair(ray.origin.y, ray.origin.z) * 0x9E3779B97F4A7C15ull) {}

    /// The next number, in [0, 1).
    MIR_HD float next() {
        const float own = random_.next();
        const float number = first_ >= 0.0f ? first_ : own;
        first_ = -1.0f;
        return number;
    }

 private:
    [[nodiscard]] MIR_HD static std::uint64_t pair(float a, float b) {
        std::uint32_t high = 0, low = 0;
        memcpy(&high, &a, sizeof high);
        memcpy(&low, &b, sizeof low);
        return std::uint64_t{high} << 32 | low;
    }

    float first_;
    Random random_;
};

}  // namespace mir
