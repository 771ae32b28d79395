// SPDX-License-Identifier: MIT
#include "tool/compared_pictures.hpp"

using namespace mirtest;
using namespace mirtest::compared;
using nlohmann::json;

TEST_CASE("a second reference takes part in the scaled relMSE alone") {
    const Pictures p;
    const std::string second = store(p.folder / "second.exr", plain(0.7f));
    const json one = metrics({p.a, p.b});
    const json two = metrics({p.a, p.b, "--second-reference", second});
    CHECK(two.at("second_reference") == second);
    for (const char* key : {"mse", "relmse", "mae", "flip", "mean_radiance"})
        CHECK(two.at(key) == one.at(key));
    CHECK(two.at("scaled_relmse").at("trimmed").get<double>() ==
          Approx(0.1 * -0.1 / (0.36 * 1.01)));
    const json half = metrics({p.a, p.b, "--second-reference", second, "--layer", "half"});
    CHECK(half.at("scaled_relmse").at("trimmed").get<double>() ==
          Approx(two.at("scaled_relmse").at("trimmed").get<double>()));
    const Outcome people = compare({p.a, p.b, "--second-reference", second});
    CHECK(has(people.out, second));
    CHECK(has(people.out, "noise of the references left out"));
}

TEST_CASE("a second reference is held to what the first is") {
    const Pictures p;
    const auto with = [&](const std::string& file) {
        return Words{p.a, p.b, "--second-reference", file};
    };
    check_failure(compare(with("no.exr")), 3, "no.exr");
    const std::string small = store(p.folder / "small.exr", Picture({3, 2}));
    check_failure(compare(with(small)), 3, "small.exr has 3x2");
    const std::string second = store(p.folder / "second.exr", plain(0.7f));
    check_failure(compare(with(second) + Words{"--error", second}), 2, "would replace");
}
