// SPDX-License-Identifier: MIT
#include "pass_goal_of.hpp"

#include "mir/core/error.hpp"

namespace mirtool {

mir::PassGoal goal_of(const PassOptions& o) {
    const bool open = o.seconds || o.relative_error;
    mir::PassGoal goal;
    goal.passes = o.passes.value_or(open ? mir::max_passes : 1);
    if (o.seconds) goal.seconds = *o.seconds;
    if (o.relative_error) goal.relative_error = *o.relative_error;
    return goal;
}

void check(const PassOptions& options) {
    const mir::PassGoal goal = goal_of(options);
    goal.validate();
    mir::expects(!options.save_every || goal.passes > 1,
                 "--save-every was given for a single pass (there is nothing to write before its "
                 "end); add --passes, --time or --target-error, or leave it out");
}

}  // namespace mirtool
