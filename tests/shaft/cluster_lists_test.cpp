// SPDX-License-Identifier: MIT
#include "mir/shaft/device/cluster_lists.hpp"

#include "mir/data/vpl_list.hpp"
#include "shaft/cluster_draws.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

// Lists of triangles made by hand, of all lengths and kinds, decided by the kernel of a backend and
// by hits_segment() for every luxel and triangle.

namespace {

using mir::Hit;
using mir::LaneGroup;
using mir::Space;
using mir::Vec3;

constexpr float sigma = 0x1p-19f;
constexpr std::uint32_t pairs = 48;
constexpr std::uint32_t block_words = mir::block_luxels / mir::cluster_luxels;
const Vec3 apex(0.1f, -0.05f, 0.9f);

/// What the triangles of a pair do.
enum class Kind : std::uint32_t { aside, small, wall, one_covers, mixed, count };

/// A cluster per pair, one VPL, and for each pair a list of triangles of one kind.
class Lists {
 public:
    explicit Lists(std::uint32_t seed) : random_(mirtest::test_random(seed)) {
        for (std::uint32_t k = 0; k < pairs; ++k) {
            add_luxels();
            add_list(k);
        }
        records_.resize(pairs);
        const mirtest::HitRun run(hits_);
        for (std::uint32_t k = 0; k < pairs; ++k)
            records_[k] = mir::cluster_record(run.view(), 32 * k, 32, sigma);
    }

    /// Words by the kernel; pairs that it leaves open keep theirs.
    std::vector<std::uint32_t> decided(std::vector<bool>& open) const {
        return decided({}, lists_, open);
    }
    /// The same where the clusters of each block share the list of one of them, owner().
    std::vector<std::uint32_t> decided_by_blocks(std::vector<bool>& open) {
        std::vector<mir::ListedPair> blocks;
        for (std::uint32_t b = 0; b < pairs / block_words; ++b) {
            const std::uint32_t shared = owner(block_words * b);
            blocks.push_back({{b, 0}, static_cast<std::uint32_t>(pool_.size()), count_[shared]});
            for (std::uint32_t k = 0; k < count_[shared]; ++k) pool_.push_back(first_[shared] + k);
        }
        return decided(std::move(blocks), {}, open);
    }

    /// The first pair of the block of `pair` whose list a block could have, or the last one, of
    /// which no more than a triangle counts.
    std::uint32_t owner(std::uint32_t pair) {
        const std::uint32_t last = pair / block_words * block_words + block_words - 1;
        for (std::uint32_t k = last + 1 - block_words; k < last; ++k)
            if (count_[k] > 0 && count_[k] <= LaneGroup::width) return k;
        count_[last] = 1;
        return last;
    }

    /// By every triangle of the list of pair `owner`.
    std::uint32_t truth(std::uint32_t pair, std::uint32_t owner) const {
        std::uint32_t lit = facing_[pair];
        for (std::uint32_t luxel = 0; luxel < 32; ++luxel)
            for (std::uint32_t t = first_[owner]; t < first_[owner] + count_[owner]; ++t)
                if (mir::hits_segment(rows_[t], apex, hits_[32 * pair + luxel].position))
                    lit &= ~(1u << luxel);
        return lit;
    }

    std::uint32_t facing(std::uint32_t pair) const { return facing_[pair]; }
    std::uint32_t count(std::uint32_t pair) const { return count_[pair]; }

 private:
    std::vector<std::uint32_t> decided(std::vector<mir::ListedPair> blocks,
                                       std::vector<mir::ListedPair> listed,
                                       std::vector<bool>& open) const {
        const mirtest::HitRun run(hits_);
        std::vector<mir::Vpl> vpls(1);
        vpls[0].position = apex;
        mir::QuantisedBvhView<Space::host> bvh;
        bvh.exact.triangles = rows_.data();
        bvh.links = links_.data();
        std::vector<std::uint32_t> words = facing_;
        std::vector<mir::OpenPair> left(pairs);
        const auto block_count = static_cast<std::uint32_t>(blocks.size());
        const auto list_count = static_cast<std::uint32_t>(listed.size());
        std::uint32_t counters[6] = {list_count, 0, 0, 0, block_count, 0};
        using Vpls = mir::VplSpan<Space::host>;
        const mir::ClusterLists<Space::host, Vpls> kernel{
            run.view(),
            records_.data(),
            mir::span_of(vpls),
            bvh,
            sigma,
            words.data(),
            {blocks.data(), block_count, counters + 4, counters + 5},
            {listed.data(), list_count, counters, counters + 1},
            pool_.data(),
            {left.data(), pairs, counters + 2, counters + 3}};
        typename mir::ClusterLists<Space::host, Vpls>::Workspace space;
        kernel(LaneGroup{}, 0, space);
        open.assign(pairs, false);
        for (std::uint32_t i = 0; i < counters[2]; ++i) open[left[i].cluster] = true;
        return words;
    }

    /// On a slope; some empty, some no number, and some that do not face the VPL.
    void add_luxels() {
        const Hit middle{0.5f * mirtest::point_in_cube(random_) - Vec3(0, 0, 0.4f),
                         glm::normalize(Vec3(0, 0, 1) + 0.4f * mirtest::point_in_cube(random_))};
        std::uint32_t facing = 0;
        for (std::uint32_t k = 0; k < 32; ++k) {
            Hit hit = mirtest::hit_beside(middle, 0.02f, random_);
            const bool is_empty = mirtest::chance(random_, 0.05f);
            const bool is_none = !is_empty && mirtest::chance(random_, 0.02f);
            if (is_empty) hit.normal = Vec3(0);
            if (is_none) hit.position.x = std::numeric_limits<float>::quiet_NaN();
            if (!is_empty && !is_none && mirtest::chance(random_, 0.9f)) facing |= 1u << k;
            hits_.push_back(hit);
        }
        facing_.push_back(facing | 1u);
        hits_[hits_.size() - 32] = middle;
    }

