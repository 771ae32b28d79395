// SPDX-License-Identifier: MIT
#include "mir/resident/backend_metropolis.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/chain_scene.hpp"
#include "support/same_records.hpp"
#include "support/watched_backend.hpp"
#include "support/wedge.hpp"

#include <optional>

// How much of the chains a backend does at a time: the result does not show it, and between any two
// portions the run may end without leaving anything behind.

namespace {

using mir::BackendMetropolis;
using mir::ChainPortions;
using mir::ChainStop;
using mir::MetropolisOptions;
using mir::Mutation;
using mir::VplRecords;
using mirtest::few_chains;
using mirtest::PutOff;
using mirtest::same_health;
using mirtest::same_records;
using mirtest::Watch;
using mirtest::WatchedBackend;
using mirtest::Wedge;
using mirtest::WedgeLights;

using Stage = mirtest::ChainScene<mir::Lambert>;

Stage wedge() { return Stage(Wedge(WedgeLights::two_sided).scene()); }

bool same(const VplRecords& a, const VplRecords& b) {
    return same_records(a, b) && same_health(*a.health, *b.health);
}

/// The host's world is in the memory of any backend that is the host.
VplRecords watched(const Stage& stage, PutOff& work, Watch& watch, const MetropolisOptions& options,
                   const ChainPortions& portions = {}) {
    const WatchedBackend backend(work, watch);
    auto queue = backend.queue();
    return BackendMetropolis(backend, stage.world(), options, {}, portions).sample(queue);
}

/// How a run ends that should not end well.
template <class Run>
std::optional<mir::ErrorCode> error_of(const Run& run) {
    try {
        static_cast<void>(run());
    } catch (const mir::Error& e) {
        return e.code();
    }
    return std::nullopt;
}

/// Chains that several kernels run.
ChainPortions small_portions() { return {.bytes = 200'000, .mutations = 10}; }

/// Cancels in the `last`-th loop.
class CancellingExecutor {
 public:
    CancellingExecutor(mir::Monitor& monitor, int last) : monitor_(monitor), left_(last) {}

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        if (--left_ == 0) monitor_.cancelled = true;
        for (std::size_t i = 0; i < n; ++i) body(i);
    }
    [[nodiscard]] std::size_t concurrency() const { return 1; }
    [[nodiscard]] int loops_left() const { return left_; }

 private:
    mir::Monitor& monitor_;
    int left_;
};

int loops_of(const Stage& stage, const MetropolisOptions& options) {
    mir::Monitor never;
    CancellingExecutor executor(never, 0);
    const mir::host::Backend backend(executor);
    auto queue = backend.queue();
    static_cast<void>(
        BackendMetropolis(backend, stage.world(), options, {}, small_portions()).sample(queue));
    return -executor.loops_left();
}

}  // namespace

TEST_CASE("Chains make the same records in slices of any length") {
    const Stage stage = wedge();
    MetropolisOptions options = few_chains(GENERATE(Mutation::primary, Mutation::bidirectional));
    SECTION("chains of equal length") {}
    SECTION("chains of unequal length") { options.states = 53; }
    SECTION("states of one record and of several") { options.emitter_vpls = true; }
    SECTION("no mutation between two states") { options.states = options.chains; }
    SECTION("the paper's stopping rule") {
        options.states = 12;
        options.stop = ChainStop::paper;
    }
    const VplRecords wanted = stage.sampled_on_host(options);
    REQUIRE(!wanted.records.empty());
    // A stride is 8 mutations.
    for (const std::uint32_t mutations : {1, 7, 8, 9, 21, 1000}) {
        CAPTURE(mutations);
        PutOff work(0);
        Watch watch;
        CHECK(same(watched(stage, work, watch, options, {.mutations = mutations}), wanted));
    }
}

TEST_CASE("Slices cut a trace that keeps every second state anywhere") {
    const Stage stage = wedge();
    MetropolisOptions options = few_chains(Mutation::primary);
    options.chains = 2;
    options.states = 129;
    options.stride = 64;
    const VplRecords wanted = stage.sampled_on_host(options);
    for (const std::uint32_t mutations : {777, 4096}) {
        PutOff work(0);
        Watch watch;
        CHECK(same(watched(stage, work, watch, options, {.mutations = mutations}), wanted));
    }
}

TEST_CASE("Chains that stop when they found enough copy little more than they bring") {
    const Stage stage = wedge();
    MetropolisOptions options = few_chains(Mutation::primary);
    options.stop = ChainStop::paper;
    options.states = 1200;
    options.stride = 1;
    PutOff work(1);
    Watch watch;
    const VplRecords found = watched(stage, work, watch, options, {.mutations = 64});
    REQUIRE(same(found, stage.sampled_on_host(options)));
    const std::size_t brought = found.records.size() * sizeof(mir::VplRecord);
    const std::size_t most = mir::paper_stop_cap * options.states * (1 + options.suffix_refresh) *
                             sizeof(mir::VplRecord);
    CHECK(watch.bytes_taken < most / 4);
    CHECK(watch.bytes_downloaded < 3 * brought);
}

TEST_CASE("More chains than thread blocks are worth make the sampler's records") {
    const Stage stage = wedge();
    MetropolisOptions options = few_chains(Mutation::primary);
    options.states = options.chains = 8200;
    options.suffix_refresh = 0;
    mir::InlineExecutor one;
    const VplRecords found = chains_on(mir::host::Backend(one), stage.parts(), options);
    CHECK(same(found, stage.sampled_on_host(options)));
}

TEST_CASE("A run is cancelled between any two kernels, and leaves nothing behind") {
    const Stage stage = wedge();
    const MetropolisOptions options = few_chains(Mutation::primary);
    const int loops = loops_of(stage, options);
    CHECK(loops > 6);
    for (int last = 1; last < loops; ++last) {
        CAPTURE(last);
        mir::Monitor monitor;
        CancellingExecutor executor(monitor, last);
        const mir::host::Backend backend(executor);
        auto queue = backend.queue();
        const BackendMetropolis chains(backend, stage.world(), options, {}, small_portions());
        CHECK(error_of([&] { return chains.sample(queue, &monitor); }) ==
              mir::ErrorCode::cancelled);
        CHECK(executor.loops_left() == 0);
        CHECK(same(chains.sample(queue), stage.sampled_on_host(options)));
    }
}

TEST_CASE("Anything may fail under chains: an error, nothing leaks, the next run is right") {
    const Stage stage = wedge();
    const MetropolisOptions options = few_chains(Mutation::bidirectional);
    const VplRecords wanted = stage.sampled_on_host(options);
    PutOff work(0);
    Watch usual;
    static_cast<void>(watched(stage, work, usual, options, small_portions()));
    CHECK(usual.allocations > 5);
    CHECK(usual.operations > 20);
    const auto fails = [&](Watch watch, mir::ErrorCode code) {
        CHECK(error_of([&] { return watched(stage, work, watch, options, small_portions()); }) ==
              code);
        CHECK(watch.buffers == 0);
        CHECK(watch.ended_too_soon == 0);
        CHECK(same(watched(stage, work, watch, options, small_portions()), wanted));
    };
    for (std::size_t i = 0; i < usual.allocations; ++i) {
        CAPTURE(i);
        fails({.failing_allocation = i}, mir::ErrorCode::out_of_memory);
    }
    for (std::size_t i = 0; i < usual.operations; ++i) {
        CAPTURE(i);
        fails({.failing_operation = i}, mir::ErrorCode::device);
    }
}

TEST_CASE("Kernels without a mutation are refused") {
    const Stage stage = wedge();
    mir::InlineExecutor one;
    const mir::host::Backend backend(one);
    CHECK_THROWS_AS(BackendMetropolis(backend, stage.world(), few_chains(Mutation::primary), {},
                                      ChainPortions{.mutations = 0}),
                    mir::Error);
}
