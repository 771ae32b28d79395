// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/strict_float.hpp"
#include "mir/micro/texel_reach.hpp"

#include <cstdint>

namespace mir {

/// Some texels of a picture, and the picture's number, in a word. The picture has up to 31 texels
/// in each direction; columns may go around from the last to the first. A value.
class TexelRectangle {
 public:
    /// None.
    TexelRectangle() = default;

    /// Texels whose directions may lie in `reach`. The picture has side x side texels; `jitter` is
    /// the place of directions inside of texels. `goes_around`: the picture's left and right border
    /// are one.
    MIR_HD TexelRectangle(const TexelReach& reach, Vec2 jitter, std::uint32_t side,
                          bool goes_around, std::uint32_t picture) {
        const Span y = inside(span(reach.low.y, reach.high.y, jitter.y, side), side);
        const Span all_x = span(reach.low.x, reach.high.x, jitter.x, side);
        const Span x = goes_around ? once_around(all_x, side) : inside(all_x, side);
        if (x.last < x.first || y.last < y.first) return;
        const auto width = static_cast<std::uint32_t>(x.last - x.first + 1);
        const auto height = static_cast<std::uint32_t>(y.last - y.first + 1);
        // Spans start less than two turns below 0.
        const std::uint32_t first = static_cast<std::uint32_t>(x.first) + 2 * side;
        const std::uint32_t column = goes_around ? first % side : first - 2 * side;
        word_ = column | static_cast<std::uint32_t>(y.first) << bits | width << 2 * bits |
                height << 3 * bits | picture << 4 * bits;
    }

    /// True where there is none.
    [[nodiscard]] MIR_HD bool is_empty() const { return word_ == 0; }
    /// Number of texels.
    [[nodiscard]] MIR_HD std::uint32_t size() const { return field(2) * field(3); }
    /// Number of the picture.
    [[nodiscard]] MIR_HD std::uint32_t picture() const { return word_ >> 4 * bits; }

    /// Number in its picture of texel k, both counted row by row. `side` is the picture's.
    [[nodiscard]] MIR_HD std::uint32_t texel(std::uint32_t k, std::uint32_t side) const {
        const std::uint32_t width = field(2);
        // Half a texel from where rounding would matter.
        const auto row = static_cast<std::uint32_t>((static_cast<float>(k) + 0.5f) *
                                                    loose::reciprocal(static_cast<float>(width)));
        const std::uint32_t column = field(0) + (k - row * width);
        return (field(1) + row) * side + (column < side ? column : column - side);
    }

 private:
    static constexpr std::uint32_t bits = 5;  ///< of a field

    [[nodiscard]] MIR_HD std::uint32_t field(std::uint32_t i) const {
        return word_ >> i * bits & ((1u << bits) - 1u);
    }

    /// Texels on an axis; none when the last comes before the first.
    struct Span {
        int first;
        int last;
    };

    /// Those whose directions lie between two places.
    [[nodiscard]] MIR_HD static Span span(float low, float high, float jitter, std::uint32_t side) {
        const auto texels = static_cast<float>(side);
        return {static_cast<int>(ceilf(loose::mul_sub(low, texels, jitter))),
                static_cast<int>(floorf(loose::mul_sub(high, texels, jitter)))};
    }
    [[nodiscard]] MIR_HD static Span inside(Span s, std::uint32_t side) {
        const int end = static_cast<int>(side) - 1;
        return {s.first > 0 ? s.first : 0, s.last < end ? s.last : end};
    }
    [[nodiscard]] MIR_HD static Span once_around(Span s, std::uint32_t side) {
        const int most = s.first + static_cast<int>(side) - 1;
        return {s.first, s.last < most ? s.last : most};
    }

    std::uint32_t word_ = 0;
};

}  // namespace mir