    void add_list(std::uint32_t pair) {
        static constexpr std::uint32_t lengths[] = {0,  1,  2,  7,  8,   31,  32,  33,
                                                    40, 64, 70, 96, 130, 224, 225, 240};
        const auto draw = [&](std::uint32_t n) {
            return static_cast<std::uint32_t>(random_.next() * static_cast<float>(n)) % n;
        };
        const bool is_last = pair % block_words == block_words - 1;
        const std::uint32_t count = std::max(lengths[draw(16)], is_last ? 1u : 0u);
        const Kind kind = static_cast<Kind>(draw(static_cast<std::uint32_t>(Kind::count)));
        first_.push_back(static_cast<std::uint32_t>(rows_.size()));
        count_.push_back(count);
        const std::uint32_t first_node = static_cast<std::uint32_t>(pool_.size());
        for (std::uint32_t left = count; left > 0;) {
            const std::uint32_t here = std::min(left, 8u);
            mir::NodeLinks links{0, static_cast<std::uint32_t>(rows_.size()), {here, here}};
            links.ends[0] = here * 0x01010101u;
            links.ends[1] = 0;
            pool_.push_back(mir::MetLeaves::of(static_cast<std::uint32_t>(links_.size()), 1u).bits);
            links_.push_back(links);
            for (std::uint32_t k = 0; k < here; ++k) add_triangle(pair, kind, draw(100));
            left -= here;
        }
        if (count == 0) {  // a node whose slots are empty
            pool_.push_back(mir::MetLeaves::of(static_cast<std::uint32_t>(links_.size()), 2u).bits);
            links_.push_back({0, 0, {0, 0}});
        }
        lists_.push_back(
            {{pair, 0}, first_node, static_cast<std::uint32_t>(pool_.size()) - first_node});
    }

    void add_triangle(std::uint32_t pair, Kind kind, std::uint32_t chosen) {
        const Vec3 middle = hits_[32 * pair].position;
        const float share = 0.3f + 0.6f * random_.next();
        const Vec3 at = apex + share * (middle - apex);
        float size = 0.01f;
        Vec3 beside(0);
        if (kind == Kind::aside) beside = Vec3(0.3f, 0, 0);
        if (kind == Kind::small || kind == Kind::aside) size = 0.003f;
        if (kind == Kind::wall) size = 0.02f;
        if (kind == Kind::one_covers && chosen < 3) size = 0.5f;
        if (kind == Kind::mixed) size = 0.003f * std::pow(20.0f, random_.next());
        const auto corner = [&] { return at + beside + size * mirtest::point_in_cube(random_); };
        rows_.push_back(mir::make_triangle_rows(corner(), corner(), corner()));
    }

    mir::Random random_;
    std::vector<Hit> hits_;
    std::vector<std::uint32_t> facing_;
    std::vector<mir::TriangleRows> rows_;
    std::vector<mir::NodeLinks> links_;
    std::vector<std::uint32_t> pool_;
    std::vector<mir::ListedPair> lists_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> count_;
    std::vector<mir::ClusterRecord> records_;
};

}  // namespace

TEST_CASE("Lists of every length and kind are decided as their triangles are by themselves") {
    std::size_t dark = 0, untouched = 0, part = 0, left_open = 0, wrong = 0;
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const Lists lists(100 + seed);
        std::vector<bool> open;
        const std::vector<std::uint32_t> words = lists.decided(open);
        for (std::uint32_t k = 0; k < pairs; ++k) {
            const bool is_long = lists.count(k) > mir::ListBatch::most_triangles;
            const std::uint32_t truth = is_long ? lists.facing(k) : lists.truth(k, k);
            wrong += words[k] != truth || open[k] != is_long ? 1 : 0;
            left_open += is_long ? 1 : 0;
            dark += !is_long && truth == 0 ? 1 : 0;
            untouched += !is_long && truth == lists.facing(k) ? 1 : 0;
            part += !is_long && truth != 0 && truth != lists.facing(k) ? 1 : 0;
        }
    }
    INFO(dark << " dark, " << untouched << " untouched, " << part << " in part");
    CHECK(wrong == 0);
    CHECK(dark > 300);
    CHECK(untouched > 300);
    CHECK(part > 300);
    CHECK(left_open > 100);
}

TEST_CASE("The clusters of a block are decided by the list of their block") {
    std::size_t dark = 0, part = 0, wrong = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        Lists lists(300 + seed);
        std::vector<bool> open;
        const std::vector<std::uint32_t> words = lists.decided_by_blocks(open);
        for (std::uint32_t k = 0; k < pairs; ++k) {
            const std::uint32_t truth = lists.truth(k, lists.owner(k));
            wrong += words[k] != truth || open[k] ? 1 : 0;
            dark += truth == 0 ? 1 : 0;
            part += truth != 0 && truth != lists.facing(k) ? 1 : 0;
        }
    }
    INFO(dark << " dark, " << part << " in part");
    CHECK(wrong == 0);
    CHECK(dark > 50);
    CHECK(part > 50);
}
