// SPDX-License-Identifier: MIT
#include "mir/compare/metrics.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace {

using mir::Image;
using mir::ImageMetrics;
using mir::Rgb;
using mirtest::Approx;

using Picture = Image<Rgb>;

/// Two pixels whose differences are 1, -0.5, 0 and 0, 0.25, -2, with epsilon 0.01:
/// squares 1, 0.25, 0, 0, 0.0625, 4 add up to 5.3125;
/// b^2 + epsilon are 1.01, 1.01, 0.26, 0.01, 0.01, 4.01.
const Picture& tiny_image() {
    static const Picture image = [] {
        Picture p({2, 1});
        p(0, 0) = {2.0f, 0.5f, 0.5f};
        p(1, 0) = {0.0f, 0.25f, 0.0f};
        return p;
    }();
    return image;
}

const Picture& tiny_reference() {
    static const Picture image = [] {
        Picture p({2, 1});
        p(0, 0) = {1.0f, 1.0f, 0.5f};
        p(1, 0) = {0.0f, 0.0f, 2.0f};
        return p;
    }();
    return image;
}

/// True when `compare(image, reference)` gives the relative error worked out by hand.
template <class Compare>
bool has_known_rel_mse(const Compare& compare) {
    const double known = (1.0 / 1.01 + 0.25 / 1.01 + 0.0625 / 0.01 + 4.0 / 4.01) / 6.0;
    return std::fabs(compare(tiny_image(), tiny_reference()) - known) < 1e-12;
}

Picture random_picture(std::uint64_t seed, mir::Extent extent = {16, 12}) {
    Picture p(extent);
    std::uint32_t i = 0;
    for (Rgb& pixel : p.pixels()) {
        mir::Random random(seed, mir::Stream::test, i++);
        pixel = {random.next(), random.next(), random.next()};
    }
    return p;
}

/// The message of the error that comparing throws.
std::string refusal(const Picture& a, const Picture& b) {
    try {
        mir::check_comparable(a, b, "a.exr", "b.exr");
    } catch (const mir::Error& error) {
        CHECK(error.code() == mir::ErrorCode::invalid_input);
        return error.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("the metrics of two pixels are those worked out by hand") {
    const ImageMetrics m = mir::compare_images(tiny_image(), tiny_reference());
    CHECK(m.mse == Approx(5.3125 / 6.0));
    CHECK(m.rmse() == Approx(std::sqrt(5.3125 / 6.0)));
    CHECK(m.mae == Approx(3.75 / 6.0));
    CHECK(m.mean[0] == Approx(1.0));
    CHECK(m.mean[1] == Approx(0.375));
    CHECK(m.mean[2] == Approx(0.25));
    CHECK(m.reference_mean[0] == Approx(0.5));
    CHECK(m.reference_mean[1] == Approx(0.5));
    CHECK(m.reference_mean[2] == Approx(1.25));
    CHECK(m.mean_difference() == Approx(1.0));
    CHECK(m.largest.value == -2.0);
    CHECK(m.largest.x == 1);
    CHECK(m.largest.y == 0);
    CHECK(m.largest.channel == 2);
}

TEST_CASE("the relative error is that of the reference's scale") {
    CHECK(has_known_rel_mse(
        [](const Picture& a, const Picture& b) { return mir::compare_images(a, b).rel_mse; }));
}

TEST_CASE("a relative error normalised by the image instead of the reference is rejected") {
    REQUIRE_FALSE(has_known_rel_mse(
        [](const Picture& a, const Picture& b) { return mir::compare_images(b, a).rel_mse; }));
}

TEST_CASE("a relative error with another epsilon is rejected") {
    REQUIRE_FALSE(has_known_rel_mse([](const Picture& a, const Picture& b) {
        return mir::compare_images(a, b, 0.001).rel_mse;
    }));
}

TEST_CASE("an image does not differ from itself") {
    const Picture p = random_picture(1);
    for (const double epsilon : {mir::default_rel_mse_epsilon, 0.0}) {
        const ImageMetrics m = mir::compare_images(p, p, epsilon);
        CHECK(m.mse == 0.0);
        CHECK(m.rel_mse == 0.0);
        CHECK(m.mae == 0.0);
        CHECK(m.mean_difference() == 0.0);
        CHECK(m.largest.value == 0.0);
    }
}

TEST_CASE("squared and absolute errors are symmetric, the largest difference changes its sign") {
    const Picture a = random_picture(2);
    const Picture b = random_picture(3);
    const ImageMetrics ab = mir::compare_images(a, b);
    const ImageMetrics ba = mir::compare_images(b, a);
    CHECK(ab.mse == ba.mse);
    CHECK(ab.mae == ba.mae);
    CHECK(ab.mean == ba.reference_mean);
    CHECK(ab.largest.value == -ba.largest.value);
    CHECK(std::pair(ab.largest.x, ab.largest.y) == std::pair(ba.largest.x, ba.largest.y));
    CHECK(ab.rel_mse != ba.rel_mse);
}

TEST_CASE("the relative error without epsilon does not depend on the unit of light") {
    Picture a = random_picture(2);
    Picture b = random_picture(3);
    const double before = mir::compare_images(a, b, 0.0).rel_mse;
    for (Picture* image : {&a, &b})
        for (Rgb& pixel : image->pixels()) pixel = pixel * 1024.0f;
    CHECK(mir::compare_images(a, b, 0.0).rel_mse == Approx(before));
}

TEST_CASE("means of zero are equal to each other and infinitely far from others") {
    Picture black({3, 3});
    CHECK(mir::compare_images(black, black).mean_difference() == 0.0);
    Picture lit = black;
    lit(1, 1).g = 1.0f;
    CHECK(std::isinf(mir::compare_images(lit, black).mean_difference()));
    CHECK(mir::compare_images(black, lit).mean_difference() == 1.0);
}

TEST_CASE("differences beyond float are measured") {
    const float huge = std::numeric_limits<float>::max();
    const Picture a({1, 1}, Rgb{huge, huge, huge});
    const Picture b({1, 1}, Rgb{-huge, -huge, -huge});
    CHECK(mir::compare_images(a, b).mae == Approx(2.0 * static_cast<double>(huge)));
}

TEST_CASE("NaN and infinity are refused with image, number and place") {
    const Picture good = random_picture(4);
    CHECK(refusal(good, good).empty());
    Picture bad = good;
    bad(5, 7).g = std::nanf("");
    bad(3, 8).b = -std::numeric_limits<float>::infinity();
    const std::string text = refusal(good, bad);
    CHECK(has(text, "b.exr: 2 of 192 pixels are NaN or infinite, the first at (5, 7)"));
    CHECK(has(refusal(bad, good), "a.exr: 2 of 192"));
    CHECK_THROWS_AS(mir::compare_images(bad, good), mir::Error);
}

TEST_CASE("images of different size and empty ones are refused") {
    CHECK(has(refusal(random_picture(1), random_picture(1, {12, 16})),
              "a.exr has 16x12 pixels and b.exr has 12x16"));
    CHECK(has(refusal(Picture{}, Picture{}), "a.exr has no pixels"));
}

TEST_CASE("an epsilon that is no finite number from 0 up is refused") {
    const Picture p = random_picture(1);
    for (const double epsilon :
         {-0.01, static_cast<double>(std::nanf("")), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(mir::compare_images(p, p, epsilon), mir::Error);
}
