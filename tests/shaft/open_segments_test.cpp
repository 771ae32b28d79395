// SPDX-License-Identifier: MIT
#include "mir/shaft/device/open_segments.hpp"

#include "shaft/searched_stage.hpp"
#include "support/catch.hpp"

#include <utility>

// Single segments of queued pairs by themselves: which are asked, and which words are written.

namespace {

using mir::Vec3;
using mirtest::SearchedStage;

/// Asks every triangle, and keeps the segments.
struct NotedSight {
    static constexpr mir::Space space = mir::Space::host;

    const mir::WideBvh* bvh = nullptr;
    std::vector<std::pair<Vec3, Vec3>>* asked = nullptr;

    [[nodiscard]] bool visible(Vec3 from, Vec3 to) const {
        asked->emplace_back(from, to);
        return std::none_of(bvh->triangles().begin(), bvh->triangles().end(),
                            [&](const auto& rows) { return mir::hits_segment(rows, from, to); });
    }
};

/// Words of which a third of the facing luxels was found hidden before, and queued pairs.
class OpenPairs {
 public:
    explicit OpenPairs(const SearchedStage& stage) : stage_(stage), before_(stage.facing()) {
        mir::Random random = mirtest::test_random(33);
        for (std::uint32_t& word : before_)
            for (std::uint32_t k = 0; k < 32; ++k)
                if (mirtest::chance(random, 0.33f)) word &= ~(1u << k);
        for (std::uint32_t c = 0; c < stage.stage().clusters().size(); ++c)
            for (std::uint32_t j = 0; j < stage.vpls().size(); ++j)
                if (mirtest::chance(random, 0.4f)) queued_.push_back({c, j});
        std::reverse(queued_.begin(), queued_.end());
    }

    /// Words once the first `count` of the queued pairs are decided.
    [[nodiscard]] std::vector<std::uint32_t> decided(std::size_t count, std::uint32_t groups) {
        std::vector<std::uint32_t> words = before_;
        mirtest::Queued<mir::OpenPair> open(
            {queued_.begin(), queued_.begin() + static_cast<std::ptrdiff_t>(count)});
        asked.clear();
        const mir::OpenSegments kernel{stage_.stage().hits(), stage_.vpls(),
                                       NotedSight{&stage_.stage().bvh(), &asked}, words.data(),
                                       open.view()};
        typename decltype(kernel)::Workspace nothing;
        for (std::uint32_t i = 0; i < groups; ++i) kernel(mir::LaneGroup{}, i, nothing);
        return words;
    }

    /// What words should be then.
    [[nodiscard]] std::vector<std::uint32_t> truth(std::size_t count) const {
        const std::vector<std::uint32_t> sight = stage_.stage().by_brute_force();
        std::vector<std::uint32_t> words = before_;
        for (std::size_t i = 0; i < count; ++i)
            words[stage_.place(queued_[i])] &= sight[stage_.place(queued_[i])];
        return words;
    }

    /// Segments that have to be asked: VPLs and luxels, in the order of the queue.
    [[nodiscard]] std::vector<std::pair<Vec3, Vec3>> segments(std::size_t count) const {
        std::vector<std::pair<Vec3, Vec3>> all;
        for (std::size_t i = 0; i < count; ++i)
            for (std::uint32_t k = 0; k < 32; ++k)
                if ((before_[stage_.place(queued_[i])] >> k & 1u) != 0)
                    all.emplace_back(
                        stage_.vpls()[queued_[i].vpl].position,
                        stage_.stage().lit().luxels[32 * queued_[i].cluster + k].position);
        return all;
    }

    [[nodiscard]] std::size_t queued() const { return queued_.size(); }

    std::vector<std::pair<Vec3, Vec3>> asked;

 private:
    const SearchedStage& stage_;
    std::vector<std::uint32_t> before_;
    std::vector<mir::OpenPair> queued_;
};

}  // namespace

TEST_CASE("Single segments decide the bits of queued pairs, each asked once, and no other") {
    const bool room = GENERATE(true, false);
    const mirtest::World world = room ? mirtest::sphere_in_box() : mirtest::soup(false);
    const mirtest::ShaftStage drawn = mirtest::stage_of(world, 2000, 30);
    const SearchedStage stage(drawn);
    OpenPairs pairs(stage);
    REQUIRE(pairs.queued() > 500);
    const std::uint32_t groups = GENERATE(1u, 3u);
    for (const std::size_t count : {pairs.queued(), std::size_t{0}, std::size_t{1}}) {
        CAPTURE(count, groups);
        const std::vector<std::uint32_t> truth = pairs.truth(count);
        CHECK(mirtest::different_bits(pairs.decided(count, groups), truth) == 0);
        CHECK((pairs.asked == pairs.segments(count)));
    }
    CHECK(mirtest::different_bits(pairs.truth(pairs.queued()), pairs.truth(0)) > 100);
}

TEST_CASE("Of a queue that was to have more than fits the pairs that fit are decided") {
    const mirtest::World world = mirtest::soup(false);
    const mirtest::ShaftStage drawn = mirtest::stage_of(world, 256, 3);
    std::vector<std::uint32_t> words(drawn.clusters().size() * 3, ~0u);
    std::vector<mir::OpenPair> items;
    for (std::uint32_t c = 0; c < 5; ++c) items.push_back({c, 1});
    std::uint32_t counters[2] = {5, 0};
    std::vector<std::pair<Vec3, Vec3>> asked;
    const mir::OpenSegments kernel{
        drawn.hits(), mir::span_of(drawn.lit().vpls), NotedSight{&drawn.bvh(), &asked},
        words.data(), mir::WorkQueue<mir::OpenPair>{items.data(), 3, counters, counters + 1}};
    typename decltype(kernel)::Workspace nothing;
    kernel(mir::LaneGroup{}, 0, nothing);
    CHECK(asked.size() == 3 * mir::cluster_luxels);
    CHECK(words[3 * 3 + 1] == ~0u);
}
