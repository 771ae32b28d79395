// SPDX-License-Identifier: MIT
#pragma once

#include "mir/validation/report.hpp"

#include <string>

namespace mirtest {

/// True when a report says that `axiom` is broken, for whatever part.
inline bool finds(const mir::validation::Report& report, const std::string& axiom) {
    for (const mir::validation::Finding& f : report.findings())
        if (f.axiom.size() >= axiom.size() &&
            f.axiom.compare(f.axiom.size() - axiom.size(), axiom.size(), axiom) == 0)
            return true;
    return false;
}

/// True when it says that of nothing else.
inline bool finds_only(const mir::validation::Report& report, const std::string& axiom) {
    for (const mir::validation::Finding& f : report.findings()) {
        mir::validation::Report one;
        one.expect(false, f.axiom, f.found);
        if (!finds(one, axiom)) return false;
    }
    return finds(report, axiom);
}

}  // namespace mirtest
