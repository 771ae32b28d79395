// SPDX-License-Identifier: MIT
#include "support/kolmogorov.hpp"

#include "support/catch.hpp"

using namespace mirtest;

TEST_CASE("the p-value of Kolmogorov and Smirnov agrees with tables") {
    // 1.628 and 1.358 are the asymptotic critical values of sqrt(n) D at 1 % and 5 %.
    const auto shifted = [](double distance) {
        std::vector<double> p(10000);
        for (std::size_t i = 0; i < p.size(); ++i)
            p[i] = std::min((static_cast<double>(i) + 0.5) / 10000.0 + distance, 1.0);
        return p;
    };
    CHECK(uniform_p_value(shifted(0.01628)) == Approx(0.01).epsilon(0.05));
    CHECK(uniform_p_value(shifted(0.01358)) == Approx(0.05).epsilon(0.05));
    CHECK(uniform_p_value(shifted(0.0)) == 1.0);
    CHECK(uniform_p_value(shifted(0.5)) < 1e-9);
    CHECK(kolmogorov_distance({0.0}) == 1.0);
    CHECK(kolmogorov_distance({0.25, 0.75}) == 0.25);
}
