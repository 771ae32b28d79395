// SPDX-License-Identifier: MIT
#pragma once

#include "reference/studio.hpp"
#include "support.hpp"

#include <array>
#include <cstdio>
#include <span>
#include <string>

namespace mirtest {

/// Light of VPLs and what their render says to be missing: what the largest number of reflections
/// cuts is a share of what the bound leaves, what the bound removes one of what is scattered no
/// more often. Other integrators report neither.
inline double with_missing(double light, const mir::RenderStatistics& s) {
    const auto over_kept = [](const std::optional<mir::ShareEstimate>& missing) {
        return missing ? missing->share / (1.0 - missing->share) : 0.0;
    };
    return light * (1.0 + over_kept(s.cut) + over_kept(s.removed));
}

/// A layer of a picture; the sum of the others is the beauty.
enum class Layer : std::size_t { emission, direct, indirect, beauty };

/// Every layer.
inline constexpr std::array all_layers{Layer::emission, Layer::direct, Layer::indirect,
                                       Layer::beauty};

/// Mean luminance of the layers of renders that differ in their seeds; each render counts with what
/// it says to be missing.
class LayerMeans {
 public:
    explicit LayerMeans(const std::vector<mir::RenderResult>& renders) {
        for (const mir::RenderResult& r : renders) add(r);
    }

    /// Over the picture.
    [[nodiscard]] const Moments& of(Layer layer) const {
        return means_[static_cast<std::size_t>(layer)];
    }
    /// Of the direct light, which knows of no bound.
    [[nodiscard]] const TileMeans& direct_tiles() const { return direct_tiles_; }

 private:
    void add(const mir::RenderResult& r) {
        const double emission = mean_luminance(r.emission);
        const double direct = mean_luminance(r.direct);
        const double indirect = with_missing(mean_luminance(r.indirect), r.statistics);
        const double values[] = {emission, direct, indirect, emission + direct + indirect};
        for (std::size_t i = 0; i < means_.size(); ++i) means_[i].add(values[i]);
        direct_tiles_.add(r.direct);
    }

    std::array<Moments, 4> means_;
    TileMeans direct_tiles_{8};
};

/// p-value, after Sidak, of "both have the same means", Welch's test in each of the layers over the
/// picture, and in tiles of the direct light where that is among them.
inline double agreement(const LayerMeans& a, const LayerMeans& b, std::span<const Layer> layers) {
    double smallest = 1.0;
    auto tests = static_cast<double>(layers.size());
    for (const Layer layer : layers) {
        smallest = std::min(smallest, welch_p_value(a.of(layer), b.of(layer)));
        if (layer != Layer::direct) continue;
        smallest = std::min(smallest, smallest_p(a.direct_tiles(), b.direct_tiles()));
        tests += static_cast<double>(a.direct_tiles().moments().size());
    }
    return -std::expm1(tests * std::log1p(-smallest));
}

/// Means, standard errors and their difference in these, a line for each layer, for messages.
inline std::string beside(const LayerMeans& a, const LayerMeans& b, std::span<const Layer> layers) {
    static constexpr const char* names[] = {"emission", "direct", "indirect", "beauty"};
    std::string text;
    for (const Layer layer : layers) {
        const Moments& x = a.of(layer);
        const Moments& y = b.of(layer);
        const double error = std::hypot(x.standard_error(), y.standard_error());
        char line[200];
        std::snprintf(line, sizeof line, "%s: %.6g +- %.2g and %.6g +- %.2g, %.2f errors apart\n",
                      names[static_cast<std::size_t>(layer)], x.mean(), x.standard_error(),
                      y.mean(), y.standard_error(),
                      error > 0.0 ? (x.mean() - y.mean()) / error : 0.0);
        text += line;
    }
    return text;
}

}  // namespace mirtest
