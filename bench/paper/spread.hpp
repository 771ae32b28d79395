// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

namespace mirpaper {

/// Repeated measurements of one thing.
struct Spread {
    double median = 0.0;
    double min = 0.0;
    double max = 0.0;
    unsigned count = 0;
};

/// Of an even number, the mean of the two in the middle.
inline Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back(),
            static_cast<unsigned>(n)};
}

/// The spread of what `of(run)` says of each run.
template <class Run, class Of>
Spread spread_of(const std::vector<Run>& runs, const Of& of) {
    std::vector<double> values;
    for (const Run& run : runs) values.push_back(of(run));
    return spread_of(std::move(values));
}

}  // namespace mirpaper
