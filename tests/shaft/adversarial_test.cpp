// SPDX-License-Identifier: MIT
#include "mir/host/backend.hpp"
#include "shaft/adversarial_cases.hpp"
#include "shaft/block_words.hpp"
#include "support/catch.hpp"
#include "support/shaft_words.hpp"

#include <map>

// Every form of shafts against every triangle asked; those of a GPU in tests/cuda/shafts_test.cpp.

namespace {

using mirtest::ShaftStage;

std::vector<std::uint32_t> by_backend(const ShaftStage& stage,
                                      const mir::BackendShaftOptions& options) {
    mir::InlineExecutor executor;
    return mirtest::shaft_words(mir::host::Backend(executor),
                                {stage.hits(), stage.lit().vpls, &stage.bvh(), stage.sigma()},
                                options);
}

}  // namespace

TEST_CASE("Configurations that are hard for shafts keep their bits in every form") {
    for (const auto& [name, stage, truth] : mirtest::adversarial_cases()) {
        INFO(name);
        CHECK(mirtest::different_bits(stage.by_shafts(), truth) == 0);
        for (const mir::InstructionSet set : mirtest::instruction_sets()) {
            CAPTURE(static_cast<int>(set));
            CHECK(mirtest::different_bits(mirtest::by_blocks(stage, {}, set), truth) == 0);
        }
        CHECK(mirtest::different_bits(by_backend(stage, {}), truth) == 0);
        CHECK(mirtest::different_bits(by_backend(stage, {0, 1000}), truth) == 0);
    }
}

TEST_CASE("Configurations that are hard for shafts hold what is hidden and what is seen") {
    std::map<std::string, std::pair<std::size_t, std::size_t>> hidden_and_seen;
    for (const auto& [name, stage, truth] : mirtest::adversarial_cases()) {
        const auto facing = stage.one_by_one([](mir::Vec3, mir::Vec3) { return false; });
        hidden_and_seen[name].first += mirtest::different_bits(truth, facing);
        hidden_and_seen[name].second +=
            mirtest::different_bits(truth, std::vector<std::uint32_t>(truth.size()));
    }
    for (const auto& [name, bits] : hidden_and_seen) {
        INFO(name);
        CHECK(bits.first > 0);
        CHECK(bits.second > 0);
    }
}

TEST_CASE("Two triangles that share the diagonal in front of a cluster never cover as one") {
    const mirtest::World world = mirtest::world_of(mirtest::square(1.0f, 0.5f));
    mir::PairTally counts;
    const ShaftStage stage(world.geometry,
                           {mirtest::floor_luxels(0.5f), {{{0, 0, 1}, {0, 0, -1}, {1, 1, 1}}}});
    static_cast<void>(stage.by_shafts({}, counts));
    CHECK(counts.block(mir::PairState::listed) == 1);
}

TEST_CASE("Slivers of next to no width are triangles") {
    CHECK(mirtest::slivers().stage.bvh().triangles().size() == 4);
}

TEST_CASE("Thousands of triangles in front of one cluster are given up on, and right") {
    const mirtest::World world = mirtest::crowd_of(5000);
    const ShaftStage stage(world.geometry, {mirtest::floor_luxels(0.3f),
                                            {{{0, 0, 1}, {0, 0, -1}, {1, 1, 1}},
                                             {{0.2f, 0.1f, 1.2f}, {0, 0, -1}, {1, 1, 1}}}});
    const std::vector<std::uint32_t> truth = stage.by_brute_force();
    mir::PairTally counts;
    CHECK(mirtest::different_bits(stage.by_shafts({}, counts), truth) == 0);
    // More than a list can hold: it is as full as it may be, not fuller.
    const mir::ShaftLimits loose{{100000, 1000}, {100000, 1000}};
    CHECK(mirtest::different_bits(stage.by_shafts(loose), truth) == 0);
    CHECK(counts.block(mir::PairState::unknown) == 2);
    CHECK(counts.cluster(mir::PairState::unknown) > 0);
}
