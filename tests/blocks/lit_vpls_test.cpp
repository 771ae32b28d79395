// SPDX-License-Identifier: MIT
#include "mir/blocks/lit_vpls.hpp"

#include "conformance/worlds.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "mir/validation/detail/shaded_places.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/same_records.hpp"
#include "support/soa_run.hpp"

#include <memory>

// LitVpls against the same shading, luxel by luxel and VPL by VPL: the same operations in the same
// order, so the same bits.
namespace {

using mir::BlockMask;
using mir::CookTorrance;
using mir::Rgb;
using mir::Vec3;
using mir::Vpl;
using mir::blocks::GroupRadiance;
using mir::blocks::LitVpls;
using Surface = mir::Surface<CookTorrance::Params>;

constexpr std::uint32_t luxels = BlockMask::luxels;
constexpr std::uint32_t group_size = mir::blocks::group_size;

Surface random_surface(mir::Random& random) {
    const auto place = mir::validation::detail::random_shaded_place(random);
    const auto colour = [&] { return Rgb{random.next(), random.next(), random.next()}; };
    return {place.normal, place.wo, {}, {colour(), colour(), 1.0f, 0.1f + 0.9f * random.next()}};
}

std::vector<mir::Hit> random_hits(mir::Random& random) {
    std::vector<mir::Hit> hits(luxels);
    for (std::uint32_t i = 0; i < luxels; ++i)
        if (i % 17 != 3) hits[i] = {mirtest::point_in_cube(random), mirtest::direction(random)};
    return hits;
}

std::vector<Surface> random_surfaces(mir::Random& random) {
    std::vector<Surface> surfaces;
    for (std::uint32_t i = 0; i < luxels; ++i) {
        surfaces.push_back(random_surface(random));
        if (i % 19 == 5) surfaces.back().bsdf = {{}, {}, 0.0f, 1.0f};
    }
    return surfaces;
}

/// A block of which some luxels are empty and some reflect nothing.
template <mir::Shading F>
struct Luxels {
    Luxels(const F& shading, mir::Random& random)
        : hits(random_hits(random)),
          surfaces(random_surfaces(random)),
          block(hits.view(), surfaces.view(), {}, shading) {}

    mirtest::SoaRun<mir::Hit> hits;
    mirtest::SoaRun<Surface> surfaces;
    mir::blocks::LuxelBlock<F> block;
};

/// No luxel, all of them, or any, for each group by itself; only such as count.
BlockMask random_mask(const mir::blocks::HitBlock& block, mir::Random& random) {
    BlockMask mask;
    for (std::uint32_t g = 0; g < BlockMask::packets; ++g) {
        const float kind = random.next();
        const auto any = static_cast<std::uint32_t>(random.next() * 65536.0f);
        mask.packet[g] = (kind < 0.3f ? 0u : kind < 0.6f ? 0xFFFFu : any) & block.candidates[g];
    }
    return mask;
}

Vpl random_vpl(mir::Random& random) {
    return {mirtest::point_in_cube(random),
            mirtest::direction(random),
            {random.next(), 0.0f, 10.0f * random.next()}};
}

bool is_lit(const BlockMask& mask, std::uint32_t i) {
    return (mask.packet[i / group_size] >> i % group_size & 1u) != 0;
}

Rgb sum_of(const GroupRadiance* sums, std::uint32_t i) {
    const GroupRadiance& sum = sums[i / group_size];
    return {sum.r[i % group_size], sum.g[i % group_size], sum.b[i % group_size]};
}

template <mir::Shading F>
Rgb shaded(const Luxels<F>& made, const F& shading, std::uint32_t i, const Vpl& vpl) {
    return shading(made.hits.view().load(i), made.surfaces.view().load(i), vpl);
}

/// Batches of so many VPLs one after the other in one LitVpls; luxels whose sums differ in a bit.
template <mir::Shading F>
std::size_t wrong_sums(const F& shading, mir::InstructionSet set, mir::Random& random) {
    const Luxels made(shading, random);
    const auto batch = std::make_unique<LitVpls>();
    std::vector<GroupRadiance> sums(BlockMask::packets);
    std::vector<Rgb> wanted(luxels);
    for (const std::uint32_t count : {LitVpls::capacity, 1u, 5u}) {
        for (std::uint32_t j = 0; j < count; ++j) {
            Vpl vpl = random_vpl(random);
            BlockMask mask = random_mask(made.block, random);
            // On a luxel that it does not light, where light is no number.
            if (j % 3 == 0) {
                vpl.position = made.hits.view().load(j).position;
                mask.packet[j / group_size] &= ~(1u << j % group_size);
            }
            batch->add(vpl, mask);
            for (std::uint32_t i = 0; i < luxels; ++i)
                if (is_lit(mask, i)) wanted[i] += shaded(made, shading, i, vpl);
        }
        CHECK(batch->is_full() == (count == LitVpls::capacity));
        mir::run_with(set, [&](auto s) {
            batch->template shade<decltype(s)::value>(made.block, shading, sums.data());
        });
    }
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < luxels; ++i)
        wrong += mirtest::bits_of(sum_of(sums.data(), i)) == mirtest::bits_of(wanted[i]) ? 0 : 1;
    return wrong;
}

/// The same for what each VPL adds to all groups: lanes whose sums differ in a bit.
template <mir::Shading F>
std::size_t wrong_lanes(const F& shading, mir::InstructionSet set, mir::Random& random) {
    const Luxels made(shading, random);
    const auto batch = std::make_unique<LitVpls>();
    std::vector<GroupRadiance> sums(LitVpls::capacity);
    std::vector<Rgb> wanted(std::size_t{LitVpls::capacity} * group_size);
    for (std::uint32_t j = 0; j < LitVpls::capacity; ++j) {
        const Vpl vpl = random_vpl(random);
        const BlockMask mask = random_mask(made.block, random);
        batch->add(vpl, mask);
        for (std::uint32_t i = 0; i < luxels; ++i)
            if (is_lit(mask, i))
                wanted[j * group_size + i % group_size] += shaded(made, shading, i, vpl);
    }
    mir::run_with(set, [&](auto s) {
        batch->template shade_each<decltype(s)::value>(made.block, shading, sums.data());
    });
    std::size_t wrong = 0;
    for (std::uint32_t k = 0; k < wanted.size(); ++k)
        wrong += mirtest::bits_of(sum_of(sums.data(), k)) == mirtest::bits_of(wanted[k]) ? 0 : 1;
    return wrong;
}

}  // namespace

TEMPLATE_TEST_CASE("Lit VPLs add what each adds by itself, with every instruction set", "",
                   mir::VplShading<CookTorrance>, mir::RemovedByBound<CookTorrance>) {
    mir::Random random = mirtest::test_random(91);
    const TestType shading{2.0f};
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        CHECK(wrong_sums(shading, set, random) == 0);
        CHECK(wrong_lanes(shading, set, random) == 0);
    }
}
