// SPDX-License-Identifier: MIT
#include "mir/shaft/exact/pair_search.hpp"

#include "shaft/shaft_stage.hpp"
#include "support/catch.hpp"

// Lists of triangles against every triangle asked: a complete one misses none.

namespace {

using mir::CandidateList;
using mir::PairState;
using mirtest::ShaftStage;

ShaftStage soup_stage() {
    const mirtest::World world = mirtest::triangle_soup(60, 41);
    const mirtest::Lit lit =
        mirtest::random_lit(world.geometry, 1500, 30, mirtest::test_random(42));
    mir::WideBvhOptions options;
    options.leaf_size = 2;
    return {world.geometry, mirtest::clustered(lit), options};
}

/// What is wrong with the answers of a search for the triangles of all pairs.
struct Wrong {
    std::size_t missed = 0;   ///< pairs whose list lacks a triangle that hits a segment
    std::size_t covered = 0;  ///< pairs said to be covered, one of whose segments is free
    std::size_t listed = 0;   ///< pairs whose list is said to be complete, empty or not
};

/// Luxels of a cluster that are not empty.
std::vector<mir::Vec3> luxels_of(const ShaftStage& stage, std::size_t cluster) {
    std::vector<mir::Vec3> found;
    for (std::size_t i = 0; i < mir::cluster_luxels; ++i) {
        const mir::Hit& hit = stage.lit().luxels[cluster * mir::cluster_luxels + i];
        if (!is_empty(hit)) found.push_back(hit.position);
    }
    return found;
}

bool is_in(const CandidateList& list, std::uint32_t t) {
    return std::find(list.triangle, list.triangle + list.size, t) != list.triangle + list.size;
}

void judge(const ShaftStage& stage, const std::vector<mir::Vec3>& luxels, mir::Vec3 apex,
           PairState state, const CandidateList& list, Wrong& wrong) {
    bool missed = false;
    bool all_hit_by_one = false;
    for (std::uint32_t t = 0; t < stage.bvh().triangles().size(); ++t) {
        const auto is_hit = [&](mir::Vec3 p) {
            return mir::hits_segment(stage.bvh().triangles()[t], apex, p);
        };
        missed = missed || (!is_in(list, t) && std::any_of(luxels.begin(), luxels.end(), is_hit));
        all_hit_by_one = all_hit_by_one || std::all_of(luxels.begin(), luxels.end(), is_hit);
    }
    const bool claims_all = state == PairState::clear || state == PairState::listed;
    wrong.missed += claims_all && missed ? 1 : 0;
    wrong.covered += state == PairState::covered && !all_hit_by_one ? 1 : 0;
    wrong.listed += claims_all ? 1 : 0;
}

/// `search(cluster, apex, list)` for all pairs of the stage.
template <class Search>
Wrong judge_all(const ShaftStage& stage, const Search& search) {
    Wrong wrong;
    for (std::size_t c = 0; c < stage.clusters().size(); ++c) {
        if (stage.clusters()[c].luxels == 0) continue;
        const std::vector<mir::Vec3> luxels = luxels_of(stage, c);
        for (const mir::Vpl& vpl : stage.lit().vpls) {
            CandidateList list;
            const PairState state = search(stage.clusters()[c], vpl.position, list);
            judge(stage, luxels, vpl.position, state, list, wrong);
        }
    }
    return wrong;
}

}  // namespace

TEST_CASE("A complete list of a pair holds every triangle that hits one of its segments") {
    const ShaftStage stage = soup_stage();
    const mir::SearchLimits limits = GENERATE(mir::ShaftLimits{}.cluster, mir::SearchLimits{3, 4});
    const Wrong wrong = judge_all(stage, [&](const auto& cluster, mir::Vec3 apex, auto& list) {
        return mir::search_pair(stage.bvh().view(), cluster, apex, stage.sigma(), limits, list);
    });
    CHECK(wrong.missed == 0);
    CHECK(wrong.covered == 0);
    CHECK(wrong.listed > 150);
}

TEST_CASE("A search that calls its list complete when it gave up is noticed") {
    const ShaftStage stage = soup_stage();
    const Wrong wrong = judge_all(stage, [&](const auto& cluster, mir::Vec3 apex, auto& list) {
        const PairState state =
            mir::search_pair(stage.bvh().view(), cluster, apex, stage.sigma(), {3, 4}, list);
        return state == PairState::unknown ? PairState::listed : state;
    });
    CHECK(wrong.missed > 30);
}

TEST_CASE("A search that takes two triangles for one that covers is noticed") {
    const ShaftStage stage = soup_stage();
    const Wrong wrong = judge_all(stage, [&](const auto& cluster, mir::Vec3 apex, auto& list) {
        const PairState state = mir::search_pair(stage.bvh().view(), cluster, apex, stage.sigma(),
                                                 mir::ShaftLimits{}.cluster, list);
        return state == PairState::listed && list.size > 1 ? PairState::covered : state;
    });
    CHECK(wrong.covered > 30);
}

TEST_CASE("A list narrowed to a part of the cluster is complete for the part") {
    const ShaftStage stage = soup_stage();
    std::size_t narrowed = 0;
    const Wrong wrong =
        judge_all(stage, [&](mir::ClusterRecord cluster, mir::Vec3 apex, auto& list) {
            mir::ClusterRecord whole = cluster;
            whole.low -= 0.1f;
            whole.high += 0.1f;
            whole.front = {0, 0, 0, 1};
            CandidateList known;
            const PairState state =
                mir::search_pair(stage.bvh().view(), whole, apex, stage.sigma(), {1000, 64}, known);
            if (state != PairState::listed) return PairState::unknown;
            ++narrowed;
            return mir::narrow_pair(stage.bvh().view(), cluster, apex, stage.sigma(), known, list);
        });
    CHECK(narrowed > 300);
    CHECK(wrong.missed == 0);
    CHECK(wrong.covered == 0);
}
