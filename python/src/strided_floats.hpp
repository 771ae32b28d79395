// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"
#include "mir/core/math.hpp"

#include <cstddef>
#include <cstdint>

namespace mirpy {

/// Floats of an array where its owner keeps them, for kernels. A view.
struct StridedFloats {
    const float* data = nullptr;   ///< null: there is no array
    std::int64_t strides[3] = {};  ///< of each axis, in floats

    /// False where there is no array.
    [[nodiscard]] MIR_HD bool exists() const { return data != nullptr; }
    /// An element: not checked.
    [[nodiscard]] MIR_HD float at(std::size_t i, std::size_t j = 0, std::size_t k = 0) const {
        return data[static_cast<std::int64_t>(i) * strides[0] +
                    static_cast<std::int64_t>(j) * strides[1] +
                    static_cast<std::int64_t>(k) * strides[2]];
    }
    /// Row i of (n, 3).
    [[nodiscard]] MIR_HD mir::Vec3 row(std::size_t i) const {
        return {at(i, 0), at(i, 1), at(i, 2)};
    }
    /// Pixel of (h, w, 3).
    [[nodiscard]] MIR_HD mir::Vec3 pixel(std::size_t y, std::size_t x) const {
        return {at(y, x, 0), at(y, x, 1), at(y, x, 2)};
    }
};

}  // namespace mirpy
