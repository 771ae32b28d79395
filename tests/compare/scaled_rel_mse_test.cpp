// SPDX-License-Identifier: MIT
#include "mir/compare/scaled_rel_mse.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace {

using mir::Image;
using mir::Rgb;
using mir::scaled_rel_mse;
using mir::ScaledRelMse;
using mirtest::Approx;

using Picture = Image<Rgb>;

constexpr mir::Extent size{40, 25};  // 1000 pixels: five are 0.5 %

/// Light of the true picture, everywhere.
constexpr float truth = 2.0f;
/// Relative variance of the references: their own scaled relMSE but for epsilon.
constexpr double reference_variance = 1e-4;
/// Relative squared error of the image, a tenth of the references' own.
constexpr double image_error = 1e-5;
constexpr double epsilon_factor = 1.01;  // r^2 + 0.01 m^2 over r^2

Picture plain(float light) { return Picture(size, Rgb{light, light, light}); }

/// Too bright and too dark by turns, the mean being right.
Picture striped_image() {
    Picture p = plain(truth);
    const float error = truth * std::sqrt(static_cast<float>(image_error));
    for (std::size_t i = 0; i < p.pixels().size(); ++i)
        p.pixels()[i] += (i % 2 ? 1.0f : -1.0f) * Rgb{error, error, error};
    return p;
}

float gaussian(mir::Random& random) {
    const float radius = std::sqrt(-2.0f * std::log(1.0f - random.next()));
    return radius * std::cos(2.0f * std::numbers::pi_v<float> * random.next());
}

/// The truth with Gaussian noise of the references' variance.
Picture noisy_reference(std::uint64_t seed) {
    Picture p = plain(truth);
    const float sigma = truth * std::sqrt(static_cast<float>(reference_variance));
    std::uint32_t i = 0;
    for (Rgb& pixel : p.pixels()) {
        mir::Random random(seed, mir::Stream::test, i++);
        for (float* channel : {&pixel.r, &pixel.g, &pixel.b}) *channel += sigma * gaussian(random);
    }
    return p;
}

constexpr int pairs = 200;
constexpr double level = 1e-3;  // of each test of a mean; the seeds are those of the loops

}  // namespace

TEST_CASE("the scaled relative error is that worked out by hand") {
    Picture image({2, 1});
    Picture reference({2, 1});
    image(0, 0) = {2.0f, 1.0f, 1.0f};
    reference(0, 0) = {1.0f, 1.0f, 1.0f};
    image(1, 0) = {3.0f, 3.0f, 2.0f};
    reference(1, 0) = {3.0f, 3.0f, 3.0f};
    const double epsilon = 0.01 * 2.0 * 2.0;
    const double known = (1.0 / (1.0 + epsilon) + 1.0 / (9.0 + epsilon)) / 6.0;
    CHECK(scaled_rel_mse(image, reference).mean == Approx(known));
    CHECK(scaled_rel_mse(image, reference).trimmed == Approx(known));  // 0.5 % of 2 is no pixel
    CHECK(scaled_rel_mse(image, reference, {.worst_share = 0.5}).trimmed ==
          Approx(1.0 / (9.0 + epsilon) / 3.0));
}

TEST_CASE("with two references the error is a product, and their mean is the scale") {
    const Picture image({1, 1}, Rgb{4.0f, 4.0f, 4.0f});
    const Picture first({1, 1}, Rgb{1.0f, 1.0f, 1.0f});
    const Picture second({1, 1}, Rgb{3.0f, 3.0f, 3.0f});
    CHECK(scaled_rel_mse(image, first, second).mean == Approx(3.0 * 1.0 / (4.0 * 1.01)));
    CHECK(scaled_rel_mse(plain(2.0f), plain(1.0f), plain(3.0f)).mean == Approx(-1.0 / 4.04));
}

TEST_CASE("the scaled relative error does not depend on the unit of light") {
    Picture image = striped_image();
    Picture first = noisy_reference(1);
    Picture second = noisy_reference(2);
    const ScaledRelMse before = scaled_rel_mse(image, first, second);
    for (Picture* p : {&image, &first, &second})
        for (Rgb& pixel : p->pixels()) pixel = pixel * 1024.0f;
    CHECK(scaled_rel_mse(image, first, second).mean == Approx(before.mean));
    CHECK(scaled_rel_mse(image, first, second).trimmed == Approx(before.trimmed));
}

