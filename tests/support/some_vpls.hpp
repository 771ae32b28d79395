// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"

namespace mirtest {

/// Two VPLs, the second black, of bounces 2 and 254.
inline mir::VplList some_vpls() {
    mir::VplList list;
    mir::VplOrigin origin;
    list.append({{1.5f, -2, 3e-7f}, {0, 1, 0}, {0.25f, 1e9f, 0}}, origin, 2);
    origin.triangle = 1;
    list.append({{4, 5, 6}, {-1, 0, 0}, {}}, origin, 254);
    return list;
}

}  // namespace mirtest
