// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/backend_suite.hpp"
#include "mir/cuda/backend.hpp"

// What the tests start on the GPU: declared for files with assertions, defined in backend_suite.cu.

namespace mirtest {

/// The axioms of Backend, tried on a GPU.
std::vector<Finding> examine(const mir::cuda::Backend& backend);

/// A kernel that fails; throws what the backend makes of it. Ends the GPU for the whole process.
void write_where_nothing_is(const mir::cuda::Backend& backend);

/// What a kernel reads of its argument's last member, `value`, behind an empty one that is
/// [[no_unique_address]]. Throws what the backend makes of such a kernel.
std::uint32_t read_behind_empty_member(const mir::cuda::Backend& backend, std::uint32_t value);

/// Time of a kernel that takes the longer the more steps it has, by the GPU's clock.
double seconds_of_slow_kernel(const mir::cuda::Backend& backend, std::uint32_t steps);

}  // namespace mirtest
