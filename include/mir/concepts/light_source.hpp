// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/ray.hpp"
#include "mir/core/space.hpp"
#include "mir/data/light_point.hpp"

#include <concepts>

namespace mir {

/// One light: where it shines from and to, how much, and how likely. Choices of places and
/// directions have these odds.
///
/// - `origin` says whether rays meet it, and `has_extent` whether a point or direction is drawn.
/// - `sample(u, from)` is a point for a receiver at `from`: next-event estimation. `start(u, side)`
///   is one for a light path; `side` in [0, 1) picks a side. `u` lies in the unit square.
/// - `ray(position, normal, u)` leaves such a point. `ray_density(normal, w, cosine, d2)` is the
///   density per m^2 with which it meets a surface along the unit vector `w`, at the squared
///   distance `d2` and with cosine `cosine` there.
/// - `share(normal, w)` is what leaves a point along `w`, as a factor of its emission. A receiver
///   that faces the light gets emission share / d2, W m^-2; from outside d2 is 1.
/// - `flux(point, w, probability)` is the power, W, of a light path that starts at `point` along
///   `w`, where the light itself was drawn with this probability.
///
/// Axioms (tests/conformance/light_source_suite.hpp): flux(p, w, 1) is emission share over all
/// densities, and its mean the light's power; rays follow ray_density(); sample() and start() mean
/// the same light; nothing depends on anything but the arguments.
template <class L>
concept LightSource = DeviceCopyable<L> &&
    requires(const L l, Vec2 u, Vec3 v, float x, const LightPoint& p) {
    { L::origin } -> std::convertible_to<LightOrigin>;
    { L::has_extent } -> std::convertible_to<bool>;
    { l.sample(u, v) } -> std::same_as<LightPoint>;
    { l.start(u, x) } -> std::same_as<LightPoint>;
    { l.ray(v, v, u) } -> std::same_as<Ray>;
    { l.ray_density(v, v, x, x) } -> std::same_as<double>;
    { l.share(v, v) } -> std::same_as<float>;
    { l.flux(p, v, x) } -> std::same_as<Rgb>;
};

}  // namespace mir
