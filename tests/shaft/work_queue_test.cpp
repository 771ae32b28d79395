// SPDX-License-Identifier: MIT
#include "mir/shaft/device/work_queue.hpp"

#include "conformance/worlds.hpp"
#include "shaft/queued_work.hpp"
#include "support/catch.hpp"

#include <algorithm>

// Queues and pools that run full, against lanes that come one after the other.

namespace {

using mir::LaneGroup;
using mir::OpenPair;

std::uint32_t random_bits(mir::Random& random) {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < 32; ++k)
        if (random.next() < 0.4f) bits |= 1u << k;
    return bits;
}

/// Items of a queue that lanes were added to, and whether it said right for which it had no room.
struct Appended {
    std::vector<OpenPair> items;
    std::uint32_t asked = 0;
    bool is_right = true;
};

Appended appended(std::uint32_t capacity, const std::vector<std::uint32_t>& lanes) {
    mirtest::Queued<OpenPair> queue(capacity);
    Appended result;
    std::uint32_t room = capacity;
    for (std::uint32_t turn = 0; turn < lanes.size(); ++turn) {
        std::uint32_t refused = 0;
        for (std::uint32_t lane = 0; lane < 32; ++lane) {
            if ((lanes[turn] >> lane & 1u) == 0) continue;
            if (room == 0) refused |= 1u << lane;
            if (room > 0) --room;
        }
        const std::uint32_t left =
            queue.view().append(LaneGroup{}, lanes[turn], [&](std::uint32_t lane) {
                return OpenPair{turn, lane};
            });
        result.is_right = result.is_right && left == refused;
    }
    result.items = queue.items();
    result.asked = queue.asked();
    return result;
}

/// What the pool should say to lanes that ask for that many words each.
struct Reserved {
    std::uint32_t lanes = 0;
    std::uint32_t first[32] = {};
    std::uint32_t used = 0;  ///< afterwards
};

Reserved expected(std::uint32_t used, std::uint32_t capacity, const std::uint32_t* counts) {
    Reserved reserved;
    const bool is_full = used > capacity;  // then nothing more is counted
    reserved.used = used;
    for (std::uint32_t lane = 0; lane < 32; ++lane) {
        reserved.first[lane] = used;
        used += counts[lane];
        if (counts[lane] > 0 && used <= capacity) reserved.lanes |= 1u << lane;
    }
    if (!is_full) reserved.used = used;
    return reserved;
}

}  // namespace

TEST_CASE("A queue keeps the items of lanes that fit, each once, and names the others") {
    mir::Random random = mirtest::test_random(50);
    std::vector<std::uint32_t> lanes = {0u, ~0u, 1u, 1u << 31};
    while (lanes.size() < 20) lanes.push_back(random_bits(random));
    std::vector<OpenPair> all;
    for (std::uint32_t turn = 0; turn < lanes.size(); ++turn)
        for (std::uint32_t lane = 0; lane < 32; ++lane)
            if ((lanes[turn] >> lane & 1u) != 0) all.push_back({turn, lane});
    const auto count = static_cast<std::uint32_t>(all.size());
    for (const std::uint32_t capacity : {0u, 1u, 31u, 33u, 34u, 40u, count - 1, count, 1000u}) {
        CAPTURE(capacity);
        const Appended found = appended(capacity, lanes);
        CHECK(found.is_right);
        CHECK(found.asked == count);
        REQUIRE(found.items.size() == std::min(capacity, count));
        for (std::size_t i = 0; i < found.items.size(); ++i) {
            CHECK(found.items[i].cluster == all[i].cluster);
            CHECK(found.items[i].vpl == all[i].vpl);
        }
    }
}

TEST_CASE("A queue hands out every item once, and numbers from its size on when it is empty") {
    mirtest::Queued<OpenPair> queue(std::vector<OpenPair>(70));
    std::vector<std::uint32_t> times(70);
    for (const std::uint32_t at_once : {1u, 32u, 0u, 5u, 40u}) {
        const std::uint32_t first = queue.view().take(LaneGroup{}, at_once);
        for (std::uint32_t k = first; k < std::min(first + at_once, queue.view().size()); ++k)
            ++times[k];
    }
    CHECK(times == std::vector<std::uint32_t>(70, 1u));
    CHECK(queue.view().take(LaneGroup{}, 1) >= queue.view().size());
    CHECK(queue.items().size() == 70);
}

TEST_CASE(
    "A pool gives lanes places of their own while they fit, and counts no further than that") {
    mir::Random random = mirtest::test_random(51);
    for (const std::uint32_t capacity : {0u, 1u, 50u, 300u, 1000u}) {
        CAPTURE(capacity);
        mirtest::PoolMemory pool(capacity);
        for (std::uint32_t turn = 0; turn < 40; ++turn) {
            LaneGroup::PerLane<std::uint32_t> counts, places;
            std::uint32_t plain[32];
            const std::uint32_t some = turn % 7 == 3 ? 0u : random_bits(random);
            for (std::uint32_t lane = 0; lane < 32; ++lane)
                counts[lane] = plain[lane] = (some >> lane & 1u) != 0 ? 1 + (lane + turn) % 5 : 0;
            const std::uint32_t used = pool.used();
            const Reserved truth = expected(used, capacity, plain);
            const std::uint32_t stored = pool.view().reserve(LaneGroup{}, counts, places);
            CHECK(stored == truth.lanes);
            for (std::uint32_t lane = 0; lane < 32; ++lane)
                if ((stored >> lane & 1u) != 0) CHECK(places[lane] == truth.first[lane]);
            CHECK(pool.used() == truth.used);
        }
    }
}
