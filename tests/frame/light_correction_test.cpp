// SPDX-License-Identifier: MIT
#include "runtime/light_correction.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

#include <cmath>

using mir::Image;
using mir::LightCorrection;
using mir::Rgb;

namespace {

constexpr mir::Extent cells{53, 39};

/// `light(x, y)` in every cell, with uniform noise of this relative size.
template <class Light>
Image<Rgb> image_of(const Light& light, float noise, std::uint64_t seed) {
    Image<Rgb> image(cells);
    mir::Random random(seed, mir::Stream::test, 0);
    for (std::uint32_t y = 0; y < cells.height; ++y)
        for (std::uint32_t x = 0; x < cells.width; ++x)
            image(x, y) = light(x, y) * (1.0f + noise * (2.0f * random.next() - 1.0f));
    return image;
}

Rgb striped(std::uint32_t x, std::uint32_t y) {
    return Rgb{1.0f, 2.0f, 0.5f} * static_cast<float>(1 + (x + y) % 3);
}

LightCorrection correction(const Image<Rgb>& estimate, const Image<Rgb>& truth) {
    mir::InlineExecutor executor;
    return {estimate, truth, executor};
}

}  // namespace

TEST_CASE("light that is right is not corrected") {
    const Image<Rgb> light = image_of(striped, 0.0f, 1);
    const LightCorrection factor = correction(light, light);
    for (const float u : {0.0f, 0.3f, 1.0f})
        for (const float v : {0.0f, 0.7f, 1.0f}) CHECK(factor(u, v) == Rgb{1.0f, 1.0f, 1.0f});
    const Image<Rgb> black(cells);
    CHECK(correction(black, black)(0.5f, 0.5f) == Rgb{1.0f, 1.0f, 1.0f});
    CHECK(correction(black, light)(0.5f, 0.5f) == Rgb{1.0f, 1.0f, 1.0f});
    CHECK(correction(light, black)(0.5f, 0.5f) == Rgb{1.0f, 1.0f, 1.0f});
}

// Noise of 100 % at each cell is 1.3 % of the sum of all cells and some 4 % of a neighbourhood.
TEST_CASE("noise is not made a correction", "[statistical]") {
    const Image<Rgb> estimate = image_of(striped, 0.0f, 1);
    double squares = 0.0;
    int places = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const LightCorrection factor = correction(estimate, image_of(striped, 1.0f, seed));
        for (float u = 0.05f; u < 1.0f; u += 0.1f)
            for (float v = 0.05f; v < 1.0f; v += 0.1f, ++places)
                squares += std::pow(static_cast<double>(luminance(factor(u, v))) - 1.0, 2.0);
    }
    CHECK(std::sqrt(squares / places) < 0.03);
}

TEST_CASE("what is wrong alike everywhere is corrected by channel", "[statistical]") {
    const auto wrong = [](std::uint32_t x, std::uint32_t y) {
        return striped(x, y) * Rgb{1.25f, 0.8f, 1.0f};
    };
    const LightCorrection factor = correction(image_of(wrong, 0.2f, 1), image_of(striped, 0.2f, 2));
    for (const float u : {0.0f, 0.5f, 1.0f}) {
        CHECK(factor(u, u).r == Approx(0.8).epsilon(0.02));
        CHECK(factor(u, u).g == Approx(1.25).epsilon(0.02));
        CHECK(factor(u, u).b == Approx(1.0).epsilon(0.02));
    }
}

TEST_CASE("regions are corrected by their own light, smoothly", "[statistical]") {
    const auto wrong = [](std::uint32_t x, std::uint32_t y) {
        return striped(x, y) * (x < cells.width / 2 ? 1.5f : 1.0f);
    };
    const LightCorrection factor = correction(image_of(wrong, 0.2f, 1), image_of(striped, 0.2f, 2));
    CHECK(luminance(factor(0.1f, 0.5f)) == Approx(1.0 / 1.5).epsilon(0.03));
    CHECK(luminance(factor(0.9f, 0.5f)) == Approx(1.0).epsilon(0.03));
    for (float u = 0.0f; u < 0.99f; u += 0.01f)
        CHECK(std::fabs(luminance(factor(u + 0.01f, 0.5f)) - luminance(factor(u, 0.5f))) < 0.05f);
}

TEST_CASE("no channel is changed by more than a factor of eight") {
    const auto dark = [](std::uint32_t x, std::uint32_t y) {
        return striped(x, y) * Rgb{1e-4f, 1.0f, 1e4f};
    };
    const Rgb f = correction(image_of(dark, 0.0f, 1), image_of(striped, 0.0f, 1))(0.5f, 0.5f);
    CHECK(f.r <= 1.0f / LightCorrection::least);
    CHECK(f.b >= LightCorrection::least);
}
