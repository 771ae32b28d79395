// SPDX-License-Identifier: MIT
#pragma once

#include "reference/studio.hpp"
#include "support.hpp"

namespace mirtest {

/// Mean luminance of D_2 .. D_5 and of their sum, over replicates: in each tile and in the whole
/// image, where chains are scaled by P_c and vary least.
class BounceMeans {
 public:
    static constexpr std::uint8_t last_bounce = 5;
    static constexpr std::uint32_t tile = 8;  ///< pixels along either side

    void add(const mir::ReferenceImage& image) {
        add([&](std::uint8_t b) { return image.bounce(b); });
    }
    /// Of a render that made layers of bounces.
    void add(const mir::RenderResult& r) {
        const mir::Image<mir::Rgb> black(r.beauty.extent());
        add([&](std::uint8_t b) { return b <= r.bounces.size() ? r.bounces[b - 1u] : black; });
    }
    [[nodiscard]] const std::vector<TileMeans>& tiles() const { return tiles_; }
    [[nodiscard]] const std::vector<TileMeans>& images() const { return images_; }

 private:
    static constexpr std::size_t layers = last_bounce;

    template <class Bounce>
    void add(const Bounce& bounce) {
        mir::Image<mir::Rgb> sum = bounce(2);
        add(0, sum);
        for (std::uint8_t b = 3; b <= last_bounce; ++b) {
            const mir::Image<mir::Rgb> layer = bounce(b);
            add(b - 2u, layer);
            for (std::size_t i = 0; i < sum.pixels().size(); ++i)
                sum.pixels()[i] += layer.pixels()[i];
        }
        add(layers - 1, sum);
    }
    void add(std::size_t layer, const mir::Image<mir::Rgb>& image) {
        tiles_[layer].add(image);
        images_[layer].add(image);
    }

    std::vector<TileMeans> tiles_{layers, TileMeans(tile)};
    std::vector<TileMeans> images_{layers, TileMeans(1u << 16)};
};

/// p-value, after Sidak, of "both have the same means", Welch's test in each.
inline double agreement(const std::vector<TileMeans>& a, const std::vector<TileMeans>& b) {
    double smallest = 1.0;
    double tests = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        smallest = std::min(smallest, smallest_p(a[i], b[i]));
        tests += static_cast<double>(a[i].moments().size());
    }
    return -std::expm1(tests * std::log1p(-smallest));
}

/// The same for tiles and whole images.
inline double agreement(const BounceMeans& a, const BounceMeans& b) {
    const double p = std::min(agreement(a.tiles(), b.tiles()), agreement(a.images(), b.images()));
    return -std::expm1(2.0 * std::log1p(-p));
}

}  // namespace mirtest
