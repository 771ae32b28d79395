// SPDX-License-Identifier: MIT
#include "mir/shaft/device/leaf_search.hpp"

#include "shaft/searched_stage.hpp"
#include "support/catch.hpp"

// Walks of 32 shafts at a time, each with its own limits, against every triangle asked about every
// luxel.

namespace {

using mir::LaneGroup;
using mir::LeafSearchState;
using mirtest::SearchedStage;

/// Where the search of a lane ended.
struct SearchedLane {
    mir::OpenPair pair;
    LeafSearchState state = LeafSearchState::off;
    std::uint32_t visited = 0;  ///< nodes
    std::vector<std::uint32_t> leaves;
};

/// Searches for the pairs of VPL `vpl` and clusters first .. first + 31, of which every fifth is
/// left out, in columns of that capacity.
template <std::uint32_t Capacity>
std::vector<SearchedLane> search(const SearchedStage& stage, std::uint32_t first, std::uint32_t vpl,
                                 std::uint32_t most_nodes) {
    const LaneGroup group;
    LaneGroup::PerLane<mir::LeafSearch> searches;
    LaneGroup::PerLane<mir::ShaftSlabs> slabs;
    LaneGroup::PerLane<mir::LeafStack> stacks;
    mir::LeafColumns<Capacity> columns;
    for (std::uint32_t lane = 0; lane < 32; ++lane) {
        slabs[lane] = mir::make_shaft_slabs(stage.stage().clusters()[first + lane],
                                            stage.vpls()[vpl].position, stage.stage().sigma(),
                                            stage.bvh().exact.reach);
        searches[lane].begin(lane % 5 != 4);
    }
    std::uint32_t turns[32] = {};
    while (const std::uint32_t running = mir::running_lanes(group, searches)) {
        for (std::uint32_t lane = 0; lane < 32; ++lane) turns[lane] += running >> lane & 1u;
        mir::visit_nodes(group, stage.bvh(), slabs, most_nodes, searches, stacks, columns);
    }
    std::vector<SearchedLane> lanes(32);
    for (std::uint32_t lane = 0; lane < 32; ++lane) {
        lanes[lane] = {{first + lane, vpl}, searches[lane].state, turns[lane], {}};
        for (std::uint32_t k = 0; k < std::min(searches[lane].listed, Capacity); ++k)
            lanes[lane].leaves.push_back(columns.met[k][lane].bits);
        if (searches[lane].listed > Capacity) lanes[lane].leaves.clear();
    }
    return lanes;
}

/// Calls f with the lanes of many searches.
template <std::uint32_t Capacity, class F>
void for_each_lane(const SearchedStage& stage, std::uint32_t most_nodes, const F& f) {
    const auto clusters = static_cast<std::uint32_t>(stage.stage().clusters().size());
    for (std::uint32_t first = 0; first + 32 <= clusters; first += 32)
        for (std::uint32_t vpl = 0; vpl < stage.vpls().size(); ++vpl)
            for (const SearchedLane& lane : search<Capacity>(stage, first, vpl, most_nodes))
                f(lane);
}

/// A node is listed once, and what hides a luxel is listed.
bool is_complete_list(const SearchedStage& stage, const SearchedLane& lane) {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t bits : lane.leaves) nodes.push_back(mir::MetLeaves{bits}.node());
    std::sort(nodes.begin(), nodes.end());
    const auto found =
        stage.triangles_of(lane.leaves.data(), static_cast<std::uint32_t>(lane.leaves.size()));
    return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end() &&
           mirtest::are_among(stage.hiding(lane.pair), found);
}

}  // namespace

TEST_CASE("A node and the slots of its leaves are one word") {
    for (const std::uint32_t node : {0u, 1u, 0x123456u, mir::MetLeaves::most_nodes - 1})
        for (const std::uint32_t slots : {0u, 1u, 0x80u, 0xFFu}) {
            const mir::MetLeaves met = mir::MetLeaves::of(node, slots);
            CHECK(met.node() == node);
            CHECK(met.slots() == slots);
        }
}

