// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_traverse.hpp"
#include "mir/concepts/visibility.hpp"

namespace mirtest {

/// hits_segment() with one product of each row fused into the sum that follows, as a compiler that
/// may contract does it: a mistake that comparisons of bits have to notice.
[[nodiscard]] MIR_HD inline bool hits_fused(const mir::TriangleRows& rows, mir::Vec3 from,
                                            mir::Vec3 to) {
    const auto at = [](mir::AffineRow r, mir::Vec3 p) {
        return fmaf(r.z, p.z, r.x * p.x + r.y * p.y) + r.w;
    };
    const float s_from = at(rows.s, from);
    const float s_to = at(rows.s, to);
    if (!mir::detail::opposite(s_from, s_to)) return false;
    const mir::detail::RowsAtEnds ends{at(rows.u, from), at(rows.v, from), s_from,
                                       at(rows.u, to),   at(rows.v, to),   s_to};
    return mir::detail::is_crossed(rows, from, to, ends, mir::detail::crossing(ends));
}

/// A kd-tree's visibility by hits_fused(). Ends must be within the tree's reach.
template <mir::Space S>
struct FusedVisibility {
    static constexpr mir::Space space = S;

    mir::KdTreeView<S> tree;

    /// Leaf visitor.
    struct FindAny {
        const mir::KdTreeView<S>& tree;
        mir::Vec3 from{0};
        mir::Vec3 to{0};

        MIR_HD bool operator()(mir::KdNode leaf, float) const {
            for (std::uint32_t i = 0; i != leaf.count(); ++i)
                if (hits_fused(tree.triangles[tree.references[leaf.first() + i]], from, to))
                    return true;
            return false;
        }
    };

    [[nodiscard]] MIR_HD bool visible(mir::Vec3 a, mir::Vec3 b) const {
        FindAny any{tree, a, b};
        return !mir::detail::walk(tree, a, b, any);
    }
};

}  // namespace mirtest
