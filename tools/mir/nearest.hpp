// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mirtool {

/// Edit distance of two words, swaps of neighbours included. It counts insertions, deletions,
/// replacements and swaps, none of them touched twice (Damerau 1964, "optimal string alignment").
inline std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before;  // the row of a prefix that is two letters shorter
    std::vector<std::size_t> above;
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before = std::exchange(above, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

/// The known word that a mistyped option most likely meant, if any is near.
inline std::optional<std::string> nearest(const std::string& word,
                                          const std::vector<std::string>& known) {
    std::optional<std::string> best;
    const auto letters = static_cast<std::size_t>(
        std::count_if(word.begin(), word.end(), [](char c) { return c != '-'; }));
    std::size_t least = std::max<std::size_t>(letters > 4 ? 2 : 1, letters / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance >= least) continue;
        least = distance;
        best = candidate;
    }
    return best;
}

}  // namespace mirtool
