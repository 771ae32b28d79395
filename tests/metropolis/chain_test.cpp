// SPDX-License-Identifier: MIT
#include "mir/metropolis/chain.hpp"

#include "mir/metropolis/bootstrap.hpp"
#include "mir/metropolis/systematic_resampling.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/independent_chains.hpp"
#include "support/path_lab.hpp"
#include "support/wedge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

// Chains are correlated with themselves, so every test looks at the last state of each of many
// short chains: those are independent draws.

namespace {

using mir::ChainOptions;
using mir::ChainRules;
using mir::Lambert;
using mir::LargeStep;
using mir::Mutation;
using mir::PathChain;
using mir::PathGenerator;
using mir::PathTechniques;
using mir::Stream;
using mir::TechniqueTable;
using mirtest::Moments;
using mirtest::PathLab;
using World = PathLab<Lambert>::World;
using Generator = PathGenerator<World>;

constexpr std::uint32_t shortest = 2;
constexpr std::uint32_t longest = 8;

/// The furnace, the seeds of chains in it and how those chains run.
struct Furnace {
    PathLab<Lambert> lab{mir::builtin::make("furnace")};
    Generator generator{lab.world(), {shortest, longest, PathTechniques::bidirectional}};
    std::uint64_t seed = 0;
    std::vector<std::uint32_t> starts;

    /// With seeds of `chains` chains, taken from enough paths that their laws hardly differ from
    /// the stationary one.
    Furnace(std::uint64_t with_seed, std::uint32_t chains) : seed(with_seed) {
        constexpr std::uint64_t paths = 200'000;
        mir::InlineExecutor executor;
        const auto b = mir::bootstrap(generator, {0.01, paths, paths}, seed, executor);
        starts = mir::systematic_resampling(b.weights, chains, 0.5);
    }
    /// Valid until the next one is asked for.
    template <class Rules = ChainRules>
    [[nodiscard]] PathChain<World, Rules> chain(std::uint32_t c, Mutation mutation) const {
        const LargeStep start{Stream::bootstrap, std::uint64_t{starts[c]}};
        return {generator, options_for(mutation), seed, c, start, *state_};
    }

 private:
    /// Large steps would hide what the others do wrong.
    static const ChainOptions& options_for(Mutation mutation) {
        static const ChainOptions primary{Mutation::primary, 0.1, 4};
        static const ChainOptions bidirectional{Mutation::bidirectional, 0.1, 4};
        return mutation == Mutation::primary ? primary : bidirectional;
    }

    std::unique_ptr<mir::ChainState> state_ = std::make_unique<mir::ChainState>();
};

/// Chi-square of the lengths against P(k) ~ rho^k on the chain's range.
double p_of_lengths(const std::vector<std::uint32_t>& lengths) {
    std::vector<double> observed(longest + 1);
    std::vector<double> expected(longest + 1);
    for (std::uint32_t k : lengths) observed[k] += 1.0;
    double sum = 0.0;
    for (std::uint32_t k = shortest; k <= longest; ++k) sum += expected[k] = std::pow(0.5, k);
    for (double& e : expected) e *= static_cast<double>(lengths.size()) / sum;
    for (std::uint32_t k = shortest; k <= longest; ++k)
        UNSCOPED_INFO("k " << k << ": " << observed[k] << " of " << expected[k]);
    return mirtest::chi_square(observed, expected).p_value;
}

constexpr std::uint32_t chains = 8000;
constexpr std::uint32_t steps = 24;

template <class Rules = ChainRules>
double p_of_chains(Mutation mutation, std::uint64_t seed) {
    const Furnace furnace(seed, chains);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t c = 0; c < chains; ++c) {
        auto chain = furnace.chain<Rules>(c, mutation);
        for (std::uint32_t i = 0; i < steps; ++i) chain.step();
        lengths.push_back(chain.current().path.edges());
    }
    return p_of_lengths(lengths);
}

/// The density of the new vertices when all of them came from the camera's side.
struct OneStrategy : ChainRules {
    static double refill(const mir::PathMeasure& m, std::uint32_t k, std::uint32_t left,
                         std::uint32_t n) {
        double density = left < 2 && left + n >= 2 ? m.area_unit : 1.0;
        for (std::uint32_t i = left + 1; i <= left + n && i < k; ++i)
            density *= i == 1 ? 1.0 : m.from_eye[i];
        return left + n == k ? density * m.next_event : density;
    }
};

struct NoGapProbability : ChainRules {
    static double choice(const mir::GapChoices& gaps, std::uint32_t k, mir::PathGap out,
                         std::uint32_t n) {
        return gaps.count_probability(k, out, n);
    }
};

