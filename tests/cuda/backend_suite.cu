// SPDX-License-Identifier: MIT
#include "conformance/backend_suite.hpp"
#include "cuda/experiments.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/cuda/sort.cuh"

namespace mirtest {

std::vector<Finding> examine(const mir::cuda::Backend& backend) { return examine_backend(backend); }

namespace {

/// Writes where nothing is.
struct WriteAnywhere {
    std::uint32_t* nowhere = nullptr;
    MIR_HD void operator()(std::uint32_t i) const { nowhere[i] = i; }
};

struct Nothing {};

/// Numbers of which host and device compilers may think that they lie at different places.
struct EmptyTail {
    std::uint64_t words[2];
    [[no_unique_address]] Nothing nothing;
};
struct ReadBehind {
    EmptyTail tail;
    std::uint32_t value = 0;
    std::uint32_t* out = nullptr;
    MIR_HD void operator()(std::uint32_t) const { *out = value; }
};

}  // namespace

std::uint32_t read_behind_empty_member(const mir::cuda::Backend& backend, std::uint32_t value) {
    auto queue = backend.queue();
    auto there = backend.buffer<std::uint32_t>(1);
    auto home = backend.host_buffer<std::uint32_t>(1);
    queue.for_each(1, ReadBehind{{}, value, there.data()});
    queue.download(there, home.span());
    queue.record().sync();
    return home.span()[0];
}

void write_where_nothing_is(const mir::cuda::Backend& backend) {
    auto queue = backend.queue();
    auto there = backend.buffer<std::uint32_t>(1);
    // Far from every allocation, and an address that compilers cannot see through.
    queue.for_each(1, WriteAnywhere{there.data() + (std::size_t{1} << 40)});
    queue.record().sync();
}

double seconds_of_slow_kernel(const mir::cuda::Backend& backend, std::uint32_t steps) {
    auto out = backend.buffer<std::uint32_t>(256);
    auto queue = backend.queue();
    queue.for_each(256, SlowScramble{out.data(), 1});
    const auto begin = queue.record();
    queue.for_each(256, SlowScramble{out.data(), steps});
    return seconds_between(begin, queue.record());
}

}  // namespace mirtest
