// SPDX-License-Identifier: MIT
#include "mir/reconstruct_cuts.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "cuts/cut_suite.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/cuts/deviation_cut.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/backwards_executor.hpp"
#include "support/statistics.hpp"

#include <algorithm>
#include <vector>

namespace {

template <mir::Bsdf B>
using KdStage = mirtest::Stage<B, mir::KdTreeScene>;

template <mir::Bsdf B>
mir::VplShading<B> bounded() {
    mir::VplShading<B> shading;
    shading.bound = 20.0f;
    return shading;
}

template <class Stage>
mir::VplTree tree_of(const Stage& stage) {
    mir::InlineExecutor executor;
    return {stage.vpls(), executor};
}

template <class B, class Policy>
mir::Image<mir::Rgb> gather(const KdStage<B>& stage, const mir::VplTree& tree, const Policy& policy,
                            std::uint64_t seed) {
    mir::InlineExecutor executor;
    return reconstruct_cuts(stage.gbuffer(), tree, stage.visibility(), bounded<B>(), policy, {seed},
                            executor);
}

template <class B>
mir::Image<mir::Rgb> full_sum(const KdStage<B>& stage, const mir::VplTree& tree) {
    mir::InlineExecutor executor;
    return reconstruct(mir::sched::CpuBlocks{executor}, stage.gbuffer(), tree.leaves(),
                       stage.visibility(), bounded<B>());
}

/// p-values, one a luxel with light, of "the mean over seeds is the full sum".
template <class Picture>
std::vector<double> p_values(const mir::Image<mir::Rgb>& full, const Picture& picture,
                             std::uint64_t seeds) {
    std::vector<mirtest::Moments> moments(full.pixels().size());
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const mir::Image<mir::Rgb> one = picture(seed);
        for (std::size_t i = 0; i < moments.size(); ++i)
            moments[i].add(static_cast<double>(luminance(one.pixels()[i])));
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < moments.size(); ++i) {
        const auto expected = static_cast<double>(luminance(full.pixels()[i]));
        if (expected > 0.0)
            values.push_back(mirtest::mean_p_value(moments[i], expected, 1e-5 * expected));
    }
    return values;
}

/// The same gather luxel by luxel, for an image of one block: `weight(node, leaf)` is that of a
/// pick.
template <class Weight>
mir::Image<mir::Rgb> naive_gather(const KdStage<mir::Lambert>& stage, const mir::VplTree& tree,
                                  std::uint32_t picks, std::uint64_t seed, const Weight& weight) {
    const auto shading = bounded<mir::Lambert>();
    const auto view = stage.gbuffer().view(0);
    using Interleaved = mir::blocks::InterleavedBlock<mir::VplShading<mir::Lambert>>;
    const Interleaved luxels(view.hits, view.surfaces, {});
    const mir::CutBlock<mir::VplShading<mir::Lambert>> block(luxels.hits(), luxels.surfaces(), {},
                                                             shading);
    const mir::VplCut cut =
        mir::EqualCountCut{picks}.choose<mir::InstructionSet::baseline>(block, tree, shading);
    mir::CutPicks numbers(mir::Random(seed, mir::Stream::cut, 0), cut.size());
    mir::Image<mir::Rgb> image(stage.gbuffer().extent());
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) {
            const mir::LuxelIndex luxel = mir::BlockedLayout::inside(x, y);
            numbers.start(mir::InterleavedOrder::place_here(luxel) / mir::blocks::group_size);
            for (std::uint32_t i = 0; i < cut.size(); ++i) {
                const std::uint32_t leaf = tree.pick(cut[i], numbers(i));
                image(x, y) += contribution(view.hit(luxel), view.surface(luxel),
                                            tree.leaves()[leaf], stage.visibility(), shading) *
                               weight(cut[i], leaf);
            }
        }
    return image;
}

}  // namespace

TEST_CASE("groups of an interleaved block have a luxel of each square, and pixels all quarters") {
    const auto group_at = [](std::uint32_t x, std::uint32_t y) {
        return mir::InterleavedOrder::place_here(mir::BlockedLayout::inside(x, y)) /
               mir::blocks::group_size;
    };
    for (std::uint32_t group = 0; group < 16; ++group)
        for (std::uint32_t square = 0; square < 16; ++square) {
            const std::uint32_t luxel = mir::InterleavedOrder::place_of(group, square);
            CHECK(luxel / 16 == square);
            CHECK(mir::InterleavedOrder::place_here(luxel) == group * 16 + square);
        }
    std::uint32_t beside = 0;
    for (std::uint32_t y = 0; y < 16; y += 2)
        for (std::uint32_t x = 0; x < 16; x += 2) {
            std::uint32_t quarters = 0;
            for (std::uint32_t i = 0; i < 4; ++i)
                quarters |= 1u << mir::PickNumbers::stratum(group_at(x + i % 2, y + i / 2)) / 4;
            CHECK(quarters == 15);
            beside += x + 4 < 16 && group_at(x, y) == group_at(x + 4, y) ? 1 : 0;
            beside += y + 4 < 16 && group_at(x, y) == group_at(x, y + 4) ? 1 : 0;
        }
    CHECK(beside == 0);
}

TEMPLATE_TEST_CASE("cuts hold every VPL once, whatever chooses them", "", mir::Lambert,
                   mir::CookTorrance) {
    const KdStage<TestType> stage({60, 40}, {48, 32}, 200);
    const mir::VplTree tree = tree_of(stage);
    const auto shading = bounded<TestType>();
    mirtest::cut_suite(stage, tree, shading, mir::CompleteCut{}, tree.size());
    for (const std::uint32_t picks : {1u, 2u, 7u, 64u, 1000u}) {
        mirtest::cut_suite(stage, tree, shading, mir::EqualCountCut{picks}, picks);
        mirtest::cut_suite(stage, tree, shading, mir::DeviationCut{picks}, picks);
    }
}

