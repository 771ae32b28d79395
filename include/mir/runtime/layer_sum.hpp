// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace mir {

/// Sum of images of T in double precision, in the order of the calls. T is one or three floats a
/// pixel (float, Rgb, Vec3). One thread at a time.
template <class T>
class LayerSum {
 public:
    /// Red, green, blue or x, y, z or the one number.
    using Channels = std::array<double, std::is_same_v<T, float> ? 1 : 3>;

    /// The first image fixes the size; all have it.
    void add(const Image<T>& image) {
        const std::span<const T> from = image.pixels();
        if (sums_.pixels().empty()) {
            // Not added to zero, which would lose the sign of -0.
            sums_ = Image<Channels>::unwritten(image.extent());
            for (std::size_t i = 0; i < from.size(); ++i) sums_.pixels()[i] = channels(from[i]);
            return;
        }
        for (std::size_t i = 0; i < from.size(); ++i) {
            const Channels c = channels(from[i]);
            for (std::size_t k = 0; k < c.size(); ++k) sums_.pixels()[i][k] += c[k];
        }
    }

    /// The sum over `count`, in single precision.
    [[nodiscard]] Image<T> mean(std::uint32_t count) const {
        Image<T> image = Image<T>::unwritten(sums_.extent());
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            const Channels& c = sums_.pixels()[i];
            if constexpr (std::is_same_v<T, float>)
                image.pixels()[i] = static_cast<float>(c[0] / count);
            else
                image.pixels()[i] = {static_cast<float>(c[0] / count),
                                     static_cast<float>(c[1] / count),
                                     static_cast<float>(c[2] / count)};
        }
        return image;
    }

    /// Hands all that `self` consists of to `archive`, which reads or, unless const, replaces it.
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
        archive(self.sums_);
    }

 private:
    static Channels channels(float value) { return {value}; }
    static Channels channels(const Rgb& c) { return {c.r, c.g, c.b}; }
    static Channels channels(const Vec3& v) { return {v.x, v.y, v.z}; }

    Image<Channels> sums_;
};

}  // namespace mir
