// SPDX-License-Identifier: MIT
#pragma once

#include "shaft/shaft_stage.hpp"
#include "support/catch.hpp"

#include <initializer_list>
#include <limits>
#include <utility>

// For all that fills words of visibility by shafts, on any machine: `words(stage)` has the bits of
// every triangle asked. docs/shafts.md.

namespace mirtest {

/// Triangles and needles of any size, at the origin and away from it.
template <class Words>
void shaft_soup_suite(const Words& words) {
    for (const auto& [scale, x] :
         {std::pair{1.0f, 0.0f}, {1e-3f, 0.0f}, {1e3f, 0.0f}, {1.0f, 30.0f}})
        for (const bool needles : {false, true}) {
            INFO("scale " << scale << ", moved by " << x << (needles ? ", needles" : ""));
            const World world = soup(needles, scale, x);
            const ShaftStage stage = stage_of(world, 2000, 40);
            CHECK(different_bits(words(stage), stage.by_brute_force()) == 0);
        }
}

/// Any number of luxels and of VPLs.
template <class Words>
void shaft_count_suite(const Words& words, std::initializer_list<std::uint32_t> luxel_counts,
                       std::initializer_list<std::uint32_t> vpl_counts) {
    const World world = soup(false);
    for (const std::uint32_t luxels : luxel_counts)
        for (const std::uint32_t vpls : vpl_counts) {
            CAPTURE(luxels, vpls);
            const ShaftStage stage = stage_of(world, luxels, vpls, 21 + luxels);
            CHECK(different_bits(words(stage), stage.by_brute_force()) == 0);
        }
}

/// Luxels and VPLs of a world, some of each beyond reach.
inline Lit lit_beyond_reach(const World& world) {
    Lit lit = random_lit(world.geometry, 500, 40, test_random(22));
    for (std::size_t i = 0; i < lit.luxels.size(); i += 5) lit.luxels[i].position *= 40.0f;
    for (std::size_t j = 0; j < lit.vpls.size(); j += 3) lit.vpls[j].position *= 1e4f;
    return lit;
}

/// A scene that is larger than the proofs reach.
inline ShaftStage stage_beyond_proofs() {
    constexpr float scale = 2e18f;
    const World small = soup(false);
    const World world = soup(false, scale);
    Lit lit = random_lit(small.geometry, 500, 20, test_random(24));
    for (mir::Hit& hit : lit.luxels) hit.position *= scale;
    for (mir::Vpl& vpl : lit.vpls) vpl.position *= scale;
    return {world.geometry, clustered(lit)};
}

/// The same, but that every `step`-th luxel from `first` on is no number along one axis.
inline Lit with_nan(Lit lit, std::size_t first, std::size_t step, int axis) {
    for (std::size_t i = first; i < lit.luxels.size(); i += step)
        lit.luxels[i].position[axis] = std::numeric_limits<float>::quiet_NaN();
    return lit;
}

/// A world without triangles hides nothing.
template <class Words>
void shaft_empty_suite(const Words& words) {
    const World world{mir::Scene{}};
    Lit lit;
    lit.luxels.assign(40, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}});
    lit.vpls.push_back({{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}, {1.0f, 1.0f, 1.0f}});
    const ShaftStage stage(world.geometry, lit);
    CHECK(words(stage) == std::vector<std::uint32_t>{~0u, 0xFFu, 0, 0, 0, 0, 0, 0});
}

}  // namespace mirtest
