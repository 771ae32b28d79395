// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shading/cook_torrance.hpp"

namespace mir {

/// Parameters of a Bsdf whose lobes are not narrower than the GGX width `least_alpha`. What the
/// interface reflects at each angle (f0, f90) stays, so that a wider lobe reflects less in all, as
/// a rougher surface does. Overloaded per model; one without lobes, or without an overload, does
/// not change. Source: Kaplanyan and Dachsbacher, "Path space regularization for holistic and
/// robust light transport", Eurographics 2013, for the idea.
template <class Params>
Params widened(const Params& p, float /*least_alpha*/) {
    return p;
}
/// The same of its GGX lobe, where it has one.
inline CookTorrance::Params widened(CookTorrance::Params p, float least_alpha) {
    if (p.has_lobe()) p.alpha = larger(p.alpha, least_alpha);
    return p;
}

/// Whether widened() changes them.
template <class Params>
bool is_widened(const Params& /*p*/, float /*least_alpha*/) {
    return false;
}
/// Whether the GGX lobe is narrower than that.
inline bool is_widened(const CookTorrance::Params& p, float least_alpha) {
    return p.has_lobe() && p.alpha < least_alpha;
}

}  // namespace mir
