// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/bsdf_suite.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/shading/contribution.hpp"

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
    ShadedPair<Surface> pair;
    pair.hit = {{0.1f, 0.2f, -0.3f}, direction(random)};
    pair.surface.normal = direction(random);
    pair.surface.wo = mir::Frame::around(pair.surface.normal)
                          .to_world(mir::square_to_cosine_hemisphere(random.next_2d()));
    pair.surface.bsdf = params;
    // Distances from a tenth of a millimetre to a kilometre.
    const float distance = std::pow(10.0f, 7.0f * random.next() - 4.0f);
    pair.vpl.position = pair.hit.position + distance * direction(random);
    pair.vpl.normal = direction(random);
    pair.vpl.intensity = {1.0f, 100.0f * random.next(), 0.0f};
    return pair;
}

/// Finite, not negative, zero below either horizon and without intensity. Pairs on all sides of
/// each other; the horizon is that of the luxel's shading normal and of the VPL's normal, kept away
/// from by a rounding.
template <mir::Shading F, class Params>
void shading_suite(const F& shade, std::span<const Params> list) {
    mir::Random random = test_random(41);
    std::size_t lit = 0;
    std::size_t not_a_radiance = 0;
    std::size_t lit_below_horizon = 0;
    std::size_t lit_by_nothing = 0;
    for (int i = 0; i < 20000; ++i) {
        const Params& params = list[static_cast<std::size_t>(i) % list.size()];
        auto pair = random_pair<typename F::Surface>(params, random);
        const mir::Rgb c = shade(pair.hit, pair.surface, pair.vpl);
        not_a_radiance += is_radiance(c) ? 0 : 1;
        lit += mir::is_black(c) ? 0 : 1;
        const mir::Vec3 d = glm::normalize(pair.vpl.position - pair.hit.position);
        const bool below =
            glm::dot(d, pair.surface.normal) < -1e-6f || glm::dot(d, pair.vpl.normal) > 1e-6f;
        lit_below_horizon += below && !mir::is_black(c) ? 1 : 0;
        pair.vpl.intensity = {};
        lit_by_nothing += mir::is_black(shade(pair.hit, pair.surface, pair.vpl)) ? 0 : 1;
    }
    CHECK(lit > 100);
    CHECK(not_a_radiance == 0);
    CHECK(lit_below_horizon == 0);
    CHECK(lit_by_nothing == 0);
}

/// ReachLimitedShading: nothing at all beyond the reach.
template <mir::ReachLimitedShading F, class Params>
void reach_suite(const F& shade, std::span<const Params> list) {
    mir::Random random = test_random(42);
    std::size_t near = 0;
    std::size_t lit_out_of_reach = 0;
    for (int i = 0; i < 20000; ++i) {
        const Params& params = list[static_cast<std::size_t>(i) % list.size()];
        const auto pair = random_pair<typename F::Surface>(params, random);
        const bool black = mir::is_black(shade(pair.hit, pair.surface, pair.vpl));
        const float d2 = mir::length_squared(pair.vpl.position - pair.hit.position);
        const bool out_of_reach = d2 > shade.reach_squared() * (1.0f + 0x1p-16f);
        near += black ? 0 : 1;
        lit_out_of_reach += out_of_reach && !black ? 1 : 0;
    }
    CHECK(near > 100);
    CHECK(lit_out_of_reach == 0);
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
