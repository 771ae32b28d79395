// SPDX-License-Identifier: MIT
#pragma once

#include "mir/validation/report.hpp"
#include "support/catch.hpp"

namespace mirtest {

/// Fails the test with what the report found.
inline void passes(const mir::validation::Report& report) {
    INFO(report.text());
    CHECK(report.passed());
}

}  // namespace mirtest
