// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/instruction_set.hpp"

#include <vector>

namespace mirtest {

/// Instruction sets of this processor, the plainest first.
inline std::vector<mir::InstructionSet> instruction_sets() {
    using mir::InstructionSet;
    std::vector<InstructionSet> sets;
    for (auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
        if (set <= mir::best_instruction_set()) sets.push_back(set);
    return sets;
}

}  // namespace mirtest
