// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace mir::detail {

/// By what luxels are told apart: position and weighted normal, metres. Also a direction among such
/// keys.
using ClusterKey = std::array<float, 6>;

/// Component of a key along a direction.
inline float key_along(const ClusterKey& key, const ClusterKey& direction) {
    float sum = 0.0f;
    for (std::size_t k = 0; k < key.size(); ++k) sum += key[k] * direction[k];
    return sum;
}

/// Box around keys.
class KeyBox {
 public:
    explicit KeyBox(const ClusterKey& first) : low_(first), high_(first) {}

    void add(const ClusterKey& key) {
        for (std::size_t k = 0; k < key.size(); ++k) {
            low_[k] = std::min(low_[k], key[k]);
            high_[k] = std::max(high_[k], key[k]);
        }
    }
    /// Sum of its extents, metres.
    [[nodiscard]] float size() const {
        float sum = 0.0f;
        for (std::size_t k = 0; k < low_.size(); ++k) sum += high_[k] - low_[k];
        return sum;
    }

 private:
    ClusterKey low_;
    ClusterKey high_;
};

}  // namespace mir::detail
