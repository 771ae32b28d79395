// SPDX-License-Identifier: MIT
#include "mir/validation/report.hpp"

#include "support/catch.hpp"

using mir::validation::Report;

TEST_CASE("A report passes when all that was checked holds, and never when nothing was") {
    Report report;
    CHECK_FALSE(report.passed());
    report.expect(true, "one is one", "it is two");
    CHECK(report.passed());
    CHECK(report.checks() == 1);
    CHECK(report.text().empty());
    report.expect(false, "one is two", "it is one");
    CHECK_FALSE(report.passed());
    CHECK(report.text() == "one is two: it is one\n");
}

TEST_CASE("A report takes over the findings of its parts with their names") {
    Report part;
    part.expect(false, "light is positive", "-1");
    part.expect(true, "light is finite", "");
    Report whole;
    whole.add("lamp", part);
    CHECK(whole.checks() == 2);
    REQUIRE(whole.findings().size() == 1);
    CHECK(whole.findings()[0].axiom == "lamp: light is positive");
    CHECK(whole.text() == "lamp: light is positive: -1\n");
}
