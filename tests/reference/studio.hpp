// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/tbb_executor.hpp"
#include "mir/reference/trace_reference.hpp"
#include "support/statistics.hpp"
#include "support/traced_scene.hpp"

namespace mirtest {

/// A scene that a path tracer looks at.
template <mir::Bsdf B>
struct Studio : TracedScene<B> {
    using TracedScene<B>::TracedScene;

    template <mir::PathRules Rules = mir::BalanceRules>
    [[nodiscard]] auto tracer(const mir::PathTracerOptions& options) const {
        using Tracer =
            mir::PathTracer<B, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility, Rules>;
        return Tracer({this->geometry, this->lights, this->surfaces, this->engine.ray_caster(),
                       this->engine.visibility()},
                      options);
    }

    /// Rays of a square image with one luxel per pixel.
    [[nodiscard]] mir::CameraRays rays(std::uint32_t side, std::uint64_t seed) const {
        return {this->scene.cameras.front(), {{side, side}}, seed};
    }
};

/// One image per replicate.
template <class Tracer>
std::vector<mir::ReferenceImage> replicates(const Tracer& tracer, const mir::CameraRays& rays,
                                            mir::ReferenceOptions options, std::uint32_t count) {
    mir::TbbExecutor executor;
    std::vector<mir::ReferenceImage> images;
    options.replicates = 1;
    for (std::uint32_t r = 0; r < count; ++r, ++options.first_replicate)
        images.push_back(trace_reference(tracer, rays, options, executor));
    return images;
}

/// Mean luminance of every tile of side `tile`, over replicates.
class TileMeans {
 public:
    explicit TileMeans(std::uint32_t tile) : tile_(tile) {}

    void add(const mir::Image<mir::Rgb>& image) {
        const auto tiles = mir::cut_into_tiles(image.extent(), {tile_, tile_});
        moments_.resize(tiles.size());
        for (std::size_t t = 0; t < tiles.size(); ++t) moments_[t].add(mean(image, tiles[t]));
    }
    [[nodiscard]] const std::vector<Moments>& moments() const { return moments_; }

 private:
    static double mean(const mir::Image<mir::Rgb>& image, const mir::Tile& t) {
        double sum = 0.0;
        for (std::uint32_t y = t.y; y < t.y + t.height; ++y)
            for (std::uint32_t x = t.x; x < t.x + t.width; ++x)
                sum += static_cast<double>(luminance(image(x, y)));
        return sum / (double{1} * t.width * t.height);
    }

    std::uint32_t tile_;
    std::vector<Moments> moments_;
};

/// D_b of every replicate, tile by tile.
inline TileMeans tiles_of(const std::vector<mir::ReferenceImage>& images, std::uint8_t b,
                          std::uint32_t tile) {
    TileMeans means(tile);
    for (const mir::ReferenceImage& image : images) means.add(image.bounce(b));
    return means;
}

/// Smallest p-value of Welch's test over all tiles.
inline double smallest_p(const TileMeans& a, const TileMeans& b) {
    double p = 1.0;
    for (std::size_t t = 0; t < a.moments().size(); ++t)
        p = std::min(p, welch_p_value(a.moments()[t], b.moments()[t]));
    return p;
}

/// p-value of "the whole image of D_b has the mean luminance `expected`".
inline double p_of_mean(const std::vector<mir::ReferenceImage>& images, std::uint8_t b,
                        double expected, double rounding = 0.0) {
    const std::uint32_t side = images.front().extent().width;
    return mean_p_value(tiles_of(images, b, side).moments().front(), expected, rounding);
}

}  // namespace mirtest
