// SPDX-License-Identifier: MIT
//
// The path tracer against the published picture of a scene that others rendered.
#include "mir/io/exr.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "studio.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"

using namespace mirtest;

namespace {

/// Mean of each channel of a picture.
mir::RgbSum mean_of(const mir::Image<mir::Rgb>& image) {
    mir::RgbSum sum;
    for (const mir::Rgb& c : image.pixels()) sum += c;
    return sum * (1.0 / static_cast<double>(image.pixels().size()));
}

}  // namespace

// The published mean is itself a Monte Carlo estimate, good to about 0.1 %. Criterion: within 0.5 %
// a channel over 16 seeds from 611 on, whose standard error must be below 0.15 % for that to
// mean something.
TEST_CASE("the path tracer finds the mean of the published Cornell box", "[statistical]") {
    const auto scenes = shared_scenes();
    if (!scenes) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    const Studio<mir::CookTorrance> studio(
        mir::read_gltf(*scenes / "cornell-box/cornell-box.glb").scene);
    const mir::RgbSum expected =
        mean_of(mir::read_exr(*scenes / "cornell-box/reference.exr").image);
    const auto tracer = studio.tracer({});
    mir::TbbExecutor executor;
    mir::ReferenceOptions options;
    options.samples = options.replicates = 1;
    std::array<Moments, 3> moments;
    mir::CameraRays rays = studio.rays(64, 611);
    // Many luxels instead of samples: they are spread evenly over the edges of the lamp.
    rays.grid = mir::luxel_grid(rays.grid.pixels, 16);
    for (; rays.seed < 611 + 16; ++rays.seed) {
        const auto image = trace_reference(tracer, rays, options, executor);
        const mir::RgbSum mean = mean_of(image.beauty());
        for (std::size_t i = 0; i < 3; ++i) moments[i].add(mean.channel[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        CAPTURE(i, moments[i].mean(), moments[i].standard_error(), expected.channel[i]);
        CHECK(moments[i].standard_error() < 0.0015 * expected.channel[i]);
        CHECK(std::abs(moments[i].mean() - expected.channel[i]) < 0.005 * expected.channel[i]);
    }
}
