// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/discrete_distribution.hpp"

namespace mir {

/// A cell that a DiscreteDistribution2d picked, and a uniform place inside it, in [0, 1)^2.
struct GridCell {
    std::uint32_t x = 0;  ///< column
    std::uint32_t y = 0;  ///< row
    Vec2 inside{0};       ///< from the cell's corner (x, y), in cells
};

/// What kernels read of a DiscreteDistribution2d. A view; thread-safe.
template <Space S>
struct DiscreteDistribution2dView {
    static constexpr Space space = S;  ///< memory that the arrays lie in

    const double* cumulative = nullptr;  ///< of each row alone, row by row
    std::uint32_t width = 0;             ///< cells of a row
    DiscreteDistributionView<S> rows;    ///< each row by the sum of its weights

    /// True when no cell has weight: sample() must not be called.
    [[nodiscard]] MIR_HD bool empty() const { return rows.empty(); }

    /// The cells of one row.
    [[nodiscard]] MIR_HD DiscreteDistributionView<S> row(std::uint32_t y) const {
        const double* first = cumulative + static_cast<std::size_t>(y) * width;
        return {first, width, first[width - 1]};
    }

    /// Cell for `u` in [0, 1)^2: u.y picks the row, u.x the column. Must not be empty.
    [[nodiscard]] MIR_HD GridCell sample(Vec2 u) const {
        const std::uint32_t y = rows.sample(u.y);
        const DiscreteDistributionView<S> cells = row(y);
        const std::uint32_t x = cells.sample(u.x);
        return {x, y, {cells.place_in(x, u.x), rows.place_in(y, u.y)}};
    }

    /// The numbers for which sample() gives this place, if its cell has weight.
    [[nodiscard]] MIR_HD Vec2 numbers(const GridCell& at) const {
        return {row(at.y).number_at(at.x, at.inside.x), rows.number_at(at.y, at.inside.y)};
    }
};

/// Picks a cell of a grid with probability proportional to its weight. The row, then the column.
/// Cells of weight zero are never picked. Immutable; const use from any thread.
class DiscreteDistribution2d {
 public:
    DiscreteDistribution2d() = default;

    /// `weights` row by row, finite and not negative; their sum may be zero (then `empty()`).
    /// @throws Error(invalid_argument) when they fill no rows of `width`, are negative or infinite,
    ///         or add up to more than a float holds.
    DiscreteDistribution2d(std::span<const float> weights, std::uint32_t width) : width_(width) {
        expects(width > 0 && weights.size() % width == 0,
                "weights of a grid do not fill its rows; give width x height of them");
        cumulative_.reserve(weights.size());
        std::vector<float> sums;
        for (std::size_t first = 0; first < weights.size(); first += width) {
            const DiscreteDistribution row(weights.subspan(first, width));
            cumulative_.insert(cumulative_.end(), row.cumulative().begin(), row.cumulative().end());
            sums.push_back(static_cast<float>(row.total()));
        }
        rows_ = DiscreteDistribution(sums);
    }

    /// True when no cell has weight: sample() must not be called.
    [[nodiscard]] bool empty() const { return rows_.empty(); }
    /// Sum of all weights.
    [[nodiscard]] double total() const { return rows_.total(); }

    /// What kernels on the host read; valid until the distribution is changed or ends.
    [[nodiscard]] DiscreteDistribution2dView<Space::host> view() const {
        return {cumulative_.data(), width_, rows_.view()};
    }
    /// The arrays of view().
    [[nodiscard]] std::span<const double> cumulative() const { return cumulative_; }
    /// Picks each row by the sum of its weights, rounded to float.
    [[nodiscard]] const DiscreteDistribution& rows() const { return rows_; }

 private:
    std::uint32_t width_ = 0;
    std::vector<double> cumulative_;
    DiscreteDistribution rows_;
};

}  // namespace mir
