// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

namespace mir {
class PictureTeam;
}  // namespace mir

namespace mirtool {

// Each runs one command and returns the exit code. They throw mir::Error, which main() reports.
int run(const RenderOptions& options);
int run(const MergeOptions& options);
int run(const InfoOptions& options);
int run(const ExportOptions& options);
int run(const CompareOptions& options);
int run(const DenoiseOptions& options);
int run(const DevicesOptions& options);
int run(const ManualOptions& options);

/// Renders together with the other processes of a team. The lead's code is that of run().
int run_in_team(const RenderOptions& options, mir::PictureTeam& team);

}  // namespace mirtool
