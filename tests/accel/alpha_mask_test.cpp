// SPDX-License-Identifier: MIT
//
// Masked and see-through triangles: trees against asking every triangle, to the last bit.
#include "accel/against_brute_force.hpp"
#include "conformance/block_suite.hpp"
#include "conformance/masked_suite.hpp"
#include "conformance/see_through_suite.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/host/shaft_scene.hpp"
#include "support/catch.hpp"

using namespace mirtest;

namespace {

using Mask = mir::AlphaMaskView<mir::Space::host>;
using Opacity = mir::OpacityView<mir::Space::host>;

/// Answers of a tree that differ from asking every triangle about itself and its material.
struct MaskedDifferences {
    std::size_t hidden = 0;
    std::size_t hidden_by_whole = 0;
    std::size_t wrong = 0;
    std::size_t wrong_backwards = 0;
    std::size_t wrong_rays = 0;
};

bool hidden_by_any(const std::vector<mir::TriangleRows>& rows, const Opacity& opacity,
                   mir::Vec3 from, mir::Vec3 to) {
    for (std::uint32_t t = 0; t < rows.size(); ++t)
        if (mir::hits_segment(rows[t], from, to, t, opacity.between(from, to))) return true;
    return false;
}

mir::TriangleHit first_of_all(const std::vector<mir::TriangleRows>& rows, const Mask& mask,
                              float reach, const mir::Ray& ray) {
    const mir::CutSegment cut = mir::cut_to_reach(ray, reach);
    mir::TriangleHit best;
    if (cut.empty) return best;
    for (auto t = static_cast<std::uint32_t>(rows.size()); t-- > 0;)
        mir::keep_closer(rows[t], cut.from, cut.to, t, best, mask);
    if (best.triangle != mir::TriangleHit::none) best.t = cut.t_from + best.t * cut.t_length;
    return best;
}

template <class View>
MaskedDifferences compare_masked(const World& world, const View& view) {
    const std::vector<mir::TriangleRows> rows = all_rows(world.geometry);
    const Opacity opacity = world.geometry.opacity();
    const Mask mask = world.geometry.alpha_masks();
    mir::Random random = test_random(84);
    MaskedDifferences d;
    for (int i = 0; i < 4000; ++i) {
        const mir::Vec3 from = point_in_cube(random);
        const mir::Vec3 to = point_in_cube(random);
        const bool truth = hidden_by_any(rows, opacity, from, to);
        d.hidden += truth ? 1 : 0;
        d.hidden_by_whole += is_hidden(view, from, to) ? 1 : 0;
        d.wrong += is_hidden(view, from, to, opacity) != truth ? 1 : 0;
        d.wrong_backwards += is_hidden(view, to, from, opacity) != truth ? 1 : 0;
        const mir::Ray ray{from, glm::normalize(to - from)};
        if (!same_bits(first_hit(view, ray, mask), first_of_all(rows, mask, view.reach, ray)))
            ++d.wrong_rays;
    }
    return d;
}

void check(const MaskedDifferences& d) {
    INFO(d.hidden << " hidden, " << d.hidden_by_whole << " by whole triangles");
    CHECK(d.hidden > 400);
    CHECK(d.hidden + 400 < d.hidden_by_whole);
    CHECK(d.wrong == 0);
    CHECK(d.wrong_backwards == 0);
    CHECK(d.wrong_rays == 0);
}

}  // namespace

TEST_CASE("trees find what asking every masked triangle finds, in every bit") {
    for (const World& world :
         {masked_soup(200, 85, soup_materials()), masked_soup(200, 85, see_through_materials())}) {
        check(compare_masked(world, mir::KdTreeScene(world.geometry).tree().view()));
        check(compare_masked(world, mir::WideBvhScene(world.geometry).tree().view()));
    }
}

TEST_CASE("a kd-tree knows masks") { masked_suite<mir::KdTreeScene>(); }

TEST_CASE("a wide hierarchy knows masks") { masked_suite<mir::WideBvhScene>(); }

TEST_CASE("a kd-tree sees through") { see_through_suite<mir::KdTreeScene>(); }

TEST_CASE("a wide hierarchy sees through") { see_through_suite<mir::WideBvhScene>(); }

TEST_CASE("shafts see through") { see_through_suite<mir::ShaftScene>(); }

TEST_CASE("blocks of luxels see through surfaces what single segments see") {
    const World world = masked_soup(200, 86, see_through_materials());
    const mir::ShaftScene scene(world.geometry);
    const auto visibility = scene.visibility();
    const mir::WideBvhScene all(world.geometry);
    mir::Random random = test_random(87);
    std::size_t wrong = 0;
    std::size_t open = 0;
    for (int i = 0; i < 150; ++i) {
        const std::vector<mir::Hit> luxels = random_block(world.geometry, random);
        const HitRun run(luxels);
        const auto block = visibility.block(run.view(), mir::best_instruction_set());
        const mir::Vec3 origin = point_in_cube(random);
        const mir::BlockMask asked = random_mask(luxels, random);
        mir::BlockMask found = asked;
        visibility.visible_block(block, origin, found);
        wrong += wrong_bits(all.visibility(), luxels, origin, asked, found);
        for (std::uint32_t packet : found.packet) open += packet != 0 ? 1 : 0;
    }
    CHECK(open > 100);
    CHECK(wrong == 0);
}
