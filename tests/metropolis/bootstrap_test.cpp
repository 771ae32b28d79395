// SPDX-License-Identifier: MIT
#include "mir/metropolis/bootstrap.hpp"

#include "mir/host/tbb_executor.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/independent_chains.hpp"
#include "support/path_lab.hpp"
#include "support/wedge.hpp"

#include <bit>
#include <cmath>

namespace {

using mir::Bootstrap;
using mir::BootstrapOptions;
using mir::Lambert;
using mir::PathTechniques;
using mir::TechniqueTable;
using mirtest::each_chain;
using mirtest::Moments;
using mirtest::PathLab;
using mirtest::Scale;
using World = PathLab<Lambert>::World;
using Generator = mir::PathGenerator<World>;

/// Lengths 3 to 6 of the furnace: P_c is 1/2 (1/4 + 1/8 + 1/16 + 1/32).
constexpr double furnace_luminance = 0.5 * 15.0 / 32.0;
const TechniqueTable table(3, 6, PathTechniques::bidirectional);

Bootstrap run(const Generator& generator, const BootstrapOptions& options, std::uint64_t seed = 1) {
    mir::InlineExecutor executor;
    return mir::bootstrap(generator, options, seed, executor);
}

/// The camera shut into a box without a lamp.
mir::Scene dark_cell() {
    mir::Scene scene = mir::builtin::furnace_box();
    const auto black = scene.add(mir::lambertian("cell", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::box("cell", black, mir::Vec3(-0.1f), {0.2f, 0, 0}, {0, 0.2f, 0},
                                  {0, 0, 0.2f}));
    return scene;
}

/// A lamp behind the camera's back that lights nothing.
mir::Scene unseen_lamp() {
    mir::Scene scene = mir::builtin::parallel_squares();
    scene.cameras[0] = mir::Camera::look_at({5, 5, 0}, {9, 9, 0}, {0, 1, 0}, 0.5f);
    return scene;
}

mir::Scene black_walls() {
    mir::Scene scene = mir::builtin::furnace_box();
    scene.materials[0].base_color = {0, 0, 0};
    return scene;
}

}  // namespace

// H0: the mean of P_c is its closed form, and 95 % of the 95 % intervals hold it. Student's t and
// the normal approximation of the binomial, 1 % over both; seeds 800 to 1199.
TEST_CASE("P_c is unbiased and its interval honest", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    const Generator generator(lab.world(), table);
    Moments mean;
    int covered = 0;
    constexpr int runs = 400;
    for (std::uint64_t seed = 800; seed < 800 + runs; ++seed) {
        const auto p = run(generator, {0.01, 2048, 2048}, seed).luminance;
        mean.add(p.mean);
        covered += p.low() < furnace_luminance && furnace_luminance < p.high() ? 1 : 0;
    }
    CAPTURE(mean.mean(), mean.standard_error(), covered);
    CHECK(mirtest::mean_p_value(mean, furnace_luminance) > mirtest::sidak(0.01, 2));
    CHECK(mirtest::mean_p_value(mean, 1.01 * furnace_luminance) < mirtest::sidak(0.01, 2));
    const double deviation = std::sqrt(runs * 0.95 * 0.05);
    CHECK(std::fabs(covered - 0.95 * runs) < 2.81 * deviation);
}

TEST_CASE("the bootstrap grows until the error asked for, and not for ever") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-inverted"));
    const Generator generator(lab.world(), table);
    const Bootstrap coarse = run(generator, {0.2, 1024, 1u << 20});
    const Bootstrap fine = run(generator, {0.02, 1024, 1u << 20});
    CHECK(coarse.luminance.relative_error() <= 0.2);
    CHECK(fine.luminance.relative_error() <= 0.02);
    CHECK(fine.luminance.paths > 4 * coarse.luminance.paths);
    CHECK(fine.luminance.paths == fine.weights.size());
    // More paths are more of the same: the first ones stay.
    CHECK(std::equal(coarse.weights.begin(), coarse.weights.end(), fine.weights.begin()));
    const Bootstrap capped = run(generator, {1e-6, 1024, 5000});
    CHECK(capped.luminance.paths == 5000);
    CHECK(run(generator, {1e9, 7, 1u << 20}).luminance.contributing >= 256);
}