struct NoCountProbability : ChainRules {
    static double choice(const mir::GapChoices& gaps, std::uint32_t k, mir::PathGap out,
                         std::uint32_t /*n*/) {
        return gaps.gap_probability(k, out);
    }
};

struct AcceptAll : ChainRules {
    static bool accepts(double /*number*/, double probability) { return probability > 0.0; }
};

}  // namespace

// H0: in the furnace the lengths of a chain's states have P(k) ~ rho^k. Chi-square over the last
// states of 8000 chains of 24 steps, 1 % over both mutations; seeds 100 and 101.
TEST_CASE("in the furnace a path of one more edge is rho times as frequent", "[statistical]") {
    CHECK(p_of_chains(Mutation::primary, 100) > mirtest::sidak(0.01, 2));
    CHECK(p_of_chains(Mutation::bidirectional, 101) > mirtest::sidak(0.01, 2));
}

TEST_CASE("refills weighed by one strategy alone are rejected", "[statistical]") {
    CHECK(p_of_chains<OneStrategy>(Mutation::bidirectional, 101) < 1e-6);
}

TEST_CASE("a mutation that forgets how likely its gap was is rejected", "[statistical]") {
    CHECK(p_of_chains<NoGapProbability>(Mutation::bidirectional, 101) < 1e-6);
}

TEST_CASE("a mutation that forgets how likely its number of vertices was is rejected",
          "[statistical]") {
    CHECK(p_of_chains<NoCountProbability>(Mutation::bidirectional, 101) < 1e-6);
}

TEST_CASE("mutations that are always accepted are rejected", "[statistical]") {
    CHECK(p_of_chains<AcceptAll>(Mutation::primary, 100) < 1e-6);
    CHECK(p_of_chains<AcceptAll>(Mutation::bidirectional, 101) < 1e-6);
}

TEST_CASE("chains whose repeated states are dropped are rejected", "[statistical]") {
    const Furnace furnace(102, chains);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t c = 0; c < chains; ++c) {
        auto chain = furnace.chain(c, Mutation::bidirectional);
        while (chain.health().large.accepted + chain.health().bidirectional.accepted < steps / 3)
            chain.step();
        lengths.push_back(chain.current().path.edges());
    }
    CHECK(p_of_lengths(lengths) < 1e-6);
}

TEST_CASE("the longest stay is the longest run of rejected mutations") {
    const Furnace furnace(103, 4);
    const auto mutation = GENERATE(Mutation::primary, Mutation::bidirectional);
    for (std::uint32_t c = 0; c < 4; ++c) {
        auto chain = furnace.chain(c, mutation);
        const auto accepted = [&] {
            const mir::ChainHealth& h = chain.health();
            return h.large.accepted + h.small.accepted + h.bidirectional.accepted;
        };
        std::uint64_t stay = 0;
        std::uint64_t longest_stay = 0;
        for (int i = 0; i < 200; ++i) {
            const std::uint64_t before = accepted();
            chain.step();
            stay = accepted() == before ? stay + 1 : 0;
            longest_stay = std::max(longest_stay, stay);
        }
        REQUIRE(accepted() > 10);
        REQUIRE(accepted() < 190);
        CHECK(chain.health().longest_stay == longest_stay);
    }
}

TEST_CASE("the weights of large steps are those of all their tries") {
    const Furnace furnace(104, 1);
    auto chain = furnace.chain(0, Mutation::primary);
    mir::WeightMoments wanted;
    mir::WeightedPath p;
    for (int i = 0; i < 300; ++i) {
        const std::uint64_t before = chain.health().large.proposed;
        chain.step();
        if (chain.health().large.proposed == before) continue;
        for (std::uint32_t attempt = 0; attempt < 4; ++attempt) {
            const LargeStep step = mir::large_step(0, chain.steps(), attempt);
            furnace.generator.generate(mir::Random(104, step.stream, step.index), p);
            wanted.add(p.weight);
        }
    }
    const mir::PathLuminance a = chain.large_step_weights().estimate();
    const mir::PathLuminance b = wanted.estimate();
    REQUIRE(b.contributing > 10);
    CHECK(a.paths == b.paths);
    CHECK(a.contributing == b.contributing);
    CHECK(a.mean == b.mean);
    CHECK(a.standard_error == b.standard_error);
}

// Where states lie, not only how long they are. Chains start from bootstraps of their own; what is
// compared is P_c times an indicator with the weight of independent paths times the indicator.

namespace {

/// Means of weights over 3 x 3 cells of the film, 3 x 3 x 3 of the place of x2, and the lengths.
class SpaceMeans {
 public:
    SpaceMeans(const mir::Bounds& bounds) : bounds_(bounds), cells_(lengths + 5) {}

