// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/all_renderers.hpp"
#include "mir/scenes.hpp"
#include "support/same_images.hpp"

#include <array>
#include <cmath>

namespace mirtest {

/// Renders with the compiled CPU renderer.
inline mir::RenderResult render(const mir::Scene& scene, const mir::RenderSettings& settings,
                                mir::Monitor* monitor = nullptr) {
    mir::Registry registry;
    mir::add_cpu_to(registry);
    return registry.make(settings.backend, settings.scheduler)->render(scene, settings, monitor);
}

/// Settings of a small picture without any bound.
inline mir::RenderSettings small_settings(std::uint32_t side, std::uint32_t vpls) {
    mir::RenderSettings s;
    s.image = {side, side};
    s.luxels_per_pixel = 1;
    s.vpls = vpls;
    s.bound.kind = mir::BoundPolicy::Kind::none;
    s.filter = mir::default_filter(mir::FilterKind::box);
    s.tile = {16, 16};
    s.measure_missing = false;  // takes longer than such a picture
    s.micro.check = mir::GatherCheck::none;
    return s;
}

/// Where VPLs may come from.
inline constexpr std::array samplers{mir::SamplerKind::instant_radiosity,
                                     mir::SamplerKind::bidirectional, mir::SamplerKind::metropolis};

/// Mean of a picture, channel by channel, in double.
struct Mean {
    double r = 0.0;
    double g = 0.0;
    double b = 0.0;
};

inline Mean mean_of(const mir::Image<mir::Rgb>& image) {
    Mean m;
    for (const mir::Rgb& p : image.pixels()) {
        m.r += p.r;
        m.g += p.g;
        m.b += p.b;
    }
    const auto n = static_cast<double>(image.pixels().size());
    return {m.r / n, m.g / n, m.b / n};
}

inline double mean_luminance(const mir::Image<mir::Rgb>& image) {
    double sum = 0.0;
    for (const mir::Rgb& p : image.pixels()) sum += static_cast<double>(luminance(p));
    return sum / static_cast<double>(image.pixels().size());
}

/// Root mean square difference over the root mean square of `a`.
inline double relative_difference(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b) {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const double x = luminance(a.pixels()[i]);
        const double y = luminance(b.pixels()[i]);
        difference += (x - y) * (x - y);
        size += x * x;
    }
    return size > 0.0 ? std::sqrt(difference / size) : std::sqrt(difference);
}

/// Share of the pixels whose luminance differs by more than `tolerance` of the larger one.
inline double share_of_changed_pixels(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b,
                                      float tolerance) {
    std::size_t changed = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const float x = luminance(a.pixels()[i]);
        const float y = luminance(b.pixels()[i]);
        if (std::abs(x - y) > tolerance * std::max(x, y)) ++changed;
    }
    return static_cast<double>(changed) / static_cast<double>(a.pixels().size());
}

/// Mean and standard error of a sample.
struct Estimate {
    double mean = 0.0;
    double error = 0.0;
};

inline Estimate estimate(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double sum = 0.0;
    for (double v : values) sum += v;
    const double mean = sum / n;
    double squares = 0.0;
    for (double v : values) squares += (v - mean) * (v - mean);
    return {mean, std::sqrt(squares / (n * (n - 1.0)))};
}

}  // namespace mirtest