TEMPLATE_TEST_CASE("a complete cut is the full sum in leaf order, in every bit", "", mir::Lambert,
                   mir::CookTorrance) {
    const KdStage<TestType> stage({60, 40}, {48, 32}, 150);
    const mir::VplTree tree = tree_of(stage);
    const auto full = full_sum(stage, tree);
    CHECK(mirtest::pixels_that_differ(gather(stage, tree, mir::CompleteCut{}, 1), full) == 0);
    CHECK(mirtest::pixels_that_differ(gather(stage, tree, mir::DeviationCut{1000}, 1), full) == 0);
}

// Hypothesis: the mean over 400 seeds is the full sum, at every luxel. Level 1 % over the luxels.
TEMPLATE_TEST_CASE("cuts of any size have the full sum as their mean", "[statistical]",
                   mir::Lambert, mir::CookTorrance) {
    const KdStage<TestType> stage({24, 18}, {48, 32}, 64);
    const mir::VplTree tree = tree_of(stage);
    const auto full = full_sum(stage, tree);
    const auto check = [&](const auto& policy) {
        const std::vector<double> values = p_values(
            full, [&](std::uint64_t seed) { return gather(stage, tree, policy, seed); }, 400);
        REQUIRE(values.size() > 100);
        CHECK(*std::min_element(values.begin(), values.end()) >
              mirtest::sidak(0.01, values.size()));
    };
    check(mir::DeviationCut{24});
    check(mir::EqualCountCut{24});
}

TEST_CASE("a gather by cuts is that of picks luxel by luxel") {
    const KdStage<mir::Lambert> stage({16, 16}, {16, 16}, 300);
    const mir::VplTree tree = tree_of(stage);
    const auto fast = gather(stage, tree, mir::EqualCountCut{20}, 4);
    const auto slow = naive_gather(stage, tree, 20, 4, [&](const auto& node, auto leaf) {
        return tree.inverse_probability(node, leaf);
    });
    for (std::size_t i = 0; i < fast.pixels().size(); ++i)
        CHECK(luminance(fast.pixels()[i]) == Approx(luminance(slow.pixels()[i])).epsilon(1e-4));
}

// Hypothesis and level as above.
TEST_CASE("picks by weight that are summed as if all were equally likely are found out",
          "[statistical]") {
    const KdStage<mir::Lambert> stage({16, 16}, {16, 16}, 64);
    const mir::VplTree tree = tree_of(stage);
    const auto wrong = [&](std::uint64_t seed) {
        return naive_gather(stage, tree, 8, seed, [](const auto& node, auto /*leaf*/) {
            return static_cast<float>(node.count);
        });
    };
    const std::vector<double> values = p_values(full_sum(stage, tree), wrong, 400);
    CHECK(*std::min_element(values.begin(), values.end()) < mirtest::sidak(0.01, values.size()));
}

TEST_CASE("threads, tiles, bands and instruction sets change no bit of a cut's picture") {
    const KdStage<mir::CookTorrance> stage({100, 70}, {48, 32}, 300);
    const mir::VplTree tree = tree_of(stage);
    const auto shading = bounded<mir::CookTorrance>();
    const auto wanted = gather(stage, tree, mir::DeviationCut{20}, 9);
    const KdStage<mir::CookTorrance> other({100, 70}, {112, 80}, 300);
    CHECK(mirtest::pixels_that_differ(gather(other, tree, mir::DeviationCut{20}, 9), wanted) == 0);
    mirtest::BackwardsExecutor executor{3};
    for (const mir::InstructionSet set : mirtest::instruction_sets())
        CHECK(mirtest::pixels_that_differ(
                  reconstruct_cuts(stage.gbuffer(), tree, stage.visibility(), shading,
                                   mir::DeviationCut{20}, {9}, executor, nullptr, set),
                  wanted) == 0);
    CHECK(mirtest::pixels_that_differ(gather(stage, tree, mir::DeviationCut{20}, 10), wanted) > 0);
}

TEST_CASE("a cut by deviation deviates less than as many equal parts") {
    const KdStage<mir::Lambert> stage({60, 40}, {48, 32}, 2000);
    const mir::VplTree tree = tree_of(stage);
    const auto full = full_sum(stage, tree);
    const auto error = [&](const auto& policy) {
        double sum = 0.0;
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
            const auto one = gather(stage, tree, policy, seed);
            for (std::size_t i = 0; i < full.pixels().size(); ++i) {
                const double d = static_cast<double>(luminance(one.pixels()[i])) -
                                 static_cast<double>(luminance(full.pixels()[i]));
                sum += d * d;
            }
        }
        return sum;
    };
    CHECK(error(mir::DeviationCut{64}) < 0.8 * error(mir::EqualCountCut{64}));
}

TEST_CASE("a gather by cuts counts its picks, stops when asked and refuses bands within a block") {
    const KdStage<mir::Lambert> stage({32, 32}, {32, 32}, 100);
    const mir::VplTree tree = tree_of(stage);
    mir::InlineExecutor executor;
    mir::Monitor monitor;
    const auto run = [&](const mir::CutPlace& place) {
        return reconstruct_cuts(stage.gbuffer(), tree, stage.visibility(), bounded<mir::Lambert>(),
                                mir::EqualCountCut{10}, place, executor, &monitor);
    };
    static_cast<void>(run({1}));
    CHECK(monitor.contributions > 0);
    CHECK(monitor.contributions <= 32u * 32u * 10u);
    CHECK_THROWS_AS(run({1, 8}), mir::Error);
    monitor.cancelled = true;
    CHECK_THROWS_AS(run({1}), mir::Error);
}