TEST_CASE("the trimmed error leaves out the worst 0.5 % of the pixels and no other") {
    const Picture reference = plain(truth);
    Picture image = striped_image();
    const double usual = image_error / epsilon_factor;
    for (const std::size_t i : {3, 77, 500, 501, 999})
        image.pixels()[i] = Rgb{100.0f, 100.0f, 100.0f};
    CHECK(scaled_rel_mse(image, reference).mean > 1.0);
    CHECK(scaled_rel_mse(image, reference).trimmed == Approx(usual).epsilon(1e-3));
    image.pixels()[42] = Rgb{100.0f, 100.0f, 100.0f};
    CHECK(scaled_rel_mse(image, reference).trimmed > 1.0);
}

TEST_CASE("pixels of equal error are left out in row order") {
    Picture image = plain(truth);
    Picture second = image;
    for (std::size_t i = 0; i < 10; ++i) {
        image.pixels()[i] = Rgb{3.0f, 3.0f, 3.0f};
        // Of the same mean of references, and so of the same rank, but not of the same product.
        if (i >= 5) second.pixels()[i] = Rgb{3.0f, 3.0f, 3.0f};
    }
    Picture first = plain(truth);
    for (std::size_t i = 5; i < 10; ++i) first.pixels()[i] = Rgb{1.0f, 1.0f, 1.0f};
    CHECK(scaled_rel_mse(image, first, second).trimmed == 0.0);
    CHECK(scaled_rel_mse(image, first, second).mean > 0.0);
}

TEST_CASE("two references give the error without their noise, one adds it", "[statistical]") {
    const Picture image = striped_image();
    const double known = image_error / epsilon_factor;
    mirtest::Moments both;
    mirtest::Moments one;
    for (int i = 0; i < pairs; ++i) {
        const Picture first = noisy_reference(2 * i);
        const Picture second = noisy_reference(2 * i + 1);
        both.add(scaled_rel_mse(image, first, second).mean);
        one.add(scaled_rel_mse(image, first).mean);
    }
    // Of second order: the denominator's noise.
    const double rounding = 2.0 * reference_variance * reference_variance;
    CHECK(mirtest::mean_p_value(both, known, rounding) > level);
    REQUIRE(both.standard_error() < 0.1 * known);
    CHECK(mirtest::mean_p_value(one, known, rounding) < 1e-9);
    CHECK(one.mean() == Approx((image_error + reference_variance) / epsilon_factor).epsilon(0.01));
}

TEST_CASE("the true picture has an error of zero, trimmed down by a fiftieth of the references'",
          "[statistical]") {
    mirtest::Moments mean;
    mirtest::Moments trimmed;
    for (int i = 0; i < pairs; ++i) {
        const ScaledRelMse e = scaled_rel_mse(plain(truth), noisy_reference(2 * i + 1000),
                                              noisy_reference(2 * i + 1001));
        mean.add(e.mean);
        trimmed.add(e.trimmed);
    }
    CHECK(mirtest::mean_p_value(mean, 0.0, 2.0 * reference_variance * reference_variance) > level);
    CHECK(std::fabs(trimmed.mean()) < reference_variance / 50.0);
}

TEST_CASE("black references make a difference infinite and none zero") {
    const Picture black = plain(0.0f);
    CHECK(scaled_rel_mse(black, black).mean == 0.0);
    CHECK(std::isinf(scaled_rel_mse(plain(1.0f), black).mean));
}

TEST_CASE("settings and pictures that make no sense are refused") {
    const Picture p = plain(truth);
    CHECK_THROWS_AS(scaled_rel_mse(p, p, {.epsilon = -1.0}), mir::Error);
    CHECK_THROWS_AS(scaled_rel_mse(p, p, {.epsilon = std::numeric_limits<double>::infinity()}),
                    mir::Error);
    for (const double share : {-0.1, 1.0, std::nan("")})
        CHECK_THROWS_AS(scaled_rel_mse(p, p, {.worst_share = share}), mir::Error);
    CHECK_THROWS_AS(scaled_rel_mse(p, p, Picture({3, 3})), mir::Error);
    CHECK_THROWS_AS(scaled_rel_mse(p, Picture({3, 3})), mir::Error);
}
