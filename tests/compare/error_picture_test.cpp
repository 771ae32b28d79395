// SPDX-License-Identifier: MIT
#include "mir/compare/error_picture.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using mir::Image;
using mir::Rgb;
using mirtest::Approx;

using Picture = Image<Rgb>;

/// A row of errors, grey.
Picture row(const std::vector<float>& values) {
    Picture p({static_cast<std::uint32_t>(values.size()), 1});
    for (std::size_t i = 0; i < values.size(); ++i)
        p.pixels()[i] = {values[i], values[i], values[i]};
    return p;
}

bool is_grey(Rgb c) { return c.r == c.g && c.g == c.b; }

/// True when brighter errors come out red and darker ones blue.
template <class Paint>
bool has_right_signs(const Paint& paint) {
    const Picture picture = paint(row({2.0f, -2.0f, 0.0f}), 1.0f);
    const Rgb up = picture(0, 0);
    const Rgb down = picture(1, 0);
    return up.r > up.b && down.b > down.r && is_grey(picture(2, 0));
}

}  // namespace

TEST_CASE("the difference is image minus reference and changes its sign with their order") {
    Picture a({2, 1});
    Picture b({2, 1});
    a(1, 0) = {1.0f, 2.0f, 3.0f};
    b(1, 0) = {3.0f, 2.0f, 1.5f};
    CHECK(mir::difference(a, b)(1, 0) == Rgb{-2.0f, 0.0f, 1.5f});
    CHECK(mir::difference(b, a)(1, 0) == Rgb{2.0f, 0.0f, -1.5f});
    CHECK_THROWS_AS(mir::difference(a, Picture({1, 2})), mir::Error);
}

TEST_CASE("too bright is red, too dark is blue, no error is grey") {
    CHECK(has_right_signs(mir::signed_error_picture));
}

TEST_CASE("an error picture that forgets the sign is rejected") {
    REQUIRE_FALSE(has_right_signs([](Picture errors, float range) {
        for (Rgb& e : errors.pixels()) e = {std::fabs(e.r), std::fabs(e.g), std::fabs(e.b)};
        return mir::signed_error_picture(errors, range);
    }));
}

TEST_CASE("an error picture is in full colour from its range on and half way there at half of it") {
    const Picture p = mir::signed_error_picture(row({0.0f, 0.5f, 1.0f, 9.0f}), 1.0f);
    CHECK(p(2, 0) == p(3, 0));
    CHECK(p(1, 0).b == Approx(0.5f * (p(0, 0).b + p(2, 0).b)));
}

TEST_CASE("an error picture with a range of zero shows the sign alone") {
    const Picture p = mir::signed_error_picture(row({0.0f, 1e-6f, -1e-6f}), 0.0f);
    CHECK(is_grey(p(0, 0)));
    CHECK(p(1, 0).r > p(1, 0).b);
    CHECK(p(2, 0).b > p(2, 0).r);
}

TEST_CASE("the range of errors leaves out a hundredth and whatever is zero") {
    std::vector<float> values(1000, 0.0f);
    for (std::size_t i = 0; i < 100; ++i) values[i] = i < 99 ? -1.0f : 1000.0f;
    CHECK(mir::error_range(row(values)) == Approx(1.0f));
    CHECK(mir::error_range(row({0.0f, 0.0f})) == 0.0f);
    CHECK(mir::error_range(row({0.0f, -3.0f})) == Approx(3.0f));
}

TEST_CASE("a FLIP picture grows brighter with the error and clamps beyond 0 and 1") {
    Image<float> errors({19, 1});
    for (std::uint32_t x = 0; x < 19; ++x) errors(x, 0) = (static_cast<float>(x) - 1.0f) / 16.0f;
    const Picture p = mir::flip_picture(errors);
    for (std::uint32_t x = 1; x < 17; ++x)
        CHECK(mir::luminance(p(x, 0)) < mir::luminance(p(x + 1, 0)));
    CHECK(p(0, 0) == p(1, 0));
    CHECK(p(18, 0) == p(17, 0));
}
