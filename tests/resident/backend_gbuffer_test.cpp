// SPDX-License-Identifier: MIT
#include "mir/resident/backend_gbuffer.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/gbuffer_suite.hpp"
#include "conformance/scheduler_suite.hpp"
#include "mir/host/backend.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/reconstruct_visibility_parallel.hpp"
#include "support/catch.hpp"

namespace {

using Backend = mir::host::Backend<mir::InlineExecutor>;
using Params = mir::CookTorrance::Params;
using There = mir::BackendGBuffer<Backend, Params>;
using Here = mir::BlockedGBuffer<Params>;
using Stage = mirtest::Stage<mir::CookTorrance, mirtest::BruteForceScene>;

static_assert(mir::PackedGBuffer<There>);

bool same_words(const Here& a, const Here& b) {
    return std::equal(a.words().begin(), a.words().end(), b.words().begin(), b.words().end());
}

}  // namespace

TEST_CASE("A G-buffer that went to a backend and back has the same words") {
    const Stage stage({70, 50}, {48, 32}, 1);
    mir::InlineExecutor executor;
    const Backend backend(executor);
    auto queue = backend.queue();
    There there(backend, {70, 50}, {48, 32});
    there.upload(queue, stage.gbuffer());
    Here back({70, 50}, {48, 32});
    CHECK_FALSE(same_words(back, stage.gbuffer()));
    there.download(queue, back);
    queue.record().sync();
    CHECK(same_words(back, stage.gbuffer()));
    CHECK(there.bytes() == back.bytes());
}

TEST_CASE("The luxels of a backend's G-buffer are those of the one that it was copied from") {
    mir::InlineExecutor executor;
    const Backend backend(executor);
    auto queue = backend.queue();
    Here here({70, 50}, {48, 20});
    mirtest::fill_all(here, [](Here& g, mir::TileIndex t, mir::LuxelIndex i, const mir::Hit& hit) {
        g.store(t, i, hit, {{0, 0, 1}, {1, 0, 0}, {static_cast<float>(i), 0, 0}, {}});
    });
    There there(backend, {70, 50}, {48, 20});
    there.upload(queue, here);
    for (mir::TileIndex t = 0; t < here.tiles().size(); ++t) {
        const auto view = there.view(t);
        REQUIRE(view.size() == here.view(t).size());
        for (mir::LuxelIndex i = 0; i < view.size(); ++i) {
            REQUIRE(view.hit(i).position == here.view(t).hit(i).position);
            REQUIRE(view.surface(i).emission == here.view(t).surface(i).emission);
        }
        CHECK(there.hit_words_of(t).data() == view.hits.planes);
        CHECK(there.surface_words_of(t).data() == view.surfaces.planes);
        CHECK(there.surface_words_of(t).size() == here.surface_words_of(t).size());
    }
}

TEST_CASE("Schedulers make the same image of luxels that lie in a backend's memory") {
    const Stage stage({70, 50}, {48, 32}, 9);
    const mir::VplShading<mir::CookTorrance> shading{2.0f};
    const auto wanted = mirtest::oracle(stage, shading);
    mir::InlineExecutor executor;
    const Backend backend(executor);
    auto queue = backend.queue();
    There there(backend, {70, 50}, {48, 32});
    there.upload(queue, stage.gbuffer());
    const auto check = [&](const auto& scheduler) {
        const auto image =
            mir::reconstruct(scheduler, there, stage.vpls(), stage.visibility(), shading);
        CHECK(mirtest::pixels_that_differ(image, wanted) == 0);
    };
    check(mir::sched::Cpu{executor});
    check(mir::sched::Reconstruct{backend});
    check(mir::sched::ReconstructVisibilityParallel{backend});
}

TEST_CASE("Copies between G-buffers of other tiles are refused") {
    mir::InlineExecutor executor;
    const Backend backend(executor);
    auto queue = backend.queue();
    There there(backend, {70, 50}, {48, 32});
    for (const mir::Extent tile : {mir::Extent{32, 48}, mir::Extent{48, 48}}) {
        Here other({70, 50}, tile);
        CHECK_THROWS_AS(there.upload(queue, other), mir::Error);
        CHECK_THROWS_AS(there.download(queue, other), mir::Error);
    }
    Here larger({70, 51}, {48, 32});
    CHECK_THROWS_AS(there.upload(queue, larger), mir::Error);
}

TEST_CASE("A backend's G-buffer that kernels cannot count is refused before memory is taken") {
    mir::InlineExecutor executor;
    const Backend backend(executor);
    CHECK_THROWS_AS(There(backend, {0, 5}, {16, 16}), mir::Error);
    try {
        const There there(backend, {65536, 65536}, {65536, 4096});
        FAIL("a G-buffer of 2^32 luxels was made");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::limit_exceeded);
    }
}
