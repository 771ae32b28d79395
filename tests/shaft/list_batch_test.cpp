// SPDX-License-Identifier: MIT
#include "mir/shaft/device/list_batch.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <vector>

// Lists of leaves, unpacked for several pairs at a time.

namespace {

using mir::LaneGroup;
using mir::ListBatch;
using mir::ListedPair;
using mir::Space;

/// A hierarchy of which nothing exists but where the triangles of its nodes are: node i has those
/// from 100 i on, `counts[i]` of them, at most eight in a leaf.
class Lists {
 public:
    /// Lists of that many nodes each, one node behind the other.
    Lists(const std::vector<std::uint32_t>& counts, const std::vector<std::uint32_t>& sizes) {
        for (const std::uint32_t count : counts) {
            const auto node = static_cast<std::uint32_t>(links_.size());
            mir::NodeLinks links{0, 100 * node, {0, 0}};
            for (std::uint32_t k = 0; k < 8; ++k) {
                const std::uint32_t in_half = count > 32 * (k / 4) ? count - 32 * (k / 4) : 0;
                const std::uint32_t end = std::min(in_half, 8 * (k % 4 + 1));
                links.ends[k / 4] |= end << 8 * (k % 4);
            }
            links_.push_back(links);
            pool_.push_back(mir::MetLeaves::of(node, 0xFFu).bits);
        }
        std::uint32_t first = 0;
        for (const std::uint32_t size : sizes) {
            const auto cluster = static_cast<std::uint32_t>(lists_.size());
            lists_.push_back({{cluster, 10 + cluster}, first, size});
            first += size;
        }
    }

    /// Unpacks from list `from` on.
    ListBatch unpacked(std::uint32_t from = 0) {
        mir::QuantisedBvhView<Space::host> bvh;
        bvh.links = links_.data();
        ListBatch batch;
        triangles.assign(ListBatch::most_triangles, 0);
        mir::unpack_lists(LaneGroup{}, bvh, pool_.data(), lists_.data() + from,
                          static_cast<std::uint32_t>(lists_.size()) - from, batch,
                          triangles.data());
        return batch;
    }

    std::vector<std::uint32_t> triangles;

 private:
    std::vector<mir::NodeLinks> links_;
    std::vector<std::uint32_t> pool_;
    std::vector<ListedPair> lists_;
};

}  // namespace

TEST_CASE("A batch has the triangles of its lists one behind the other") {
    Lists lists({3, 0, 40, 5, 1, 64}, {2, 1, 1, 2});
    const ListBatch batch = lists.unpacked();
    REQUIRE(batch.lists == 4);
    REQUIRE(batch.triangles == 113);
    const std::uint32_t ends[] = {3, 43, 48, 113};
    for (std::uint32_t k = 0; k < 4; ++k) {
        CHECK(batch.ends[k] == ends[k]);
        CHECK(batch.clusters[k] == k);
        CHECK(batch.vpls[k] == 10 + k);
    }
    CHECK(lists.triangles[2] == 2);
    CHECK(lists.triangles[3] == 200);
    CHECK(lists.triangles[42] == 239);
    CHECK(lists.triangles[43] == 300);
    CHECK(lists.triangles[48] == 400);
    CHECK(lists.triangles[112] == 563);
    const auto list = batch.lists_from(LaneGroup{}, 32);
    CHECK(list[0] == 1);
    CHECK(list[10] == 1);
    CHECK(list[11] == 2);
    CHECK(list[16] == 3);
    CHECK(list[31] == 3);
}

TEST_CASE("Lists without a triangle end where they begin") {
    Lists lists({0, 2, 0}, {1, 1, 1});
    const ListBatch batch = lists.unpacked();
    CHECK(batch.lists == 3);
    CHECK(batch.triangles == 2);
    CHECK((batch.ends[0] == 0 && batch.ends[1] == 2 && batch.ends[2] == 2));
    CHECK(batch.ends[3] == ~0u);
}

TEST_CASE("A batch takes the lists whose nodes and triangles fit") {
    SECTION("no more nodes than lanes") {
        Lists lists(std::vector<std::uint32_t>(64, 1), {20, 12, 1, 31});
        CHECK(lists.unpacked().lists == 2);
        CHECK(lists.unpacked().triangles == 32);
        CHECK(lists.unpacked(2).lists == 2);
    }
    SECTION("no more lists than it has room for") {
        Lists lists(std::vector<std::uint32_t>(9, 1), std::vector<std::uint32_t>(9, 1));
        CHECK(lists.unpacked().lists == ListBatch::most_lists);
        CHECK(lists.unpacked(8).lists == 1);
    }
    SECTION("no more triangles than it has room for") {
        static_assert(ListBatch::most_triangles == 224);
        Lists lists({64, 64, 64, 32, 1, 64, 64, 64, 33}, {1, 1, 2, 1, 4});
        CHECK(lists.unpacked().lists == 3);
        CHECK(lists.unpacked().triangles == 224);
        CHECK(lists.unpacked().ends[3] == ~0u);
        CHECK(lists.unpacked(3).lists == 1);
        CHECK(lists.unpacked(4).lists == 0);
        CHECK(lists.unpacked(4).triangles == 0);
    }
}

TEST_CASE("The clusters of a block share its triangles, as many as fit") {
    const std::vector<std::uint32_t> pool = [] {
        std::vector<std::uint32_t> places(40);
        for (std::uint32_t k = 0; k < 40; ++k) places[k] = 500 + k;
        return places;
    }();
    std::vector<std::uint32_t> triangles(ListBatch::most_triangles);
    ListBatch batch;
    mir::share_list(LaneGroup{}, pool.data(), {{3, 7}, 2, 5}, 0, batch, triangles.data());
    REQUIRE(batch.lists == 8);
    REQUIRE(batch.triangles == 40);
    for (std::uint32_t k = 0; k < 8; ++k) {
        CHECK(batch.clusters[k] == 24 + k);
        CHECK(batch.vpls[k] == 7);
        CHECK(batch.ends[k] == 5 * (k + 1));
        for (std::uint32_t t = 0; t < 5; ++t) CHECK(triangles[5 * k + t] == 502 + t);
    }
    mir::share_list(LaneGroup{}, pool.data(), {{3, 7}, 8, 32}, 0, batch, triangles.data());
    CHECK(batch.lists == 7);
    mir::share_list(LaneGroup{}, pool.data(), {{3, 7}, 8, 32}, 7, batch, triangles.data());
    CHECK(batch.lists == 1);
    CHECK(batch.clusters[0] == 31);
    CHECK(triangles[31] == 539);
}
