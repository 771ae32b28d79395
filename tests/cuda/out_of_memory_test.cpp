// SPDX-License-Identifier: MIT
#include "conformance/scheduler_suite.hpp"
#include "cuda/reconstruct.hpp"
#include "support/catch.hpp"

// Every allocation of an image fails in turn.

namespace {

using mir::cuda::Backend;
using mir::cuda::MemoryKind;
using Stage = mirtest::Stage<mir::Lambert, mirtest::BruteForceRows>;
using Shading = mir::VplShading<mir::Lambert>;

mir::Image<mir::Rgb> image_of(const Backend& backend, mirtest::Algorithm a, const Stage& stage) {
    return mirtest::reconstruct_on(backend, a, stage.gbuffer(), stage.vpls(), stage.visibility(),
                                   Shading{});
}

/// True when making the image ends with Error(out_of_memory), in words.
bool runs_out_of_memory(const Backend& backend, mirtest::Algorithm a, const Stage& stage) {
    try {
        static_cast<void>(image_of(backend, a, stage));
    } catch (const mir::Error& e) {
        return e.code() == mir::ErrorCode::out_of_memory &&
               std::string(e.what()).find("use smaller tiles") != std::string::npos;
    }
    return false;
}

std::size_t count_allocations(mirtest::Algorithm a, const Stage& stage) {
    std::size_t count = 0;
    const auto counting = [&](MemoryKind, std::size_t) {
        ++count;
        return true;
    };
    static_cast<void>(image_of(Backend(mir::cuda::select_device(0), counting), a, stage));
    return count;
}

/// Lets each of the first `allocations` allocations fail, on a backend of its own.
void fail_each(std::size_t allocations, mirtest::Algorithm a, const Stage& stage) {
    const auto wanted = mirtest::oracle(stage, Shading{});
    for (std::size_t failing = 0; failing < allocations; ++failing) {
        CAPTURE(failing);
        std::size_t count = 0;
        const auto failing_once = [&](MemoryKind, std::size_t) { return count++ != failing; };
        const Backend backend(mir::cuda::select_device(0), failing_once);
        CHECK(runs_out_of_memory(backend, a, stage));
        CHECK(backend.memory().in_use(MemoryKind::device) == 0);
        CHECK(backend.memory().in_use(MemoryKind::pinned) == 0);
        CHECK(mirtest::pixels_that_differ(image_of(backend, a, stage), wanted) == 0);
    }
}

}  // namespace

TEST_CASE("Any allocation may fail: an error in words, nothing leaks, the next image is right") {
    const Stage stage({50, 40}, {16, 16}, 5);
    const auto algorithm =
        GENERATE(mirtest::Algorithm::os, mirtest::Algorithm::rc, mirtest::Algorithm::rcvp);
    const std::size_t allocations = count_allocations(algorithm, stage);
    CHECK(allocations > 8);
    fail_each(allocations, algorithm, stage);
    // From here on the driver itself has all that it needs.
    const std::uint64_t free_before = mir::cuda::free_memory(0);
    fail_each(allocations, algorithm, stage);
    CHECK(mir::cuda::free_memory(0) == free_before);
}

TEST_CASE("A hook bounds the memory that images take") {
    const auto device = mir::cuda::select_device(0);
    const Stage stage({50, 40}, {64, 64}, 5);
    constexpr std::size_t most = 16384;
    const Backend backend(device, [=](MemoryKind kind, std::size_t bytes) {
        return kind == MemoryKind::pinned || bytes <= most;
    });
    CHECK(runs_out_of_memory(backend, mirtest::Algorithm::rc, stage));
    const Stage smaller({50, 40}, {16, 16}, 5);
    CHECK(mirtest::pixels_that_differ(image_of(backend, mirtest::Algorithm::rc, smaller),
                                      mirtest::oracle(smaller, Shading{})) == 0);
}
