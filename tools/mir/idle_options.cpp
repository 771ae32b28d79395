// SPDX-License-Identifier: MIT
#include "idle_options.hpp"

#include <string>

namespace mirtool {

void note_idle_options(const mir::RenderSettings& s, mir::RenderResult& result) {
    if (!result.statistics.health || result.statistics.health->mutations > 0) return;
    const mir::MetropolisTuning& m = s.metropolis;
    const mir::MetropolisTuning usual;
    std::string idle;
    const auto add = [&idle](bool is_given, const char* option) {
        if (is_given) idle += (idle.empty() ? "" : ", ") + std::string(option);
    };
    add(m.stride != usual.stride, "--stride");
    add(m.chain.tries != usual.chain.tries, "--tries");
    add(m.chain.large_step_probability != usual.chain.large_step_probability, "--large-steps");
    add(m.chain.mutation != usual.chain.mutation, "--mutation");
    if (!idle.empty())
        result.warnings.push_back("no chain mutated (there are as many chains as VPLs), so " +
                                  idle + " had no effect; fewer --chains than --vpls mutate");
}

}  // namespace mirtool
