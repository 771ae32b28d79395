// SPDX-License-Identifier: MIT
#pragma once

#include "support/shafts/cluster_key.hpp"

#include <cmath>

namespace mir::detail {

/// How keys scatter, as they are added.
class KeyScatter {
 public:
    /// Keys count from `origin`, which should lie among them: sums of squares of far ones have no
    /// digits left.
    explicit KeyScatter(const ClusterKey& origin) : origin_(origin) {}

    void add(const ClusterKey& key) {
        Vector d{};
        for (std::size_t k = 0; k < size; ++k) d[k] = double{key[k]} - double{origin_[k]};
        for (std::size_t i = 0; i < size; ++i) {
            sums_[i] += d[i];
            for (std::size_t k = 0; k <= i; ++k) products_[i][k] += d[i] * d[k];
        }
        ++count_;
    }

    /// Unit direction in which they scatter most, roughly: by powers of the covariance. Zero where
    /// all are one. At least one was added.
    [[nodiscard]] ClusterKey principal_axis() const {
        // What has not settled by then lies between directions in which they scatter alike.
        constexpr int rounds = 30;
        const Matrix spread = covariance();
        std::size_t widest = 0;
        for (std::size_t k = 1; k < size; ++k)
            if (spread[k][k] > spread[widest][widest]) widest = k;
        Vector axis = spread[widest];
        for (int i = 0; i < rounds && normalise(axis); ++i) axis = product(spread, axis);
        normalise(axis);
        ClusterKey rounded{};
        for (std::size_t k = 0; k < size; ++k) rounded[k] = static_cast<float>(axis[k]);
        return rounded;
    }

 private:
    static constexpr std::size_t size = std::tuple_size_v<ClusterKey>;
    using Vector = std::array<double, size>;
    using Matrix = std::array<Vector, size>;

    [[nodiscard]] Matrix covariance() const {
        Matrix c{};
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t k = 0; k <= i; ++k)
                c[i][k] = c[k][i] = products_[i][k] - sums_[i] * sums_[k] / count_;
        return c;
    }
    [[nodiscard]] static Vector product(const Matrix& m, const Vector& v) {
        Vector result{};
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t k = 0; k < size; ++k) result[i] += m[i][k] * v[k];
        return result;
    }
    /// False, and a zero vector, where it has no length.
    static bool normalise(Vector& v) {
        double squared = 0.0;
        for (const double x : v) squared += x * x;
        const bool has_length = squared > 0.0;
        for (double& x : v) x = has_length ? x / std::sqrt(squared) : 0.0;
        return has_length;
    }

    ClusterKey origin_;
    Vector sums_{};
    Matrix products_{};  ///< below the diagonal and on it
    double count_ = 0.0;
};

}  // namespace mir::detail
