// SPDX-License-Identifier: MIT
#include "mir/metropolis/acceptance.hpp"

#include "support/catch.hpp"

#include <limits>

using mir::acceptance;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class F>
bool is_internal_error(const F& call) {
    try {
        call();
    } catch (const mir::Error& e) {
        return e.code() == mir::ErrorCode::internal;
    }
    return false;
}

}  // namespace

TEST_CASE("a symmetric proposal is accepted with the ratio of the targets, at most 1") {
    CHECK(acceptance(4.0, 1.0) == 0.25);
    CHECK(acceptance(1.0, 4.0) == 1.0);
    CHECK(acceptance(1.0, 1.0) == 1.0);
    CHECK(acceptance(1.0, 0.0) == 0.0);
}

TEST_CASE("the densities of both ways enter crosswise") {
    CHECK(acceptance(4.0, 1.0, 1.0, 1.0) == 0.25);
    CHECK(acceptance(4.0, 1.0, 1.0, 2.0) == 0.5);  // the way back is twice as likely
    CHECK(acceptance(4.0, 2.0, 1.0, 1.0) == 0.125);
    CHECK(acceptance(1.0, 0.1, 1.0, 1.0) == 1.0);
    CHECK(acceptance(1.0, 1.0, 0.0, 1.0) == 0.0);
    CHECK(acceptance(1.0, 1.0, 1.0, 0.0) == 0.0);
}

TEST_CASE("the extremes of the numbers' range give a probability") {
    for (double f_x : {1e-308, 1.0, 1e308})
        for (double f_y : {0.0, 5e-324, 1e308})
            for (double k : {1e-300, 1e300}) {
                CHECK((acceptance(f_x, f_y) >= 0.0 && acceptance(f_x, f_y) <= 1.0));
                const double a = acceptance(f_x, k, f_y, k);
                CHECK((a >= 0.0 && a <= 1.0));
            }
    CHECK(acceptance(1e-308, 1.0, 1e308, 0.0) == 0.0);
}

TEST_CASE("a state without contribution and numbers that are none are internal errors") {
    for (double bad : {not_a_number, infinity, -1.0}) {
        CAPTURE(bad);
        CHECK(is_internal_error([&] { acceptance(bad, 1.0); }));
        CHECK(is_internal_error([&] { acceptance(1.0, bad); }));
        CHECK(is_internal_error([&] { acceptance(bad, 1.0, 1.0, 1.0); }));
        CHECK(is_internal_error([&] { acceptance(1.0, bad, 1.0, 1.0); }));
        CHECK(is_internal_error([&] { acceptance(1.0, 1.0, bad, 1.0); }));
        CHECK(is_internal_error([&] { acceptance(1.0, 1.0, 1.0, bad); }));
    }
    CHECK(is_internal_error([] { acceptance(0.0, 1.0); }));
    CHECK(is_internal_error([] { acceptance(0.0, 1.0, 1.0, 1.0); }));
    CHECK(is_internal_error([] { acceptance(1.0, 0.0, 1.0, 1.0); }));
    CHECK(is_internal_error([] { acceptance(5e-324, 1e308, 1e308, 1e-308); }));
}
