// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/space.hpp"
#include "mir/data/tile.hpp"
#include "mir/data/vpl.hpp"

#include <concepts>

namespace mir {

/// A view of geometric VPLs.
///
/// Axiom: size and elements do not change while the view exists.
template <class P>
concept VplSet = DeviceCopyable<P> && requires(const P p, VplIndex j) {
    { P::space } -> std::convertible_to<Space>;
    { p.size() } -> std::same_as<std::uint32_t>;
    { p[j] } -> std::convertible_to<Vpl>;
};

}  // namespace mir
