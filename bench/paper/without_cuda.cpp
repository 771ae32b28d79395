// SPDX-License-Identifier: MIT
#include "machine.hpp"

namespace mirpaper {

std::unique_ptr<Machine> make_cuda_machine(Executor&) { return nullptr; }

}  // namespace mirpaper
