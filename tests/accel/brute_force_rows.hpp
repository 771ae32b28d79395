// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/reach.hpp"
#include "mir/accel/kd/kd_tree.hpp"

#include <vector>

namespace mirtest {

/// The truth about visibility: hits_segment() asked of every triangle.
inline bool hidden_by_any(const std::vector<mir::TriangleRows>& triangles, float reach,
                          mir::Vec3 from, mir::Vec3 to) {
    const mir::CutSegment cut = mir::cut_to_reach(from, to, reach);
    if (cut.empty) return false;
    for (const mir::TriangleRows& rows : triangles)
        if (mir::hits_segment(rows, cut.from, cut.to)) return true;
    return false;
}

/// The truth about rays: keep_closer() asked of every triangle, from the last to the first.
inline mir::TriangleHit first_of_all(const std::vector<mir::TriangleRows>& triangles, float reach,
                                     const mir::Ray& ray) {
    const mir::CutSegment cut = mir::cut_to_reach(ray, reach);
    mir::TriangleHit best;
    if (cut.empty) return best;
    for (auto i = static_cast<std::uint32_t>(triangles.size()); i-- > 0;)
        mir::keep_closer(triangles[i], cut.from, cut.to, i, best);
    if (best.triangle != mir::TriangleHit::none) best.t = cut.t_from + best.t * cut.t_length;
    return best;
}

}  // namespace mirtest