    /// A path of weight `weight`; only the film counts when there is none.
    void add(double weight, const mir::Path* path) {
        std::array<std::size_t, 3> hit{};
        if (path != nullptr) hit = {film(*path), place(*path), lengths + path->edges() - 3};
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            const bool inside =
                path != nullptr && std::find(hit.begin(), hit.end(), c) != hit.end();
            cells_[c].add(inside ? weight : 0.0);
        }
    }
    /// p-value, after Sidak, of "the means are those of `other`", over cells that are often hit.
    [[nodiscard]] double compare(const SpaceMeans& other) const {
        double smallest = 1.0;
        double tests = 0.0;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            if (other.cells_[c].mean() < 0.005 * other.cells_[lengths].mean()) continue;
            smallest = std::min(smallest, welch_p_value(cells_[c], other.cells_[c]));
            ++tests;
        }
        UNSCOPED_INFO(tests << " cells, smallest p " << smallest);
        return -std::expm1(tests * std::log1p(-smallest));
    }

 private:
    static constexpr std::size_t lengths = 9 + 27;

    static std::size_t cell(float x) {
        return static_cast<std::size_t>(std::clamp(3.0f * x, 0.0f, 2.0f));
    }
    static std::size_t film(const mir::Path& p) { return cell(p.film.y) * 3 + cell(p.film.x); }
    [[nodiscard]] std::size_t place(const mir::Path& p) const {
        const mir::Vec3 u = (p.x(2).position - bounds_.low) / (bounds_.high - bounds_.low);
        return 9 + (cell(u.z) * 3 + cell(u.y)) * 3 + cell(u.x);
    }

    mir::Bounds bounds_;
    std::vector<Moments> cells_;
};

template <mir::Bsdf B>
struct Space {
    using SpaceWorld = typename PathLab<B>::World;
    PathLab<B> lab;
    PathGenerator<SpaceWorld> generator{lab.world(), {3, 7, PathTechniques::bidirectional}};
    SpaceMeans wanted{lab.geometry.bounds()};

    explicit Space(mir::Scene scene) : lab(std::move(scene)) {
        mir::WeightedPath p;
        for (std::uint64_t i = 0; i < 300'000; ++i) {
            generator.generate(mir::Random(200, Stream::test, i), p);
            wanted.add(p.weight, p.weight > 0.0 ? &p.path : nullptr);
        }
    }
    template <class Rules = ChainRules>
    [[nodiscard]] double p_of_chains(Mutation mutation, std::uint32_t count) const {
        SpaceMeans got{lab.geometry.bounds()};
        mirtest::each_chain<Rules>(generator, {mutation, 0.1, 2}, count, 64, 48,
                                   mirtest::Scale::same_set, 210,
                                   [&](double p_c, const mir::WeightedPath* state) {
                                       got.add(p_c, state != nullptr ? &state->path : nullptr);
                                   });
        return got.compare(wanted);
    }
};

}  // namespace

// H0: states have the law Y(F) in space. Welch over the cells of film and place of x2 and the
// lengths, last states of 6000 chains against 300 000 independent paths, 1 % over 2 mutations and
// 3 scenes; seeds 200 and from 210 on.

TEST_CASE("chains visit film and VPL places as often as these bring light", "[statistical]") {
    const Space<Lambert> cornell(mir::builtin::make("cornell-inverted"));
    for (const Mutation mutation : {Mutation::primary, Mutation::bidirectional})
        CHECK(cornell.p_of_chains(mutation, 6000) > mirtest::sidak(0.01, 6));
}

TEST_CASE("chains between glossy walls visit places as often as these bring light",
          "[statistical]") {
    const auto lights = GENERATE(mirtest::WedgeLights::two_sided, mirtest::WedgeLights::point);
    const Space<mir::CookTorrance> wedge(mirtest::Wedge(lights, 1.0f).scene());
    for (const Mutation mutation : {Mutation::primary, Mutation::bidirectional})
        CHECK(wedge.p_of_chains(mutation, 6000) > mirtest::sidak(0.01, 6));
}

TEST_CASE("chains that accept everything or weigh refills by one strategy are rejected in space",
          "[statistical]") {
    const Space<Lambert> cornell(mir::builtin::make("cornell-inverted"));
    CHECK(cornell.p_of_chains<AcceptAll>(Mutation::bidirectional, 6000) < 1e-4);
    CHECK(cornell.p_of_chains<OneStrategy>(Mutation::bidirectional, 6000) < 1e-4);
}
