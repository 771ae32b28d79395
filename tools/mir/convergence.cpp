// SPDX-License-Identifier: MIT
#include "convergence.hpp"

#include <cmath>
#include <cstddef>

namespace mirtool {
namespace {

/// None for a black reference.
std::optional<double> luminance_error(const mir::Image<mir::Rgb>& picture,
                                      const mir::Image<mir::Rgb>& reference) {
    double squares = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.pixels().size(); ++i) {
        const auto wanted = static_cast<double>(luminance(reference.pixels()[i]));
        const double difference = static_cast<double>(luminance(picture.pixels()[i])) - wanted;
        squares += difference * difference;
        sum += wanted;
    }
    if (!(sum > 0.0)) return std::nullopt;
    const auto n = static_cast<double>(reference.pixels().size());
    return std::sqrt(squares / n) / (sum / n);
}

/// Whether a point after `passes` says more than that after `earlier`.
bool is_news(std::uint32_t passes, std::uint32_t earlier) {
    return passes <= 16 || 10ull * passes >= 11ull * earlier;
}

}  // namespace

void Convergence::look_at(const mir::PassSums& sums, bool last) {
    const std::uint32_t passes = sums.passes();
    const std::uint32_t earlier = points_.empty() ? 0 : points_.back().passes;
    if (passes == earlier || !(last || is_news(passes, earlier))) return;
    const mir::RenderStatistics& s = sums.statistics();
    points_.push_back({passes, s.vpls, s.seconds.total, sums.relative_error(), std::nullopt});
    if (reference_.extent().area() > 0)
        points_.back().reference_error = luminance_error(sums.result().beauty, reference_);
}

}  // namespace mirtool
