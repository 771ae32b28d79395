// SPDX-License-Identifier: MIT
#include "cuda/shafts.hpp"

#include "conformance/shaft_suite.hpp"
#include "mir/cuda/device.hpp"
#include "shaft/adversarial_cases.hpp"

// Words by the GPU's shafts against every triangle asked on the host, bit for bit.

namespace {

using mirtest::different_bits;
using mirtest::ShaftStage;
using mirtest::soup;
using mirtest::stage_of;

std::vector<std::uint32_t> words(const ShaftStage& stage,
                                 const mir::BackendShaftOptions& options = {},
                                 std::optional<mir::BlockedLayout> layout = std::nullopt) {
    const mir::cuda::Backend backend(mir::cuda::select_device(0));
    return mirtest::shaft_words_on_gpu(
        backend, {stage.hits(), stage.lit().vpls, &stage.bvh(), stage.sigma(), layout}, options);
}

const auto by_default = [](const ShaftStage& stage) { return words(stage); };

}  // namespace

TEST_CASE("The GPU's shafts give the bits of every triangle asked on the host") {
    mirtest::shaft_soup_suite(by_default);
}

TEST_CASE("The GPU's shafts give the bits of single segments in a closed room") {
    for (const std::uint32_t slices : {12u, 120u}) {
        CAPTURE(slices);
        const mirtest::World world = mirtest::sphere_in_box(slices);
        const ShaftStage stage = stage_of(world, 60000, 70);
        CHECK(different_bits(words(stage), stage.by_segments()) == 0);
        CHECK(different_bits(words(stage, {0, 1000}), stage.by_segments()) == 0);
    }
}

TEST_CASE("No limit, batch or lack of room changes a bit of the GPU's shafts") {
    const mirtest::World world = soup(false);
    const ShaftStage stage = stage_of(world, 3000, 37);
    const auto truth = stage.by_brute_force();
    for (std::uint32_t nodes : {0u, 1u, 3u, 1000u})
        for (std::uint32_t vpls : {1u, 36u, 256u})
            for (std::uint32_t leaves : {0u, 9u, 100u, 1u << 20}) {
                CAPTURE(nodes, vpls, leaves);
                CHECK(different_bits(words(stage, {nodes, nodes, vpls, 7, leaves}), truth) == 0);
            }
}

TEST_CASE("Any number of luxels and of VPLs is right for the GPU's shafts") {
    mirtest::shaft_count_suite(by_default, {0, 1, 33, 256, 513, 8193}, {0, 1, 31, 33, 129});
}

TEST_CASE("Luxels that the GPU puts into clusters by pages keep their bits") {
    const mirtest::World world = mirtest::sphere_in_box();
    for (const mir::BlockedLayout layout :
         {mir::BlockedLayout{8, 6}, {5, 2}, {1, 9}, {33, 1}, {3, 3}, {1, 1}}) {
        CAPTURE(layout.blocks_x, layout.blocks_y);
        const ShaftStage stage = stage_of(world, layout.size(), 70);
        REQUIRE(stage.hits().stride == layout.size());
        CHECK(different_bits(words(stage, {}, layout), stage.by_segments()) == 0);
    }
}

TEST_CASE("Configurations that are hard for shafts keep their bits on the GPU") {
    for (const auto& [name, stage, truth] : mirtest::adversarial_cases()) {
        INFO(name);
        CHECK(different_bits(words(stage), truth) == 0);
        CHECK(different_bits(words(stage, {0, 1000}), truth) == 0);
    }
}

TEST_CASE("Twenty runs of the GPU's shafts give the same words") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 20000, 40);
    const auto first = words(stage);
    for (int run = 1; run < 20; ++run) CHECK(words(stage) == first);
}
