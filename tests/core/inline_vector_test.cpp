// SPDX-License-Identifier: MIT
#include "mir/core/inline_vector.hpp"

#include "support/catch.hpp"

using Few = mir::InlineVector<int, 4>;

static_assert(std::is_trivially_copyable_v<Few>);

TEST_CASE("An inline vector holds what was pushed, up to its capacity") {
    Few v;
    CHECK(v.size() == 0);
    for (int i = 1; i <= 4; ++i) v.push_back(10 * i);
    CHECK(v.size() == 4);
    CHECK(v[0] == 10);
    CHECK(v.back() == 40);
    v[1] = 7;
    CHECK(v[1] == 7);
    v.clear();
    CHECK(v.size() == 0);
}

TEST_CASE("An inline vector that shrinks and grows again keeps its elements") {
    Few v;
    v.push_back(1);
    v.push_back(2);
    v.resize(1);
    CHECK(v.back() == 1);
    v.resize(2);
    CHECK(v.back() == 2);
}

TEST_CASE("An inline vector takes the front of another, and copies are independent") {
    Few from;
    for (int i = 0; i < 3; ++i) from.push_back(i);
    Few v;
    v.push_back(9);
    v.assign_front(from, 2);
    CHECK(v.size() == 2);
    CHECK(v[1] == 1);
    Few copy = v;
    copy[1] = 5;
    CHECK(v[1] == 1);
}
