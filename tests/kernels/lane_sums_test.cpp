// SPDX-License-Identifier: MIT
#include "mir/kernels/lane_sums.hpp"

#include "support/catch.hpp"

#include <set>

namespace {

using mir::LaneSums;

std::uint32_t place(std::uint32_t vpl, std::uint32_t k) {
    return LaneSums::column(LaneSums::row(vpl), k);
}
/// Of a device: 32 of them, one word each.
std::uint32_t bank(std::uint32_t place) { return place % 32; }

}  // namespace

TEST_CASE("Sums of lanes keep what was put there") {
    LaneSums sums;
    const auto value = [](std::uint32_t vpl, std::uint32_t k) {
        const auto x = static_cast<float>(16 * vpl + k);
        return mir::Rgb{x, x + 1000.0f, x + 2000.0f};
    };
    for (std::uint32_t vpl = 0; vpl < 32; ++vpl)
        for (std::uint32_t k = 0; k < LaneSums::columns; ++k)
            sums.put(place(vpl, k), value(vpl, k));
    for (std::uint32_t vpl = 0; vpl < 32; ++vpl)
        for (std::uint32_t k = 0; k < LaneSums::columns; ++k)
            CHECK(sums[place(vpl, k)] == value(vpl, k));
}

TEST_CASE("Sums that lanes read together lie in different banks") {
    for (std::uint32_t vpl = 0; vpl + 1 < 32; ++vpl) {
        std::set<std::uint32_t> banks;
        for (std::uint32_t k = 0; k < LaneSums::columns; ++k)
            banks.insert({bank(place(vpl, k)), bank(place(vpl + 1, k))});
        CHECK(banks.size() == 32);
    }
    for (std::uint32_t k = 0; k < LaneSums::columns; ++k) {
        std::set<std::uint32_t> banks;
        for (std::uint32_t vpl = 0; vpl < 32; ++vpl) banks.insert(bank(place(vpl, k)));
        CHECK(banks.size() == 32);
    }
}
