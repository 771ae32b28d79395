// SPDX-License-Identifier: MIT
#include "runtime/band_book.hpp"

#include "support/catch.hpp"

#include <cstdint>
#include <vector>

TEST_CASE("Bands are dealt to who asks, and turns come in their order") {
    std::vector<std::uint32_t> owners;
    {
        mir::BandBook book(3, owners);
        CHECK(book.deal(1) == 0u);
        CHECK(book.deal(0) == 1u);
        CHECK(book.deal(1) == 2u);
        CHECK(!book.deal(0));
        book.ready(1);
        CHECK(!book.turn());
        book.ready(0);
        CHECK(book.turn() == 0u);
        CHECK(!book.turn());
        book.done();
        CHECK(book.turn() == 1u);
        CHECK(book.owner(1) == 0u);
        book.done();
        book.ready(2);
        CHECK(book.turn() == 2u);
        book.done();
        CHECK(book.is_complete());
    }
    mir::BandBook again(3, owners);
    CHECK(again.deal(0) == 1u);
    CHECK(!again.deal(0));
    CHECK(again.deal(1) == 0u);
    CHECK(again.deal(1) == 2u);
    CHECK(!again.deal(1));
}
