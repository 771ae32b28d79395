// SPDX-License-Identifier: MIT
#include "mir/resident/backend_cuts.hpp"

#include "mir/host/backend.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"
#include "support/cuts_stage.hpp"
#include "support/lazy_backend.hpp"
#include "support/same_images.hpp"

// The kernels of a backend, which the host runs, against reconstruct_cuts(): the same bits.

namespace {

using mirtest::CutsStage;
using Host = mir::host::Backend<mirtest::BackwardsExecutor>;

template <class B>
void check_same(CutsStage<B>& stage, std::uint32_t picks, const mir::CutPlace& place) {
    mirtest::BackwardsExecutor threads{3};
    const auto here = stage.on_host(picks, place);
    double light = 0.0;
    for (const mir::Rgb& c : here.pixels()) light += static_cast<double>(luminance(c));
    CHECK(light > 0.0);
    CHECK(mirtest::same_bits(
        cuts_on(Host(threads), stage.asked(picks, place), stage.engine.visibility()), here));
}

}  // namespace

TEMPLATE_TEST_CASE("A backend gathers cuts with the bits of the host's loops", "", mir::Lambert,
                   mir::CookTorrance) {
    for (const char* name : {"cornell-box", "sphere-indirect", "door-ajar"}) {
        INFO(name);
        CutsStage<TestType> stage(name, {53, 40}, {32, 16}, 1000, 4.0f);
        for (const std::uint32_t picks : {1u, 7u, 32u, 128u}) {
            INFO(picks);
            check_same(stage, picks, {picks});
        }
    }
}

TEST_CASE("A backend gathers every VPL where as many picks are wanted, in the host's order") {
    CutsStage<mir::CookTorrance> few("cornell-box", {40, 33}, {48, 48}, 130, 4.0f);
    check_same(few, 65536, {2});
    CutsStage<mir::Lambert> one("cornell-box", {20, 16}, {16, 16}, 1, 4.0f);
    check_same(one, 128, {3});
}

TEST_CASE("No tile, portion, band or late work changes a bit of a backend's cuts") {
    CutsStage<mir::Lambert> stage("cornell-box", {60, 50}, {16, 48}, 500, 2.0f);
    const mir::CutPlace place{5, 32};
    const auto wanted = stage.on_host(20, place);
    CutsStage<mir::Lambert> other("cornell-box", {60, 50}, {64, 64}, 500, 2.0f);
    CHECK(mirtest::same_bits(other.on_host(20, place), wanted));
    check_same(other, 20, place);
    mirtest::PutOff work(0);
    const mirtest::LazyBackend late(work);
    CHECK(mirtest::same_bits(cuts_on(late, other.asked(20, place), other.engine.visibility()),
                             wanted));
    for (const std::uint64_t bytes : {std::uint64_t{1}, std::uint64_t{3000}})
        CHECK(mirtest::same_bits(
            cuts_on(late, other.asked(20, place), other.engine.visibility(), bytes), wanted));
}

TEST_CASE("Cuts of a backend count their picks, stop when asked and are black without VPLs") {
    mirtest::BackwardsExecutor threads{2};
    const Host host(threads);
    CutsStage<mir::Lambert> stage("cornell-box", {60, 50}, {64, 64}, 100, 2.0f);
    mir::Monitor here;
    mir::Monitor there;
    static_cast<void>(stage.on_host(10, {1}, &here));
    static_cast<void>(cuts_on(host, stage.asked(10, {1}, &there), stage.engine.visibility(), 1000));
    CHECK(there.contributions == here.contributions);
    CHECK(there.contributions > 0);
    there.cancelled = true;
    CHECK_THROWS_AS(cuts_on(host, stage.asked(10, {1}, &there), stage.engine.visibility()),
                    mir::Error);
    const CutsStage<mir::Lambert> none("cornell-box", {20, 20}, {32, 32}, 0, 2.0f);
    const auto black = cuts_on(host, none.asked(10, {1}), none.engine.visibility());
    for (const mir::Rgb& c : black.pixels()) CHECK(is_black(c));
}
