// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"

#include <nanobind/nanobind.h>

#include <limits>
#include <optional>
#include <vector>

namespace mirpy {

/// VPLs as Python holds them.
struct PyVpls {
    std::vector<mir::Vpl> vpls;
    mir::VplList list;  ///< what they are made of; empty for those from arrays
    float bound = std::numeric_limits<float>::max();  ///< largest geometry term, m^-2

    [[nodiscard]] mir::VplSpan<mir::Space::host> span() const { return mir::span_of(vpls); }
};

/// VPLs of a list, with all their light.
PyVpls vpls_of(mir::VplList list, float bound);

/// What an argument `vpls` holds.
/// @throws ArgumentError for what is no Vpls.
const PyVpls& vpls_in(nanobind::handle vpls);

/// The bound that a call gives, or that of the VPLs.
/// @throws ArgumentError for one that is not positive.
float bound_of(const PyVpls& vpls, const std::optional<float>& bound);

/// Declares the class Vpls.
void bind_vpls(nanobind::module_& m);

}  // namespace mirpy
