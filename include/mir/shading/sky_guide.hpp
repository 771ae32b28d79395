// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/data/blocked_layout.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mir {

/// Numbers that a SkyGuide draws.
struct GuidedNumbers {
    Vec2 numbers{0};       ///< for EnvironmentView::sample(), in [0, 1)^2
    float density = 1.0f;  ///< of them; 1 for uniform ones
};

/// What sixteen luxels of a block see of the environment. Each tries a cell in every column of the
/// grid of a SkyGuide, and together they try all cells once.
struct SkyTried {
    static constexpr std::uint32_t side = 16;  ///< luxels, and cells of a row and a column

    std::uint16_t seen[side] = {};  ///< bit c of element k: luxel k sees its cell in column c

    /// Row of the cell that luxel `k` tries in column `c`.
    [[nodiscard]] MIR_HD static std::uint32_t row(std::uint32_t k, std::uint32_t c) {
        return (k + 5 * c) % side;
    }
    /// True when so much of the sky is seen that more tries would tell little.
    [[nodiscard]] MIR_HD bool is_open() const {
        std::uint32_t count = 0;
        for (const std::uint16_t bits : seen)
            for (std::uint32_t c = 0; c < side; ++c) count += bits >> c & 1u;
        return 4 * count >= side * side;
    }
};

/// Where the luxels of a block see the environment: through windows, say. A grid over the numbers
/// that EnvironmentView::sample() takes, so that its cells have equal shares of the sky's light. A
/// cell is drawn the more often the more rays towards it and its neighbours came through, by the
/// square root: that share is the second moment of what a sample brings. No cell is left out, so
/// estimates stay unbiased. A value; host and device.
class SkyGuide {
 public:
    static constexpr std::uint32_t side = SkyTried::side;  ///< cells of a row and a column

    /// To be assigned to.
    SkyGuide() = default;
    /// Of a block whose `sets` sets of tries lie `stride` elements apart, one at least.
    MIR_HD SkyGuide(const SkyTried* tried, std::size_t stride, std::uint32_t sets) {
        std::uint8_t came[side][side] = {};
        for (std::uint32_t s = 0; s < sets; ++s)
            for (std::uint32_t k = 0; k < side; ++k)
                for (std::uint32_t c = 0; c < side; ++c)
                    came[SkyTried::row(k, c)][c] += tried[s * stride].seen[k] >> c & 1u;
        std::uint32_t sum = 0;
        for (std::uint32_t y = 0; y < side; ++y) {
            std::uint32_t row = 0;
            for (std::uint32_t x = 0; x < side; ++x) {
                row += weight(near(came, x, y), sets);
                columns_[y][x] = static_cast<std::uint16_t>(row);
            }
            sum += row;
            rows_[y] = static_cast<std::uint16_t>(sum);
        }
    }

    /// Maps uniform numbers to guided ones.
    [[nodiscard]] MIR_HD GuidedNumbers draw(Vec2 u) const {
        const Part y = part(rows_, u.y);
        const Part x = part(columns_[y.cell], u.x);
        return {Vec2(x.place(), y.place()), x.weight * density_of_weight()};
    }

    /// The density of draw() there.
    [[nodiscard]] MIR_HD float density(Vec2 numbers) const {
        const auto x = static_cast<std::uint32_t>(numbers.x * side);
        const auto y = static_cast<std::uint32_t>(numbers.y * side);
        const std::uint32_t before = x == 0 ? 0 : columns_[y][x - 1];
        return static_cast<float>(columns_[y][x] - before) * density_of_weight();
    }

 private:
    /// Of a cell towards which no ray came through. All others are drawn up to 64 times as often.
    static constexpr std::uint32_t least = 1;
    static constexpr float most = 63.0f;

    /// A cell of a row, or a row.
    struct Part {
        std::uint32_t cell;
        float inside;  ///< place in it, in its size
        float weight;

        [[nodiscard]] MIR_HD float place() const {
            return smaller((static_cast<float>(cell) + inside) * (1.0f / side), 0x1.fffffep-1f);
        }
    };

    /// Rays that came through to a cell and its neighbours, sixteenths: those of the cell count
    /// four, beside it two, across its corners one.
    MIR_HD static std::uint32_t near(const std::uint8_t (&came)[side][side], std::uint32_t x,
                                     std::uint32_t y) {
        std::uint32_t sum = 0;
        for (std::uint32_t v = y == 0 ? 0 : y - 1; v < side && v <= y + 1; ++v)
            for (std::uint32_t u = x == 0 ? 0 : x - 1; u < side && u <= x + 1; ++u)
                sum += came[v][u] << ((u == x ? 1 : 0) + (v == y ? 1 : 0));
        return sum;
    }
    MIR_HD static std::uint32_t weight(std::uint32_t near, std::uint32_t sets) {
        const float share = static_cast<float>(near) / static_cast<float>(16 * sets);
        return least + static_cast<std::uint32_t>(most * std::sqrt(share));
    }

    MIR_HD static Part part(const std::uint16_t (&ends)[side], float u) {
        const float at = u * static_cast<float>(ends[side - 1]);
        std::uint32_t cell = 0;
        std::uint32_t begin = 0;
        while (cell + 1 < side && at >= static_cast<float>(ends[cell])) begin = ends[cell++];
        const auto weight = static_cast<float>(ends[cell] - begin);
        return {cell, (at - static_cast<float>(begin)) / weight, weight};
    }
    [[nodiscard]] MIR_HD float density_of_weight() const {
        return static_cast<float>(side * side) / static_cast<float>(rows_[side - 1]);
    }

    std::uint16_t rows_[side] = {};           ///< weights of all rows up to and with each
    std::uint16_t columns_[side][side] = {};  ///< of each row, up to and with each cell
};

/// The guide of the block that blocked index `i` lies in; null without guides.
[[nodiscard]] MIR_HD inline const SkyGuide* sky_of(const SkyGuide* skies, LuxelIndex i) {
    return skies == nullptr ? nullptr : skies + i / BlockedLayout::block_size;
}

}  // namespace mir
