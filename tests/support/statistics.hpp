// SPDX-License-Identifier: MIT
#pragma once

#include "mir/validation/detail/moments.hpp"
#include "support/quadrature.hpp"
#include "support/special_functions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace mirtest {

/// Level of each of `tests` independent tests that makes a false alarm in any of them as likely as
/// `family` (Sidak 1967).
inline double sidak(double family, std::size_t tests) {
    return -std::expm1(std::log1p(-family) / static_cast<double>(tests));
}

/// Those of the installed checks, of a type that brings the functions below along.
class Moments : public mir::validation::detail::Moments {};

/// p-value of "the mean of what was added is `expected`", two-sided, Student's t. `rounding` is an
/// error of the mean that single precision explains; it is added to the standard error.
inline double mean_p_value(const Moments& m, double expected, double rounding = 0.0) {
    const double error = std::hypot(m.standard_error(), rounding);
    const double difference = m.mean() - expected;
    if (error == 0.0) return difference == 0.0 ? 1.0 : 0.0;
    return student_tails(difference / error, static_cast<double>(m.count() - 1));
}

/// p-value of "both have the same mean", two-sided, for unequal variances (Welch 1947).
inline double welch_p_value(const Moments& a, const Moments& b) {
    const double va = a.variance() / static_cast<double>(a.count());
    const double vb = b.variance() / static_cast<double>(b.count());
    if (va + vb == 0.0) return a.mean() == b.mean() ? 1.0 : 0.0;
    const double dof = (va + vb) * (va + vb) /
                       (va * va / static_cast<double>(a.count() - 1) +
                        vb * vb / static_cast<double>(b.count() - 1));
    return student_tails((a.mean() - b.mean()) / std::sqrt(va + vb), dof);
}

/// Outcome of a chi-square test.
struct ChiSquare {
    double statistic = 0.0;
    int degrees_of_freedom = 0;
    double p_value = 1.0;
    bool hit_impossible_cell = false;  ///< something fell where nothing may: p_value is 0
};

namespace detail {

struct Pool {
    double observed = 0.0;
    double expected = 0.0;
};

/// Joins cells, the largest expectation first, until each pool expects at least five; what is left
/// over joins the last pool. Cells that expect nothing belong to no pool.
inline std::vector<Pool> pool_cells(const std::vector<double>& observed,
                                    const std::vector<double>& expected) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return expected[a] > expected[b]; });
    std::vector<Pool> pools(1);
    for (std::size_t i : order) {
        if (expected[i] <= 0.0) continue;
        if (pools.back().expected >= 5.0) pools.emplace_back();
        pools.back().observed += observed[i];
        pools.back().expected += expected[i];
    }
    if (pools.size() > 1 && pools.back().expected < 5.0) {
        const Pool rest = pools.back();
        pools.pop_back();
        pools.back().observed += rest.observed;
        pools.back().expected += rest.expected;
    }
    return pools;
}

}  // namespace detail

/// Pearson's test of "cell i was filled `expected[i]` times on average", where the expectations add
/// up to the number of draws. Cells are pooled until each pool expects five; a count in a cell that
/// expects nothing rejects at once.
inline ChiSquare chi_square(const std::vector<double>& observed,
                            const std::vector<double>& expected) {
    ChiSquare result;
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (expected[i] <= 0.0 && observed[i] > 0.0) result.hit_impossible_cell = true;
    const std::vector<detail::Pool> pools = detail::pool_cells(observed, expected);
    for (const detail::Pool& p : pools)
        if (p.expected > 0.0)
            result.statistic += (p.observed - p.expected) * (p.observed - p.expected) / p.expected;
    result.degrees_of_freedom = static_cast<int>(pools.size()) - 1;
    if (result.degrees_of_freedom > 0)
        result.p_value = chi_square_tail(result.statistic, result.degrees_of_freedom);
    if (result.hit_impossible_cell) result.p_value = 0.0;
    return result;
}

/// Counts of points in nx x ny equal cells of the unit square, row by row, and of points elsewhere
/// in one more cell at the end.
class Histogram {
 public:
    Histogram(int nx, int ny) : nx_(nx), ny_(ny), counts_(static_cast<std::size_t>(nx * ny + 1)) {}

    void add(double x, double y) {
        const bool inside = x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0;
        ++counts_[inside ? cell(x, y) : counts_.size() - 1];
        ++total_;
    }
    void add_elsewhere() { add(-1.0, -1.0); }

    /// Test of "the points have `density` inside the unit square". The cell for points elsewhere
    /// expects what the density's integral lacks to 1, nothing when it lacks less than 1e-6.
    template <class F>
    [[nodiscard]] ChiSquare against(const F& density, int pieces = 2) const {
        std::vector<double> expected = cell_integrals(nx_, ny_, pieces, density);
        const double elsewhere = 1.0 - std::accumulate(expected.begin(), expected.end(), 0.0);
        expected.push_back(elsewhere < 1e-6 ? 0.0 : elsewhere);
        for (double& e : expected) e *= total_;
        return chi_square(counts_, expected);
    }

 private:
    [[nodiscard]] std::size_t cell(double x, double y) const {
        const int ix = std::min(static_cast<int>(x * nx_), nx_ - 1);
        const int iy = std::min(static_cast<int>(y * ny_), ny_ - 1);
        return static_cast<std::size_t>(iy * nx_ + ix);
    }

    int nx_;
    int ny_;
    double total_ = 0.0;
    std::vector<double> counts_;
};

/// Azimuth of a vector around +z as a share of the full turn, [0, 1).
inline double turn(double x, double y) {
    const double t = std::atan2(y, x) / (2.0 * pi);
    return t < 0.0 ? t + 1.0 : t;
}

}  // namespace mirtest
