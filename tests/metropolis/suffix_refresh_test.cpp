// SPDX-License-Identifier: MIT
#include "mir/metropolis/suffix_refresh.hpp"

#include "mir/metropolis/acceptance.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"
#include "support/wedge.hpp"

#include <array>
#include <cmath>

// Independent weighted paths stand for the stationary law: sum W h / N estimates int h Y(F). A
// kernel keeps that law if W (h(after) - h(before)) has mean zero for every h.

namespace {

using mir::CookTorrance;
using mir::Lambert;
using mir::PathMeasure;
using mir::PathTechniques;
using mir::Stream;
using mir::SuffixProposal;
using mir::TechniqueTable;
using mir::WeightedPath;
using mirtest::Moments;
using mirtest::PathLab;
using mirtest::Wedge;
using mirtest::WedgeLights;

/// What is looked at: length, log R, whether there is one reflection behind x2, height of x3.
using Scalars = std::array<double, 4>;

Scalars scalars_of(const WeightedPath& p) {
    const std::uint32_t k = p.path.edges();
    return {static_cast<double>(k), std::log(luminance(p.measure.leaving)), k == 3 ? 1.0 : 0.0,
            static_cast<double>(p.path.x(3).position.y)};
}

/// Three steps of the independence chain with weights by `density` of (PathMeasure, k).
template <class World, class Density>
WeightedPath refreshed(const SuffixProposal<World>& proposal, const WeightedPath& start,
                       std::uint64_t i, const Density& density) {
    const auto weight = [&](const WeightedPath& p) {
        return luminance(p.measure.contribution) / density(p.measure, p.path.edges());
    };
    WeightedPath current = start;
    WeightedPath next;
    for (std::uint64_t r = 0; r < 3; ++r) {
        const mir::Random u(711, Stream::suffix, 3 * i + r);
        proposal.draw(start, u, next);
        if (!(next.weight > 0.0)) continue;
        const double a = mir::acceptance(weight(current), weight(next));
        if (static_cast<double>(u.at(mir::path_dimension::count)) < a) std::swap(current, next);
    }
    return current;
}

const TechniqueTable table(3, 7, PathTechniques::bidirectional);

/// p-value, after Sidak, of "refreshing changes no mean".
template <class World, class Density>
double p_of_refresh(const World& world, std::uint64_t paths, const Density& density) {
    const mir::PathGenerator<World> generator(world, table);
    const SuffixProposal<World> proposal(world, table);
    std::array<Moments, 4> change;
    WeightedPath p;
    std::uint64_t moved = 0;
    for (std::uint64_t i = 0; i < paths; ++i) {
        generator.generate(mir::Random(710, Stream::test, i), p);
        Scalars difference{};
        if (p.weight > 0.0) {
            const Scalars before = scalars_of(p);
            const WeightedPath q = refreshed(proposal, p, i, density);
            REQUIRE(q.path.x(2).position == p.path.x(2).position);
            const Scalars after = scalars_of(q);
            for (std::size_t j = 0; j < 4; ++j) difference[j] = p.weight * (after[j] - before[j]);
            moved += after != before ? 1u : 0u;
        }
        for (std::size_t j = 0; j < 4; ++j) change[j].add(difference[j]);
    }
    CHECK(moved > 1000);
    double smallest = 1.0;
    for (const Moments& m : change) smallest = std::min(smallest, mirtest::mean_p_value(m, 0.0));
    return -std::expm1(4 * std::log1p(-smallest));
}

template <class World>
auto right_density(const World& world) {
    return [s = SuffixProposal<World>(world, table)](const PathMeasure& m, std::uint32_t k) {
        return s.density(m, k);
    };
}

}  // namespace

// H0: refreshing the light behind x2 leaves the means of length, log R and x3 alone. Student's t of
// weighted differences, 1 % over 4 scalars and 4 scenes; seeds 710 and 711.

TEST_CASE("refreshed suffixes have the law of the others in the furnace", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    CHECK(p_of_refresh(lab.world(), 30'000, right_density(lab.world())) > 0.0025);
}

TEST_CASE("refreshed suffixes have the law of the others between slanted walls", "[statistical]") {
    const auto lights = GENERATE(WedgeLights::ceiling, WedgeLights::spot);
    const PathLab<Lambert> lab(Wedge(lights).scene());
    CHECK(p_of_refresh(lab.world(), 200'000, right_density(lab.world())) > 0.0025);
}

TEST_CASE("refreshed suffixes have the law of the others between glossy walls", "[statistical]") {
    const PathLab<CookTorrance> lab(Wedge(WedgeLights::two_sided, 1.0f).scene());
    CHECK(p_of_refresh(lab.world(), 200'000, right_density(lab.world())) > 0.0025);
}

TEST_CASE("the weight of a suffix is its light and the floor's share of R over its density") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::ceiling).scene());
    const mir::PathGenerator generator(lab.world(), table);
    constexpr double floor = 0.7;
    const SuffixProposal proposal(lab.world(), table, floor);
    const auto check = [&](const WeightedPath& p) {
        const double target =
            luminance(p.measure.contribution) + floor * luminance(p.measure.leaving);
        const double density = proposal.density(p.measure, p.path.edges());
        CHECK(proposal.weight(p.measure, p.path.edges()) == mirtest::Approx(target / density));
    };
    WeightedPath p;
    WeightedPath q;
    int found = 0;
    for (std::uint64_t i = 0; i < 10'000; ++i) {
        generator.generate(mir::Random(712, Stream::test, i), p);
        if (!(p.weight > 0.0)) continue;
        check(p);
        proposal.draw(p, mir::Random(713, Stream::test, i), q);
        if (!(q.weight > 0.0)) continue;
        ++found;
        CHECK(q.weight == proposal.weight(q.measure, q.path.edges()));
    }
    CHECK(found > 100);
}

TEST_CASE("suffixes weighed as if light paths drew x2 too are rejected", "[statistical]") {
    const PathLab<Lambert> lab(Wedge(WedgeLights::point).scene());
    const auto wrong = [](const PathMeasure& m, std::uint32_t k) {
        double density = 0.0;
        for (std::uint32_t s = 0; s < k; ++s)
            density += table.probability_of({k, s}) * technique_density(m, k, s, 3);
        return density * table.probability(k);
    };
    CHECK(p_of_refresh(lab.world(), 400'000, wrong) < 0.0025);
}

TEST_CASE("suffixes weighed without the probability of their technique are rejected",
          "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    const bool length = GENERATE(true, false);
    const auto wrong = [&](const PathMeasure& m, std::uint32_t k) {
        if (length) return SuffixProposal(lab.world(), table).density(m, k) / table.probability(k);
        double density = 0.0;
        for (std::uint32_t s = 0; s + 2 <= k; ++s) density += technique_density(m, k, s, 3);
        return density * table.probability(k);
    };
    CHECK(p_of_refresh(lab.world(), 30'000, wrong) < 0.0025);
}
