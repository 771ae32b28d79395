// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// How paths find emissive triangles and the environment. All three have the same expectation.
enum class LightSearch {
    mis,        ///< light samples and scattered directions, weighted by PathRules::mis
    lamps,      ///< explicit: light samples alone; lamps that directions hit do not count, nor does
                ///< the environment where they escape
    directions  ///< implicit: scattered directions alone
};

}  // namespace mir
