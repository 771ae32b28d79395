// SPDX-License-Identifier: MIT
#include "mir/io/radiance_code.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/inflate_radiance.hpp"

namespace {

using mir::Image;
using mir::Rgb;
using mirtest::inflate_radiance;

/// Largest error of a channel in units of the sum of the pixel's channels.
double largest_error(const Image<Rgb>& image, const Image<Rgb>& decoded) {
    double largest = 0.0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        const Rgb a = image.pixels()[i];
        const Rgb d = decoded.pixels()[i] - a;
        for (const float e : {d.r, d.g, d.b})
            largest = std::max(
                largest, static_cast<double>(std::fabs(e)) / static_cast<double>(a.r + a.g + a.b));
    }
    return largest;
}

/// Pixels of all colours, from 10^-9 to 10^9, without order.
Image<Rgb> wild(mir::Extent extent) {
    Image<Rgb> image(extent);
    mir::Random random(5, mir::Stream::luxel, 0);
    for (Rgb& pixel : image.pixels()) {
        const float light = std::pow(10.0f, 18.0f * random.next() - 9.0f);
        pixel = {light * random.next(), light * random.next(), light * random.next()};
    }
    return image;
}

}  // namespace

TEST_CASE("a radiance code keeps the brightness to 0.6 % and the colour to an eighth bit") {
    for (const mir::Extent extent : {mir::Extent{37, 29}, mir::Extent{1, 40}, mir::Extent{40, 1}}) {
        const Image<Rgb> image = wild(extent);
        const Image<Rgb> decoded = inflate_radiance(mir::deflate_radiance(image), extent);
        // Half a step of the sum, and of two shares for blue.
        CHECK(largest_error(image, decoded) < 0.0055 + 1.0 / 255.0);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            const Rgb a = image.pixels()[i];
            const Rgb b = decoded.pixels()[i];
            CHECK(b.r + b.g + b.b == mirtest::Approx(a.r + a.g + a.b).epsilon(0.0055));
        }
    }
}

TEST_CASE("grey stays grey, black stays black, what is no light becomes black") {
    Image<Rgb> image({4, 1}, Rgb{0.25f, 0.25f, 0.25f});
    image(1, 0) = {-1.0f, std::nanf(""), 0.0f};
    image(2, 0) = {-0.5f, 2.0f, 0.0f};
    const Image<Rgb> decoded = inflate_radiance(mir::deflate_radiance(image), {4, 1});
    CHECK(decoded(0, 0).r == mirtest::Approx(decoded(0, 0).b));
    CHECK(decoded(0, 0) == decoded(3, 0));
    CHECK(decoded(1, 0) == Rgb{});
    CHECK(decoded(2, 0).r == 0.0f);
    CHECK(decoded(2, 0).g == mirtest::Approx(2.0f).epsilon(0.0055));
    const Image<Rgb> black({3, 2});
    const Image<Rgb> still_black = inflate_radiance(mir::deflate_radiance(black), {3, 2});
    for (const Rgb& pixel : still_black.pixels()) CHECK(pixel == Rgb{});
}

TEST_CASE("smooth pictures are coded in less than a byte per pixel, none has no code") {
    Image<Rgb> image({256, 256});
    for (std::uint32_t y = 0; y < 256; ++y)
        for (std::uint32_t x = 0; x < 256; ++x) {
            const float light = 0.1f + 1e-5f * static_cast<float>(x * x + y * y);
            image(x, y) = {light, 0.8f * light, 0.5f * light};
        }
    CHECK(mir::deflate_radiance(image).size() < 256u * 256u);
    CHECK_THROWS_AS(mir::deflate_radiance(Image<Rgb>()), mir::Error);
}
