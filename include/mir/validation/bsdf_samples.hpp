// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/validation/detail/bsdf_directions.hpp"
#include "mir/validation/detail/direction_grid.hpp"
#include "mir/validation/detail/random.hpp"
#include "mir/validation/report.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mir::validation {

namespace detail {

/// 6 x 8 cells of (cos, azimuth) over the hemisphere, and one for samples that are thrown away.
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

/// Probability of each cell, by quadrature of pdf().
template <Bsdf B>
std::vector<double> cell_probabilities(const typename B::Params& p, Vec3 wo) {
    const HemisphereCells cell;
    std::vector<double> wanted(HemisphereCells::count, 0.0);
    for_each_direction_around(slanted_normal, 1200, 960, [&](Vec3 wi, double solid_angle) {
        if (glm::dot(wi, slanted_normal) > 0.0f)
            wanted[cell(wi)] += solid_angle * B::pdf(p, slanted_normal, wi, wo);
    });
    wanted[HemisphereCells::thrown_away] =
        1.0 - std::accumulate(wanted.begin(), wanted.end() - 1, 0.0);
    return wanted;
}

}  // namespace detail

/// The axiom of Bsdf that sample() follows pdf(), for light towards a direction at `cosine` from
/// the normal. Hypothesis: the counts of 20 000 samples in 6 x 8 cells of (cos, azimuth), and of
/// those thrown away, have the probabilities that quadrature of pdf() gives. Pearson's chi-squared
/// at level 1e-6 (Wilson and Hilferty's approximation, quantile 4.75); fixed seed. Lobes must be
/// wider than the grid's cells.
template <Bsdf B>
Report check_bsdf_samples(const typename B::Params& p, float cosine) {
    constexpr int samples = 20000;
    const Vec3 wo = detail::at_angle(cosine, 0.4f);
    const detail::HemisphereCells cell;
    const std::vector<double> wanted = detail::cell_probabilities<B>(p, wo);
    std::vector<double> found(wanted.size(), 0.0);
    Random random = detail::numbers(33);
    for (int i = 0; i < samples; ++i) {
        const Vec2 u = random.next_2d();
        const BsdfSample s = B::sample(p, detail::slanted_normal, wo, u, random.next());
        found[s.pdf > 0.0f ? cell(s.wi) : detail::HemisphereCells::thrown_away] += 1.0;
    }
    double chi_squared = 0.0;
    int cells = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const double expected = wanted[i] * samples;
        if (expected < 8.0) continue;
        chi_squared += (found[i] - expected) * (found[i] - expected) / expected;
        ++cells;
    }
    const double freedom = cells - 1.0;
    const double spread = 2.0 / (9.0 * freedom);
    const double normal = (std::cbrt(chi_squared / freedom) - (1.0 - spread)) / std::sqrt(spread);
    Report report;
    report.expect(normal < 4.75, "samples follow pdf",
                  "chi-squared is " + std::to_string(chi_squared) + " for " +
                      std::to_string(cells - 1) + " degrees of freedom");
    return report;
}

}  // namespace mir::validation
