// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/core/number_text.hpp"
#include "mir/validation/detail/bsdf_directions.hpp"
#include "mir/validation/detail/random.hpp"
#include "mir/validation/report.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace mir::validation {

namespace detail {

/// 6 x 8 cells of (cos, azimuth) over the hemisphere. One more is for samples that are thrown away.
class HemisphereCells {
 public:
    static constexpr std::size_t thrown_away = 48;
    static constexpr std::size_t count = 49;

    [[nodiscard]] std::size_t operator()(Vec3 wi) const {
        const Vec3 local = frame_.to_local(wi);
        const float turn = std::atan2(local.y, local.x) / (2.0f * pi) + 0.5f;
        const int across = std::clamp(static_cast<int>(turn * 8.0f), 0, 7);
        return static_cast<std::size_t>(std::clamp(static_cast<int>(local.z * 6.0f), 0, 5) * 8 +
                                        across);
    }

 private:
    Frame frame_ = Frame::around(slanted_normal);
};

/// Probability of each cell, by quadrature of pdf() at 200 x 120 midpoints each.
template <Bsdf B>
std::vector<double> cell_probabilities(const typename B::Params& p, Vec3 wo) {
    constexpr int rings = 6 * 200;
    constexpr int sectors = 8 * 120;
    const Frame frame = Frame::around(slanted_normal);
    const HemisphereCells cell;
    std::vector<double> wanted(HemisphereCells::count, 0.0);
    for (int r = 0; r < rings; ++r)
        for (int s = 0; s < sectors; ++s) {
            const float z = (static_cast<float>(r) + 0.5f) / rings;
            const float phi = 2.0f * pi * (static_cast<float>(s) + 0.5f) / sectors;
            const float across = std::sqrt(1.0f - z * z);
            const Vec3 wi = frame.to_world({across * std::cos(phi), across * std::sin(phi), z});
            wanted[cell(wi)] += B::pdf(p, slanted_normal, wi, wo);
        }
    for (double& w : wanted) w *= 2.0 * std::numbers::pi / (rings * sectors);
    const double kept = std::accumulate(wanted.begin(), wanted.end(), 0.0);
    wanted[HemisphereCells::thrown_away] = kept > 1.0 ? 0.0 : 1.0 - kept;
    return wanted;
}

/// How many samples fell into each cell.
template <Bsdf B>
std::vector<double> count_samples(const typename B::Params& p, Vec3 wo, int samples,
                                  Report& report) {
    const HemisphereCells cell;
    std::vector<double> found(HemisphereCells::count, 0.0);
    int bad = 0;
    Random random = numbers(33);
    for (int i = 0; i < samples; ++i) {
        const Vec2 u = random.next_2d();
        const BsdfSample s = B::sample(p, slanted_normal, wo, u, random.next());
        if (!std::isfinite(s.pdf) || (s.pdf > 0.0f && !is_finite(s.wi)))
            ++bad;
        else
            found[s.pdf > 0.0f ? cell(s.wi) : HemisphereCells::thrown_away] += 1.0;
    }
    report.expect(bad == 0, "samples are finite",
                  std::to_string(bad) + " of " + std::to_string(samples) + " are not");
    return found;
}

/// Probability that a Poisson variable of this mean is `count` or more.
inline double poisson_tail(double mean, double count) {
    double term = std::exp(-mean);
    double below = 0.0;
    for (double k = 0.0; k < count; k += 1.0) {
        below += term;
        term *= mean / (k + 1.0);
    }
    return 1.0 - below;
}

/// Counts against expectation, by Pearson's chi-squared. Cells that expect 8 or more count alone,
/// all others as one.
class CellCounts {
 public:
    void add(double found, double expected) {
        if (expected >= least) {
            chi_squared_ += (found - expected) * (found - expected) / expected;
            ++cells_;
        } else {
            found_in_others_ += found;
            expected_in_others_ += expected;
        }
    }

    /// Tests at level 1e-6. Where the others expect 8 or more they are a cell like any; where they
    /// expect fewer, their count is bounded.
    void judge(Report& report, double quadrature_error) {
        if (expected_in_others_ >= least)
            add(std::exchange(found_in_others_, 0.0), std::exchange(expected_in_others_, 0.0));
        report.expect(poisson_tail(expected_in_others_ + quadrature_error, found_in_others_) > 1e-6,
                      "samples follow pdf",
                      number_text(found_in_others_) + " samples lie where " +
                          number_text(expected_in_others_) + " are expected");
        if (cells_ < 2) return;  // one cell holds all that the others do not
        const double freedom = cells_ - 1.0;
        const double spread = 2.0 / (9.0 * freedom);
        const double normal =
            (std::cbrt(chi_squared_ / freedom) - (1.0 - spread)) / std::sqrt(spread);
        report.expect(normal < 4.75, "samples follow pdf",
                      "chi-squared is " + number_text(chi_squared_) + " for " +
                          std::to_string(cells_ - 1) + " degrees of freedom");
    }

 private:
    static constexpr double least = 8.0;

    double chi_squared_ = 0.0;
    int cells_ = 0;
    double found_in_others_ = 0.0;
    double expected_in_others_ = 0.0;
};

}  // namespace detail

/// The axiom of Bsdf that sample() follows pdf(). It holds for light towards a direction at
/// `cosine` from the normal. Hypothesis: the counts of 20 000 samples in 6 x 8 cells of (cos,
/// azimuth), and of those thrown away, have the probabilities that quadrature of pdf() gives.
/// Pearson's chi-squared (Wilson and Hilferty's approximation, quantile 4.75) of the cells that
/// expect 8 samples or more; the others are one cell, or, when they expect fewer together, a
/// Poisson variable whose mean may be larger by 2, the error of quadrature. Each at level 1e-6;
/// fixed seed. Lobes must be wider than the grid's cells.
template <Bsdf B>
Report check_bsdf_samples(const typename B::Params& p, float cosine) {
    constexpr int samples = 20000;
    const Vec3 wo = detail::at_angle(cosine, 0.4f);
    Report report;
    const std::vector<double> found = detail::count_samples<B>(p, wo, samples, report);
    const std::vector<double> wanted = detail::cell_probabilities<B>(p, wo);
    detail::CellCounts counts;
    for (std::size_t i = 0; i < wanted.size(); ++i) counts.add(found[i], wanted[i] * samples);
    counts.judge(report, 2.0);
    return report;
}

}  // namespace mir::validation
