// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/passes.hpp"
#include "mir/validation/executor.hpp"

namespace mirtest {

/// The axioms of Executor.
template <mir::Executor E>
void executor_suite(E& executor) {
    passes(mir::validation::check_executor(executor));
}

}  // namespace mirtest
