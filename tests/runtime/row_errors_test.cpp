// SPDX-License-Identifier: MIT
#include "mir/runtime/row_errors.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <vector>

using mir::error_of_rows;
using mirtest::Approx;

TEST_CASE("independent rows tell the error of their mean") {
    // Uniform numbers have variance 1/12; 4096 rows know their own variance to 4 %.
    mir::Random random(71, mir::Stream::test, 0);
    std::vector<double> rows(4096);
    for (double& row : rows) row = 3.0 * static_cast<double>(random.next());
    const auto error = error_of_rows(rows, 1, rows.size());
    REQUIRE(error);
    CHECK(*error == Approx(3.0 * std::sqrt(1.0 / 12.0 / 4096.0)).epsilon(0.1));
}

TEST_CASE("rows of luxels count together where they make one row of pixels") {
    // Two rows of luxels of each pixel that cancel each other leave no error.
    std::vector<double> rows;
    for (int y = 0; y < 12; ++y) {
        const double noise = y % 3 == 0 ? 0.5 : -0.25;
        rows.push_back(1.0 + noise);
        rows.push_back(1.0 - noise);
    }
    CHECK_FALSE(error_of_rows(rows, 2, 24));
    CHECK(error_of_rows(rows, 1, 24).value() > 0.0);
}

TEST_CASE("a picture that changes evenly has no error by its rows") {
    std::vector<double> rows;
    for (int y = 0; y < 20; ++y) rows.push_back(5.0 + 0.25 * y);
    CHECK_FALSE(error_of_rows(rows, 1, 20));
    rows[7] += 0.3;
    // One row by 0.3, and its neighbours' expectations by half of that: 1.5 d^2 over 1.5 (n - 2).
    CHECK(error_of_rows(rows, 1, 20).value() == Approx(std::sqrt(0.09 / 18.0 * 20.0) / 20.0));
}

TEST_CASE("fewer than three rows and black ones tell nothing") {
    CHECK_FALSE(error_of_rows({}, 1, 1));
    CHECK_FALSE(error_of_rows(std::vector{1.0, 2.0}, 1, 2));
    CHECK_FALSE(error_of_rows(std::vector<double>(6, 1.5), 3, 6));
    CHECK_FALSE(error_of_rows(std::vector<double>(6, 0.0), 1, 6));
}
