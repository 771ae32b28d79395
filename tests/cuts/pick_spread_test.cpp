// SPDX-License-Identifier: MIT
#include "mir/cuts/pick_spread.hpp"

#include "conformance/brute_force.hpp"
#include "cuts/cut_stage.hpp"
#include "mir/cuts/deviation_cut.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/same_images.hpp"
#include "support/statistics.hpp"

#include <vector>

using mirtest::bounded;
using mirtest::full_sum;
using mirtest::gather;
using mirtest::KdStage;
using mirtest::tree_of;

namespace {

/// What many seeds tell of the bar at the luxels that have light.
struct Bars {
    mirtest::Moments covered;      ///< share of luxels within two standard errors, by seed
    std::vector<double> variance;  ///< of each luxel, measured
    std::vector<double> estimate;  ///< of each luxel, mean
};

template <class B, class Policy>
Bars bars_of(const KdStage<B>& stage, const Policy& policy, std::uint64_t seeds, double scale) {
    const mir::VplTree tree = tree_of(stage);
    const mir::Image<mir::Rgb> full = full_sum(stage, tree);
    const std::size_t luxels = full.pixels().size();
    Bars bars{{}, std::vector<double>(luxels), std::vector<double>(luxels)};
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        mir::Image<float> variance;
        const mir::Image<mir::Rgb> one = gather(stage, tree, policy, seed, &variance);
        double lit = 0.0;
        double covered = 0.0;
        for (std::size_t i = 0; i < luxels; ++i) {
            const auto truth = static_cast<double>(luminance(full.pixels()[i]));
            if (truth == 0.0) continue;
            const double d = static_cast<double>(luminance(one.pixels()[i])) - truth;
            const double v = scale * scale * static_cast<double>(variance.pixels()[i]);
            bars.variance[i] += d * d / static_cast<double>(seeds);
            bars.estimate[i] += v / static_cast<double>(seeds);
            ++lit;
            covered += d * d <= 4.0 * v + 1e-10 * truth * truth ? 1.0 : 0.0;
        }
        bars.covered.add(covered / lit);
    }
    return bars;
}

}  // namespace

// H0: at least 90 % of the lit luxels lie within two standard errors of the full sum, in the mean
// over 100 seeds; rejected where the mean lies below by 2.4 of its own standard errors (t, level 1
// %, one-sided). A bar half as wide is rejected.
TEMPLATE_TEST_CASE("two standard errors cover 90 % of the luxels at least, whatever the cut",
                   "[statistical]", mir::Lambert, mir::CookTorrance) {
    const KdStage<TestType> stage({48, 32}, {48, 32}, 2000);
    const auto check = [&](const auto& policy) {
        const mirtest::Moments whole = bars_of(stage, policy, 100, 1.0).covered;
        CAPTURE(whole.mean(), whole.standard_error());
        CHECK(whole.mean() + 2.4 * whole.standard_error() > 0.9);
        const mirtest::Moments half = bars_of(stage, policy, 100, 0.5).covered;
        CAPTURE(half.mean());
        CHECK(half.mean() + 2.4 * half.standard_error() < 0.9);
    };
    for (const std::uint32_t picks : {4u, 64u}) {
        check(mir::DeviationCut{picks});
        check(mir::EqualCountCut{picks});
    }
}

// No bound, so not in every luxel; but nine in ten have an estimate of at least four fifths of what
// 100 seeds measure, and their sum is not below.
TEST_CASE("the estimated variance of picks is not below the measured one", "[statistical]") {
    const KdStage<mir::Lambert> stage({48, 32}, {48, 32}, 2000);
    const Bars bars = bars_of(stage, mir::DeviationCut{16}, 100, 1.0);
    double measured = 0.0;
    double estimated = 0.0;
    double low = 0.0;
    double lit = 0.0;
    for (std::size_t i = 0; i < bars.variance.size(); ++i) {
        measured += bars.variance[i];
        estimated += bars.estimate[i];
        if (bars.variance[i] == 0.0) continue;
        ++lit;
        if (bars.estimate[i] < 0.8 * bars.variance[i]) ++low;
    }
    CHECK(estimated > measured);
    CHECK(low < 0.1 * lit);
}

TEST_CASE("the variance of picks changes no light, and no thread, tile or instruction set it") {
    const KdStage<mir::CookTorrance> stage({100, 70}, {48, 32}, 300);
    const mir::VplTree tree = tree_of(stage);
    mir::Image<float> wanted;
    const auto light = gather(stage, tree, mir::DeviationCut{100}, 9, &wanted);
    CHECK(mirtest::pixels_that_differ(light, gather(stage, tree, mir::DeviationCut{100}, 9)) == 0);
    const auto same = [&](const mir::Image<float>& other) {
        return mirtest::same_bits(other, wanted);
    };
    const KdStage<mir::CookTorrance> other({100, 70}, {112, 80}, 300);
    mir::Image<float> found;
    gather(other, tree, mir::DeviationCut{100}, 9, &found);
    CHECK(same(found));
    mirtest::BackwardsExecutor executor{3};
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        reconstruct_cuts(stage.gbuffer(), tree, stage.visibility(), bounded<mir::CookTorrance>(),
                         mir::DeviationCut{100}, {9}, executor, nullptr, set, &found);
        CHECK(same(found));
    }
}

TEST_CASE("a cut whose nodes all hold one VPL has no variance, nor has a tree of none") {
    const KdStage<mir::Lambert> stage({32, 32}, {32, 32}, 100);
    const mir::VplTree tree = tree_of(stage);
    const mir::Image<float> none({32, 32});
    mir::Image<float> found;
    gather(stage, tree, mir::CompleteCut{}, 1, &found);
    CHECK(mirtest::same_bits(found, none));
    mir::InlineExecutor executor;
    const mir::VplTree empty(mir::VplSpan<mir::Space::host>{}, executor);
    gather(stage, empty, mir::DeviationCut{8}, 1, &found);
    CHECK(mirtest::same_bits(found, none));
}
