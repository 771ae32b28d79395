// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mir {

/// Standard errors of pictures that err alone, on the way to that of their mean. One thread at a
/// time.
class ErrorSum {
 public:
    /// The first image fixes the size; all have it.
    void add(const Image<float>& errors) {
        if (squares_.pixels().empty()) squares_ = Image<double>(errors.extent());
        for (std::size_t i = 0; i < errors.pixels().size(); ++i) {
            const auto error = static_cast<double>(errors.pixels()[i]);
            squares_.pixels()[i] += error * error;
        }
    }

    /// That of the mean of `count` pictures; of one its own, in every bit.
    [[nodiscard]] Image<float> of_mean(std::uint32_t count) const {
        auto errors = Image<float>::unwritten(squares_.extent());
        for (std::size_t i = 0; i < errors.pixels().size(); ++i)
            errors.pixels()[i] = static_cast<float>(std::sqrt(squares_.pixels()[i]) / count);
        return errors;
    }

    /// Hands all that `self` consists of to `archive`, which reads or, unless const, replaces it.
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
        archive(self.squares_);
    }

 private:
    Image<double> squares_;
};

}  // namespace mir
