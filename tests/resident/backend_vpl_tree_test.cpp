// SPDX-License-Identifier: MIT
#include "mir/resident/backend_vpl_tree.hpp"

#include "mir/core/random.hpp"
#include "mir/cuts/vpl_tree.hpp"
#include "mir/host/backend.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

#include <cstring>
#include <limits>
#include <vector>

namespace {

/// VPLs on the walls of a room, so that many share a coordinate, some of them black.
std::vector<mir::Vpl> vpls_on_walls(std::uint32_t count) {
    mir::Random random(11, mir::Stream::test, 4);
    std::vector<mir::Vpl> vpls(count);
    for (mir::Vpl& v : vpls) {
        v.position = {random.next() - 0.5f, random.next(), 2.0f * random.next()};
        const auto wall = static_cast<int>(6.0f * random.next());
        v.position[wall % 3] = wall < 3 ? 0.0f : -0.0f;
        v.normal = mir::Vec3(wall < 3 ? -0.0f : 0.0f);
        v.normal[wall % 3] = wall < 3 ? 1.0f : -1.0f;
        const float shine = random.next();
        if (shine > 0.1f) v.intensity = {shine, shine * random.next(), 1e-3f};
    }
    return vpls;
}

void check_same(const mir::VplTreeView<mir::Space::host>& there, const mir::VplTree& here,
                const mir::VplNode& node) {
    REQUIRE(there.weight(node) == here.weight(node));
    if (node.is_leaf()) return;
    const mir::VplBounds& a = there.bounds(node);
    const mir::VplBounds& b = here.bounds(node);
    REQUIRE(a.low == b.low);
    REQUIRE(a.high == b.high);
    REQUIRE(a.most == b.most);
    check_same(there, here, node.left());
    check_same(there, here, node.right());
}

template <class Backend>
void check_same(const Backend& backend, const std::vector<mir::Vpl>& vpls) {
    mir::InlineExecutor executor;
    const mir::VplTree here(mir::span_of(vpls), executor);
    auto queue = backend.queue();
    const mir::BackendVplTree<Backend> made(backend, queue, mir::span_of(vpls));
    const auto there = made.view();
    REQUIRE(there.count == here.size());
    if (here.size() == 0) return;
    CHECK(std::memcmp(there.leaves, here.leaves().first, here.size() * sizeof(mir::Vpl)) == 0);
    check_same(there, here, here.root());
}

}  // namespace

TEST_CASE("A tree of VPLs that a backend makes is the host's") {
    mir::InlineExecutor executor;
    for (const std::uint32_t count : {0u, 1u, 2u, 3u, 4u, 5u, 9u, 100u, 1023u, 20'000u}) {
        CAPTURE(count);
        const auto vpls = vpls_on_walls(count);
        check_same(mir::host::Backend<mir::InlineExecutor>(executor), vpls);
        mirtest::PutOff work(0);
        check_same(mirtest::LazyBackend(work), vpls);
    }
    std::vector<mir::Vpl> same(777, vpls_on_walls(9).back());
    for (mir::Vpl& v : same) v.intensity = {1.0f, 2.0f, 3.0f};
    same[5].intensity = {7.0f, 0.0f, 0.0f};
    check_same(mir::host::Backend<mir::InlineExecutor>(executor), same);
}

TEST_CASE("A level of a tree names its nodes by the turns from the root") {
    for (const std::uint32_t leaves : {1u, 2u, 3u, 7u, 64u, 100u}) {
        for (mir::TreeLevel level{leaves, 0};; ++level.depth) {
            std::uint32_t next = 0;
            std::uint32_t largest = 0;
            for (std::uint32_t number = 0; number < level.size(); ++number) {
                const mir::VplNode node = level.node(number);
                if (node.count == 0) continue;
                CHECK(node.first == next);
                largest = std::max(largest, node.count);
                for (; next < node.first + node.count; ++next)
                    CHECK(level.number_at(next) == number);
            }
            CHECK(next == leaves);
            CHECK(largest == level.largest());
            if (largest == 1) break;
        }
    }
}

TEST_CASE("A backend refuses VPLs of which no tree can be made") {
    mir::InlineExecutor executor;
    const mir::host::Backend<mir::InlineExecutor> backend(executor);
    auto queue = backend.queue();
    auto vpls = vpls_on_walls(5);
    vpls[3].position.y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS((mir::BackendVplTree<mir::host::Backend<mir::InlineExecutor>>(
                        backend, queue, mir::span_of(vpls))),
                    mir::Error);
}

TEST_CASE("A backend finds the VPLs that shine as the host does") {
    mir::InlineExecutor executor;
    const mir::host::Backend<mir::InlineExecutor> backend(executor);
    auto queue = backend.queue();
    for (const std::uint32_t count : {1u, 31u, 2047u, 2048u, 2049u, 4100u}) {
        CAPTURE(count);
        auto vpls = vpls_on_walls(count);
        vpls.front().intensity = {0.0f, 0.0f, 0.0f};
        const mir::ShiningVpls here(mir::span_of(vpls));
        const mir::BackendShiningVpls there(backend, queue, mir::span_of(vpls));
        REQUIRE(there.span().size() == here.order.size());
        if (here.order.empty()) continue;
        CHECK(there.most() == here.most);
        CHECK(there.normal_scale() == here.normal_scale);
        std::vector<mir::Vpl> kept;
        for (const mir::VplIndex j : here.order) kept.push_back(vpls[j]);
        CHECK(std::memcmp(there.span().first, kept.data(), kept.size() * sizeof(mir::Vpl)) == 0);
    }
}
