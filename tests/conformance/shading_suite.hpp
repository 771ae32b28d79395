// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/bsdf_suite.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/validation/shading.hpp"

// The axioms of Shading. The suites take the parameters of the BSDF that the model reads from its
// Surface.

namespace mirtest {

/// A luxel at the origin, and a VPL.
template <class Surface>
struct ShadedPair {
    mir::Hit hit;
    Surface surface;
    mir::Vpl vpl;
};

template <class Surface, class Params>
ShadedPair<Surface> random_pair(const Params& params, mir::Random& random) {
    const auto at = mir::validation::detail::random_shaded_place(random);
    return {at.hit, {at.normal, at.wo, {}, params}, at.vpl};
}

/// The axioms that hold for every Shading, for each of some surfaces that reflect.
template <mir::Shading F, class Params>
void shading_suite(const F& shade, std::span<const Params> list) {
    for (const Params& params : list)
        passes(mir::validation::check_shading(shade, mir::validation::surfaces_with(params)));
}

/// SurfaceSelectiveShading: a surface that does not reflect gets nothing. `black` are parameters of
/// such a surface, `list` those of others.
template <mir::SurfaceSelectiveShading F, class Params>
void selective_suite(const F& shade, const Params& black, std::span<const Params> list) {
    mir::Random random = test_random(45);
    for (int i = 0; i < 1000; ++i) {
        const auto pair = random_pair<typename F::Surface>(black, random);
        REQUIRE_FALSE(shade.reflects(pair.surface));
        REQUIRE(mir::is_black(shade(pair.hit, pair.surface, pair.vpl)));
    }
    for (const Params& params : list)
        CHECK(shade.reflects(random_pair<typename F::Surface>(params, random).surface));
}

/// The pair stands on one point: contribution() must stop before it divides by zero.
template <mir::Shading F, class V, class Params>
void coincident_points_give_nothing(const F& shade, const V& visibility, const Params& params) {
    mir::Random random = test_random(43);
    auto pair = random_pair<typename F::Surface>(params, random);
    pair.vpl.position = pair.hit.position;
    CHECK(mir::is_black(contribution(pair.hit, pair.surface, pair.vpl, visibility, shade)));
}

}  // namespace mirtest
