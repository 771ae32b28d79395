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

}  // namespace

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
