// SPDX-License-Identifier: MIT
#include "mir/film/filter.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace {

using mir::Filter;
using mir::FilterKind;
using mirtest::Approx;

const Filter stretched{FilterKind::lanczos, 4.0f, 3.0f};

double integral(const Filter& filter) {
    constexpr int steps = 200'000;
    const double width = 2.0 * static_cast<double>(filter.half_width);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        sum += filter.along(static_cast<float>((i + 0.5) / steps * width - width / 2));
    return sum * width / steps;
}

double sum_of_shifts(const Filter& filter, float offset) {
    double sum = 0.0;
    for (int k = -8; k <= 8; ++k) sum += filter.along(offset + static_cast<float>(k));
    return sum;
}

}  // namespace

TEST_CASE("sin_pi is zero at the integers and follows the sine elsewhere") {
    for (int k = -50; k <= 50; ++k) CHECK(mir::sin_pi(static_cast<float>(k)) == 0.0f);
    for (int i = -4000; i <= 4000; ++i) {
        const float x = static_cast<float>(i) / 512.0f;
        CHECK(std::fabs(mir::sin_pi(x) - std::sin(3.14159265358979323846 * x)) < 2e-7);
    }
}

TEST_CASE("filters have their textbook values") {
    CHECK(mir::filter_named("box").along(0.49f) == 1.0f);
    CHECK(mir::filter_named("box").along(-0.5f) == 0.5f);
    CHECK(mir::filter_named("tent").along(0.25f) == 0.75f);
    const Filter gaussian = mir::filter_named("gaussian");
    CHECK(gaussian.along(1.0f) == Approx(std::exp(-2.0) - std::exp(-8.0)));
    const Filter mitchell = mir::filter_named("mitchell");
    CHECK(mitchell.along(0.0f) == Approx(8.0 / 9.0));
    CHECK(mitchell.along(1.0f) == Approx(1.0 / 18.0));
    CHECK(mitchell.along(-1.5f) == Approx(-5.0 / 144.0));
    const Filter lanczos = mir::filter_named("lanczos");
    CHECK(lanczos.along(0.0f) == 1.0f);
    CHECK(lanczos.along(0.5f) == Approx(0.6079271));    // sinc(1/2) sinc(1/6)
    CHECK(lanczos.along(-1.5f) == Approx(-0.1350949));  // sinc(3/2) sinc(1/2)
}

TEST_CASE("the default Lanczos filter is exactly zero at every integer but 0") {
    const Filter lanczos;
    CHECK(lanczos == mir::filter_named("lanczos"));
    for (const float d : {1.0f, 2.0f, 3.0f, 4.0f}) {
        CHECK(lanczos.along(d) == 0.0f);
        CHECK(lanczos.along(-d) == 0.0f);
    }
}

TEST_CASE("half-width 4 with tau 3 stretches the zeros to 4/3 of a pixel") {
    CHECK(std::fabs(stretched.along(4.0f / 3.0f)) < 1e-6f);
    CHECK(stretched.along(1.0f) > 0.2f);
    CHECK(stretched.along(2.0f) < -0.05f);
}

TEST_CASE("filters are even, continuous and zero from their half-width on") {
    for (const Filter& filter :
         {mir::filter_named("tent"), mir::filter_named("gaussian"), mir::filter_named("mitchell"),
          mir::filter_named("lanczos"), stretched}) {
        INFO(mir::to_string(filter.kind));
        for (int i = 0; i < 5000; ++i) {
            const float d = static_cast<float>(i) / 1000.0f;
            CHECK(filter.along(d) == filter.along(-d));
            CHECK(std::fabs(filter.along(d + 1e-3f) - filter.along(d)) < 3e-3f);
            if (d >= filter.half_width) CHECK(filter.along(d) == 0.0f);
        }
        CHECK(filter.along(std::numeric_limits<float>::quiet_NaN()) == 0.0f);
    }
}

TEST_CASE("box, tent and Mitchell are partitions of unity and integrate to one") {
    for (const char* name : {"box", "tent", "mitchell"}) {
        const Filter filter = mir::filter_named(name);
        INFO(name);
        CHECK(integral(filter) == Approx(1.0).margin(1e-5));
        for (const float offset : {0.0f, 0.1f, 0.5f, 0.77f})
            CHECK(sum_of_shifts(filter, offset) == Approx(1.0).margin(1e-5));
    }
}

TEST_CASE("the Lanczos filter is nearly a partition of unity and has negative lobes") {
    // Its ripple is the reason why Film divides by the sum of the weights.
    const Filter lanczos;
    CHECK(integral(lanczos) == Approx(0.997).margin(1e-3));
    for (const float offset : {0.0f, 0.1f, 0.5f, 0.77f})
        CHECK(sum_of_shifts(lanczos, offset) == Approx(1.0).margin(0.012));
    CHECK(lanczos(1.5f, 0.0f) < -0.1f);
}

TEST_CASE("a filter is the product of its two axes") {
    const Filter mitchell = mir::filter_named("mitchell");
    CHECK(mitchell(0.3f, -1.2f) == mitchell.along(0.3f) * mitchell.along(-1.2f));
}

TEST_CASE("a filter can be named, and an unknown name is answered with the list") {
    for (const mir::FilterName& entry : mir::filter_names) {
        CHECK(mir::filter_named(entry.name).kind == entry.kind);
        CHECK(mir::to_string(entry.kind) == entry.name);
    }
    try {
        static_cast<void>(mir::filter_named("Lanczos"));
        FAIL("an unknown name was taken");
    } catch (const mir::Error& error) {
        CHECK(error.code() == mir::ErrorCode::invalid_argument);
        const std::string what = error.what();
        CHECK(what.find("'Lanczos'") != std::string::npos);
        CHECK(what.find("box, tent, gaussian, mitchell, lanczos") != std::string::npos);
    }
}
