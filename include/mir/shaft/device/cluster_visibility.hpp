// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/quantised_bvh.hpp"
#include "mir/concepts/visibility.hpp"

#include <type_traits>

namespace mir {

/// What backends need to decide the visibility of clusters by shafts. That is a wide hierarchy for
/// shafts, and an engine for the segments that are left. Model of Visibility by that engine alone,
/// which must give the bits of hits_segment() asked of every triangle of the hierarchy, as those of
/// mir/accel/ do. Thread-safe; both must outlive it.
template <Visibility V>
struct ClusterVisibility {
    static constexpr Space space = V::space;  ///< of hierarchy and engine

    QuantisedBvhView<V::space> bvh;  ///< of all triangles, for shafts
    float sigma = 0.0f;              ///< of the scene (accept_box.hpp), metres
    V segments;                      ///< the engine

    /// What the engine says; no shaft is asked.
    [[nodiscard]] MIR_HD bool visible(Vec3 a, Vec3 b) const { return segments.visible(a, b); }
};

/// A Visibility that brings what shafts need.
template <class V>
concept ShaftableVisibility = Visibility<V> && requires(const V v) {
    { v.bvh } -> std::convertible_to<QuantisedBvhView<V::space>>;
    { v.sigma } -> std::convertible_to<float>;
    requires Visibility<std::remove_cvref_t<decltype(v.segments)>>;
};

/// The same of a scene whose triangles are not all opaque. Shafts and `segments` know the opaque
/// ones, `veil` the others. Model of Visibility by both engines: a segment is open if both say so.
template <Visibility V, Visibility W>
struct VeiledClusterVisibility {
    static constexpr Space space = V::space;  ///< of hierarchies and engines

    QuantisedBvhView<V::space> bvh;       ///< of the opaque triangles, for shafts
    float sigma = 0.0f;                   ///< of the scene (accept_box.hpp), metres
    V segments;                           ///< by the opaque triangles
    QuantisedBvhView<V::space> veil_bvh;  ///< of the others
    W veil;                               ///< by the others

    /// What both engines say; no shaft is asked.
    [[nodiscard]] MIR_HD bool visible(Vec3 a, Vec3 b) const {
        return segments.visible(a, b) && veil.visible(a, b);
    }
};

/// A ShaftableVisibility with triangles that shafts do not know.
template <class V>
concept VeiledVisibility = ShaftableVisibility<V> && requires(const V v) {
    { v.veil_bvh } -> std::convertible_to<QuantisedBvhView<V::space>>;
    requires Visibility<std::remove_cvref_t<decltype(v.veil)>>;
};

}  // namespace mir