TEST_CASE("Searches that end by themselves list every triangle that hides a luxel") {
    const bool needles = GENERATE(false, true);
    const mirtest::World world = needles ? mirtest::soup(true) : mirtest::sphere_in_box(24);
    const mirtest::ShaftStage drawn(world.geometry, mirtest::lit_in_space(world, 2048, 20));
    const SearchedStage stage(drawn);
    std::size_t off = 0, complete = 0, given_up = 0, wrong = 0;
    for_each_lane<64>(stage, 1000, [&](const SearchedLane& lane) {
        const bool is_off = lane.pair.cluster % 32 % 5 == 4;
        off += lane.state == LeafSearchState::off ? 1 : 0;
        complete += lane.state == LeafSearchState::complete ? 1 : 0;
        given_up += lane.state == LeafSearchState::given_up ? 1 : 0;
        wrong +=
            is_off == (lane.state == LeafSearchState::off) && is_off == (lane.visited == 0) ? 0 : 1;
        if (!is_off) wrong += is_complete_list(stage, lane) ? 0 : 1;
    });
    CHECK(wrong == 0);
    CHECK(off == 2 * 6 * 20);
    CHECK(complete == 2 * 26 * 20);
    CHECK(given_up == 0);
}

TEST_CASE("Searches give up where they would visit more nodes than they may, and only there") {
    const mirtest::World world = mirtest::sphere_in_box(40);
    const mirtest::ShaftStage drawn(world.geometry, mirtest::lit_in_space(world, 1024, 8));
    const SearchedStage stage(drawn);
    std::vector<SearchedLane> all;
    for_each_lane<64>(stage, ~0u, [&](const SearchedLane& lane) { all.push_back(lane); });
    for (const std::uint32_t most : {0u, 1u, 2u, 5u, 12u}) {
        CAPTURE(most);
        std::size_t i = 0, wrong = 0, given_up = 0;
        for_each_lane<64>(stage, most, [&](const SearchedLane& lane) {
            const SearchedLane& unlimited = all[i++];
            if (lane.state == LeafSearchState::off) return;
            const bool fits = unlimited.visited <= std::max(most, 1u);
            const LeafSearchState state =
                fits ? LeafSearchState::complete : LeafSearchState::given_up;
            wrong += lane.state == state && lane.visited <= std::max(most, 1u) ? 0 : 1;
            wrong += fits && lane.leaves != unlimited.leaves ? 1 : 0;
            given_up += fits ? 0 : 1;
        });
        CHECK(wrong == 0);
        CHECK(given_up > 10);
    }
}

TEST_CASE("Searches give up where a column has no room, and only there") {
    const mirtest::World world = mirtest::soup(false);
    const mirtest::ShaftStage drawn(world.geometry, mirtest::lit_in_space(world, 2048, 20));
    const SearchedStage stage(drawn);
    std::vector<SearchedLane> all;
    for_each_lane<64>(stage, 1000, [&](const SearchedLane& lane) { all.push_back(lane); });
    std::size_t i = 0, wrong = 0, given_up = 0, full = 0;
    for_each_lane<2>(stage, 1000, [&](const SearchedLane& lane) {
        const SearchedLane& roomy = all[i++];
        if (lane.state == LeafSearchState::off) return;
        const bool fits = roomy.leaves.size() <= 2;
        wrong += (lane.state == LeafSearchState::complete) == fits ? 0 : 1;
        wrong += fits && lane.leaves != roomy.leaves ? 1 : 0;
        given_up += lane.state == LeafSearchState::given_up ? 1 : 0;
        full += roomy.leaves.size() == 2 ? 1 : 0;
    });
    CHECK(wrong == 0);
    CHECK(given_up > 50);
    CHECK(full > 50);
}
