// SPDX-License-Identifier: MIT
#include "machine.hpp"

namespace mirpaper {

std::vector<Run> run_embree(PaperScene&, mir::Extent, std::uint32_t, unsigned, Executor&) {
    return {};
}

}  // namespace mirpaper
