// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/rgb.hpp"

#include <cstddef>
#include <cstdint>

namespace mir {

/// Red, green and blue in double precision, in the unit of what was added.
struct RgbSum {
    double channel[3] = {};  ///< red, green, blue

    /// Adds channel by channel, in double precision.
    MIR_HD RgbSum& operator+=(Rgb c) {
        channel[0] += static_cast<double>(c.r);
        channel[1] += static_cast<double>(c.g);
        channel[2] += static_cast<double>(c.b);
        return *this;
    }
    /// Adds channel by channel.
    MIR_HD RgbSum& operator+=(const RgbSum& o) {
        for (std::size_t i = 0; i < 3; ++i) channel[i] += o.channel[i];
        return *this;
    }
    /// Every channel times `s`.
    MIR_HD friend RgbSum operator*(RgbSum a, double s) {
        for (double& c : a.channel) c *= s;
        return a;
    }
    /// Equal in every channel.
    friend bool operator==(const RgbSum&, const RgbSum&) = default;
    /// Rounded to single precision.
    [[nodiscard]] MIR_HD Rgb rgb() const {
        return {static_cast<float>(channel[0]), static_cast<float>(channel[1]),
                static_cast<float>(channel[2])};
    }
};

/// First and second moments of a colour over replicates, channel by channel (Welford 1962). How
/// many replicates it holds is kept by the image it belongs to.
struct RgbMoments {
    RgbSum mean;     ///< of the replicates added so far
    RgbSum squares;  ///< sum of squared deviations from the mean

    /// Adds `value` after `earlier` others.
    void add(const RgbSum& value, std::uint32_t earlier) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double delta = value.channel[i] - mean.channel[i];
            mean.channel[i] += delta / (earlier + 1.0);
            squares.channel[i] += delta * (value.channel[i] - mean.channel[i]);
        }
    }

    /// Variance of the mean of `count` replicates, unbiased.
    /// @throws Error(invalid_argument) for fewer than two.
    [[nodiscard]] RgbSum variance_of_mean(std::uint32_t count) const {
        expects(count >= 2,
                "a variance of fewer than two replicates was asked for (one number does not vary); "
                "trace at least two");
        return squares * (1.0 / (static_cast<double>(count) * (count - 1.0)));
    }
};

}  // namespace mir