TEST_CASE("more chains deserve a larger bootstrap, unless an error was asked for") {
    const mir::BootstrapOptions own;
    CHECK(own.for_starts(1).relative_error == 0.05);
    for (const std::uint32_t starts : {256u, 1024u}) {
        const double error = own.for_starts(starts).relative_error;
        CHECK(std::fabs(starts * error * error - 0.33) < 1e-12);
    }
    CHECK(own.for_starts(512).max_paths == own.max_paths);
    CHECK(mir::BootstrapOptions{0.2}.for_starts(512).relative_error == 0.2);
}

TEST_CASE("scenes without light have P_c = 0") {
    const auto scene = GENERATE(0, 1, 2);
    const PathLab<Lambert> lab(scene == 0   ? dark_cell()
                               : scene == 1 ? unseen_lamp()
                                            : black_walls());
    const Bootstrap b = run(Generator(lab.world(), table), {0.01, 1024, 20'000});
    CHECK(b.luminance.mean == 0.0);
    CHECK(b.luminance.standard_error == 0.0);
    CHECK(b.luminance.contributing == 0);
    CHECK(b.luminance.paths == 20'000);
}

TEST_CASE("a bootstrap has the same bits for any executor") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    const Generator generator(lab.world(), table);
    const Bootstrap wanted = run(generator, {0.02, 3000, 1u << 20});
    mir::TbbExecutor threads(3);
    const Bootstrap got = mir::bootstrap(generator, {0.02, 3000, 1u << 20}, 1, threads);
    CHECK(got.weights == wanted.weights);
    CHECK(std::bit_cast<std::uint64_t>(got.luminance.mean) ==
          std::bit_cast<std::uint64_t>(wanted.luminance.mean));
}

namespace {

/// Smallest p-value, after Sidak, of "E[P_c h(X)] = int h Y(F) for the indicators of the lengths",
/// for states after `steps` steps from bootstraps of four paths.
double p_of_start(const Generator& generator, std::uint32_t steps, Scale scale) {
    std::array<Moments, 4> shares;
    const mir::ChainOptions options{mir::Mutation::primary, 0.5, 1};
    each_chain(generator, options, 60'000, 4, steps, scale, 1300,
               [&](double p_c, const mir::WeightedPath* state) {
                   for (std::uint32_t k = 3; k <= 6; ++k) {
                       const bool hit = state != nullptr && state->path.edges() == k;
                       shares[k - 3].add(hit ? p_c : 0.0);
                   }
               });
    double smallest = 1.0;
    for (std::uint32_t k = 3; k <= 6; ++k) {
        const double wanted = std::pow(0.5, k);
        UNSCOPED_INFO("k " << k << ": " << shares[k - 3].mean() << " of " << wanted << " +- "
                           << shares[k - 3].standard_error());
        smallest = std::min(smallest, mirtest::mean_p_value(shares[k - 3], wanted));
    }
    return -std::expm1(4 * std::log1p(-smallest));
}

}  // namespace

// H0: E[P_c h(X_i)] = int h Y(F) at steps 0, 1 and 2, from bootstraps of four paths. Student's t
// over 60 000 chains (fewer, and the skewed P_c of four paths is not normal enough), 1 % over 3
// steps and 4 lengths; seeds 1300 on.
TEST_CASE("chains are unbiased from their first state on", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    const Generator generator(lab.world(), table);
    const std::uint32_t steps = GENERATE(0u, 1u, 2u);
    CAPTURE(steps);
    CHECK(p_of_start(generator, steps, Scale::same_set) > mirtest::sidak(0.01, 3));
}

TEST_CASE("a scale from other paths than the chain's start is rejected", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    const Generator generator(lab.world(), table);
    CHECK(p_of_start(generator, 1, Scale::another_set) < 1e-6);
}
