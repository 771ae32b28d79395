// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/ray.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/soa_run.hpp"

// The axioms of BlockVisibility: a bit that was set stays if and only if visible() says so.

namespace mirtest {

/// A block of luxels on surfaces, around one of them or all over the scene, some of them empty.
inline std::vector<mir::Hit> random_block(const mir::WorldGeometry& g, mir::Random& random) {
    const mir::SurfacePoint centre = random_surface_point(g, random);
    const float size = 0.2f * g.bounds().diagonal() * random.next() * random.next();
    const bool scattered = random.next() < 0.2f;
    std::vector<mir::Hit> luxels(mir::BlockMask::luxels);
    for (mir::Hit& hit : luxels) {
        if (random.next() < 0.1f) continue;
        const mir::SurfacePoint p = scattered ? random_surface_point(g, random) : centre;
        const mir::Vec3 aside = scattered ? mir::Vec3(0.0f) : size * point_in_cube(random);
        const mir::Vec3 n = p.geometric_normal;
        const mir::Vec3 at = p.position + aside - glm::dot(aside, n) * n;
        hit = {mir::lift(at, n, g.ray_offset()), n};
    }
    return luxels;
}

/// Some of the luxels that are not empty.
inline mir::BlockMask random_mask(const std::vector<mir::Hit>& luxels, mir::Random& random) {
    mir::BlockMask mask;
    const float share = random.next();
    for (std::uint32_t i = 0; i < mir::BlockMask::luxels; ++i)
        if (!is_empty(luxels[i]) && random.next() < share)
            mask.packet[i / mir::PointPacket::width] |= 1u << i % mir::PointPacket::width;
    return mask;
}

/// Bits of `found` that are wrong, when `asked` was set.
template <mir::Visibility V>
std::size_t wrong_bits(const V& visibility, const std::vector<mir::Hit>& luxels, mir::Vec3 origin,
                       const mir::BlockMask& asked, const mir::BlockMask& found) {
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < mir::BlockMask::luxels; ++i) {
        const std::uint32_t bit = 1u << i % mir::PointPacket::width;
        const std::uint32_t packet = i / mir::PointPacket::width;
        const bool wanted =
            (asked.packet[packet] & bit) != 0 && visibility.visible(origin, luxels[i].position);
        wrong += wanted != ((found.packet[packet] & bit) != 0) ? 1 : 0;
    }
    return wrong;
}

/// Random blocks, origins and masks in a soup and in a closed room.
template <class Engine>
void block_suite(int blocks = 20) {
    for (const World& world : {triangle_soup(300, 71), sphere_in_box()}) {
        const Engine engine(world.geometry);
        const auto visibility = engine.visibility();
        mir::Random random = test_random(72);
        std::size_t wrong = 0;
        for (int i = 0; i < blocks; ++i) {
            const std::vector<mir::Hit> luxels = random_block(world.geometry, random);
            const HitRun run(luxels);
            for (mir::InstructionSet set : instruction_sets()) {
                const auto block = visibility.block(run.view(), set);
                for (int j = 0; j < 20; ++j) {
                    const mir::SurfacePoint p = random_surface_point(world.geometry, random);
                    const mir::Vec3 origin = mir::lift(p);
                    const mir::BlockMask asked = random_mask(luxels, random);
                    mir::BlockMask found = asked;
                    visibility.visible_block(block, origin, found);
                    wrong += wrong_bits(visibility, luxels, origin, asked, found);
                }
            }
        }
        CHECK(wrong == 0);
    }
}

}  // namespace mirtest
