// SPDX-License-Identifier: MIT
#include "mir/core/lanes.hpp"

#include "support/catch.hpp"
#include "support/instruction_sets.hpp"

using namespace mir::detail;

TEST_CASE("Truths of lanes become bits with every instruction set") {
    for (mir::InstructionSet set : mirtest::instruction_sets())
        for (std::uint32_t bits = 0; bits < 0x10000; bits += 7) {
            std::uint32_t found = 0;
            std::uint32_t by_the_set = 0;
            mir::run_with(set, [&](auto constant) {
                const auto test = [&](std::uint32_t k) { return (bits >> k & 1u) != 0; };
                found = lanes_where(test);
                by_the_set = lanes_where<constant.value>(test);
            });
            if (found != bits) CHECK(found == bits);
            if (by_the_set != bits) CHECK(by_the_set == bits);
        }
}

TEST_CASE("Truths of a node's children become bits with every instruction set") {
    for (mir::InstructionSet set : mirtest::instruction_sets())
        for (std::uint32_t bits = 0; bits < 256; ++bits) {
            SlotTruths truths;
            for (std::uint32_t k = 0; k < SlotTruths::count; ++k)
                truths.at[k] = (bits >> k & 1u) != 0 ? -1 : 0;
            mir::run_with(set, [&](auto constant) {
                CHECK(bits_of(truths) == bits);
                CHECK(bits_of<constant.value>(truths) == bits);
            });
        }
}

TEST_CASE("Bits are taken from the lowest on") {
    std::uint32_t bits = 0x80010004u;
    CHECK(pop_lowest(bits) == 2);
    CHECK(pop_lowest(bits) == 16);
    CHECK(pop_lowest(bits) == 31);
    CHECK(bits == 0);
}
