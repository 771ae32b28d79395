// SPDX-License-Identifier: MIT
#include "mir/cuts/vpl_tree.hpp"

#include "mir/core/random.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using mir::Vec3;

std::vector<mir::Vpl> random_vpls(std::uint32_t count) {
    mir::Random random(7, mir::Stream::test, 61);
    std::vector<mir::Vpl> vpls(count);
    for (mir::Vpl& v : vpls) {
        v.position = {random.next(), random.next(), random.next()};
        v.normal = glm::normalize(Vec3{random.next(), random.next(), random.next()} - 0.5f);
        v.intensity = {random.next(), random.next() * random.next(), 1e-3f};
    }
    return vpls;
}

mir::VplTree tree_of(const std::vector<mir::Vpl>& vpls) {
    mir::InlineExecutor executor;
    return {mir::span_of(vpls), executor};
}

/// Calls `use` with every node below one.
template <class Use>
void each_node(const mir::VplNode& node, const Use& use) {
    use(node);
    if (node.is_leaf()) return;
    each_node(node.left(), use);
    each_node(node.right(), use);
}

}  // namespace

TEST_CASE("a tree of VPLs holds each VPL that shines once") {
    std::vector<mir::Vpl> vpls = random_vpls(999);
    for (std::size_t i = 0; i < vpls.size(); i += 10) vpls[i].intensity = {};
    const mir::VplTree tree = tree_of(vpls);
    CHECK(tree.size() == 899);
    std::vector<mir::VplIndex> order(tree.order().begin(), tree.order().end());
    for (std::uint32_t i = 0; i < tree.size(); ++i)
        CHECK(tree.leaves()[i].position == vpls[order[i]].position);
    std::sort(order.begin(), order.end());
    CHECK(std::adjacent_find(order.begin(), order.end()) == order.end());
    CHECK(std::none_of(order.begin(), order.end(), [](auto j) { return j % 10 == 0; }));
}

TEST_CASE("nodes have places of their own, halves and bounds of all their leaves") {
    const mir::VplTree tree = tree_of(random_vpls(301));
    std::vector<int> seen(2 * tree.size() - 1);
    each_node(tree.root(), [&](const mir::VplNode& node) {
        ++seen[node.place];
        const mir::VplBounds& bounds = tree.bounds(node);
        mir::VplBounds wanted;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const mir::Vpl& v = tree.leaves()[i];
            wanted = wanted.with({v.position, v.position, luminance(v.intensity)});
        }
        CHECK(bounds.low == wanted.low);
        CHECK(bounds.high == wanted.high);
        CHECK(bounds.most == wanted.most);
    });
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
}

TEST_CASE("a node picks each of its leaves with the share of its weight") {
    const mir::VplTree tree = tree_of(random_vpls(16));
    each_node(tree.root(), [&](const mir::VplNode& node) {
        const auto whole = static_cast<double>(tree.weight(node));
        double sum = 0.0;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const double from =
                static_cast<double>(tree.weight_before(i) - tree.weight_before(node.first)) / whole;
            const double to =
                static_cast<double>(tree.weight_before(i + 1) - tree.weight_before(node.first)) /
                whole;
            // The interval of numbers that pick leaf i, a little inside of its ends.
            CHECK(tree.pick(node, static_cast<std::uint64_t>((from + 1e-9) * 0x1p64)) == i);
            CHECK(tree.pick(node, static_cast<std::uint64_t>((to - 1e-9) * 0x1p64)) == i);
            const double share = 1.0 / static_cast<double>(tree.inverse_probability(node, i));
            CHECK(share == Approx(to - from).epsilon(1e-6));
            sum += share;
        }
        CHECK(sum == Approx(1.0).epsilon(1e-6));
    });
}

TEST_CASE("a tree of VPLs is the same for any number of threads, and for VPLs at one place") {
    std::vector<mir::Vpl> vpls = random_vpls(20000);
    for (std::size_t i = 0; i < 3000; ++i) vpls[i] = vpls[0];
    const mir::VplTree one = tree_of(vpls);
    for (const std::size_t threads : {2u, 5u}) {
        mirtest::BackwardsExecutor executor{threads};
        const mir::VplTree many(mir::span_of(vpls), executor);
        CHECK(std::ranges::equal(many.order(), one.order()));
    }
}

TEST_CASE("a tree of no VPLs, or of black ones, has no leaves") {
    CHECK(tree_of({}).size() == 0);
    CHECK(tree_of(std::vector<mir::Vpl>(5)).size() == 0);
}

TEST_CASE("VPLs that are not finite make no tree") {
    for (int field = 0; field < 3; ++field) {
        std::vector<mir::Vpl> vpls = random_vpls(5);
        const float bad = std::numeric_limits<float>::quiet_NaN();
        if (field == 0) vpls[3].position.y = bad;
        if (field == 1) vpls[3].normal.z = bad;
        if (field == 2) vpls[3].intensity.g = bad;
        CHECK_THROWS_AS(tree_of(vpls), mir::Error);
    }
}

TEST_CASE("the upper half of a product of 64 bits is that of long multiplication") {
    using mir::detail::high_product;
    constexpr std::uint64_t most = ~std::uint64_t{0};
    static_assert(high_product(most, most) == most - 1);
    static_assert(high_product(std::uint64_t{1} << 63, 2) == 1);
    static_assert(high_product(most, 1) == 0);
    mir::Random random(1, mir::Stream::test, 62);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const mir::Bits128 bits = random.block(i);
        const std::uint64_t a = std::uint64_t{bits.word[0]} << 32 | bits.word[1];
        const std::uint64_t b = std::uint64_t{bits.word[2]} << 32 | bits.word[3];
        // Both have halves whose products fit into a long double's 64 digits, rounded once.
        const long double product = static_cast<long double>(a) * static_cast<long double>(b);
        const auto expected = product * 0x1p-64L;
        CHECK(std::abs(static_cast<long double>(high_product(a, b)) - expected) <= 2.0L);
    }
}
