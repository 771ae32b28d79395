// SPDX-License-Identifier: MIT
#include "mir/cuda/check.hpp"

#include "mir/cuda/backend.hpp"
#include "support/catch.hpp"

#include <utility>

// What needs no GPU; CTest hides all of them from this program.

namespace {

using mir::ErrorCode;

/// The error that `work` ends with.
template <class Work>
mir::Error error_of(const Work& work) {
    try {
        work();
    } catch (const mir::Error& e) {
        return e;
    }
    return {ErrorCode::internal, "nothing was thrown"};
}

bool says(const mir::Error& e, const char* words) {
    return std::string(e.what()).find(words) != std::string::npos;
}

static_assert(std::is_nothrow_move_constructible_v<mir::cuda::Queue>);
static_assert(std::is_nothrow_move_constructible_v<mir::cuda::Event>);
static_assert(std::is_nothrow_move_assignable_v<mir::cuda::Buffer<int>>);
static_assert(!std::is_copy_constructible_v<mir::cuda::Buffer<int>>);
static_assert(!std::is_copy_constructible_v<mir::cuda::Queue>);

}  // namespace

TEST_CASE("CUDA's failures become errors of the right kind, in words") {
    const std::pair<cudaError_t, ErrorCode> wanted[] = {
        {cudaErrorMemoryAllocation, ErrorCode::out_of_memory},
        {cudaErrorNoDevice, ErrorCode::no_device},
        {cudaErrorInsufficientDriver, ErrorCode::no_device},
        {cudaErrorNoKernelImageForDevice, ErrorCode::no_device},
        {cudaErrorIllegalAddress, ErrorCode::device},
        {cudaErrorLaunchFailure, ErrorCode::device},
        {cudaErrorInvalidValue, ErrorCode::device}};
    for (const auto& [status, code] : wanted) {
        const mir::Error e = error_of([s = status] { mir::cuda::check(s, "a test"); });
        CAPTURE(e.what());
        CHECK(e.code() == code);
        CHECK(says(e, "a test failed (CUDA says "));
        CHECK(says(e, cudaGetErrorName(status)));
        CHECK(says(e, "); "));
    }
    CHECK_NOTHROW(mir::cuda::check(cudaSuccess, "a test"));
}

TEST_CASE("Failures that end all work of the process say so and name the remedy") {
    for (cudaError_t status : {cudaErrorIllegalAddress, cudaErrorAssert, cudaErrorLaunchTimeout}) {
        CHECK(mir::cuda::ends_all_work(status));
        const std::string sentence = mir::cuda::failure_sentence(status, "a test");
        CHECK(sentence.find("start the program again") != std::string::npos);
    }
    for (cudaError_t status : {cudaErrorMemoryAllocation, cudaErrorInvalidValue, cudaErrorNoDevice})
        CHECK_FALSE(mir::cuda::ends_all_work(status));
}

TEST_CASE("Without a GPU everything that needs one is an error that says why") {
    const auto is_told = [](const mir::Error& e) {
        CAPTURE(e.what());
        CHECK(e.code() == ErrorCode::no_device);
        CHECK(says(e, "the CPU backend"));
    };
    is_told(error_of([] { static_cast<void>(mir::cuda::devices()); }));
    is_told(error_of([] { static_cast<void>(mir::cuda::select_device(0)); }));
    is_told(error_of([] { const mir::cuda::Backend backend(mir::cuda::Device{}); }));
    is_told(error_of([] { const mir::cuda::Queue queue(0); }));
}

TEST_CASE("Devices older than 7.5 are not supported") {
    mir::cuda::Device device;
    device.major = 7;
    device.minor = 0;
    CHECK_FALSE(mir::cuda::is_supported(device));
    CHECK(mir::cuda::capability_text(device) == "7.0");
    device.minor = 5;
    CHECK(mir::cuda::is_supported(device));
    device.major = 10;
    device.minor = 0;
    CHECK(mir::cuda::is_supported(device));
    CHECK(mir::cuda::version_text(13000) == "13.0");
    CHECK(mir::cuda::version_text(12060) == "12.6");
}

TEST_CASE("An allocation hook sees what is asked for and refuses it in words") {
    std::size_t asked = 0;
    const auto memory =
        std::make_shared<mir::cuda::Memory>(0, [&](mir::cuda::MemoryKind kind, std::size_t bytes) {
            asked = kind == mir::cuda::MemoryKind::pinned ? bytes : 0;
            return false;
        });
    const mir::Error e = error_of([&] { const mir::cuda::PinnedBuffer<float> buffer(memory, 25); });
    CHECK(asked == 100);
    CHECK(e.code() == ErrorCode::out_of_memory);
    CHECK(says(e, "100 bytes of pinned host memory could not be taken"));
    CHECK(memory->in_use(mir::cuda::MemoryKind::pinned) == 0);
}

TEST_CASE("Buffers of nothing need no memory") {
    const auto memory = std::make_shared<mir::cuda::Memory>(
        0, [](mir::cuda::MemoryKind, std::size_t) { return false; });
    mir::cuda::Buffer<float> buffer(memory, 0);
    mir::cuda::PinnedBuffer<float> pinned(memory, 0);
    CHECK(buffer.data() == nullptr);
    CHECK(buffer.size() == 0);
    CHECK(pinned.span().empty());
}
