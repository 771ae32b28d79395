// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide_traverse.hpp"
#include "mir/concepts/visibility.hpp"

namespace mir {

/// Answers from a wide bounding volume hierarchy in memory of space `S`: a value that may be passed
/// to a kernel. Model of Visibility. Gives the bits of hits_segment() asked of every triangle, on
/// the host and on the device. The hierarchy must outlive it. Thread-safe.
template <Space S>
struct WideBvhVisibility {
    static constexpr Space space = S;

    WideBvhView<S> bvh;

    [[nodiscard]] MIR_HD bool visible(Vec3 a, Vec3 b) const { return !is_hidden(bvh, a, b); }
};

static_assert(Visibility<WideBvhVisibility<Space::host>>);
static_assert(Visibility<WideBvhVisibility<Space::device>>);

}  // namespace mir
