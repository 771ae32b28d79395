// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/scene/scene.hpp"

#include <mpi.h>

#include <optional>

namespace mir::mpi {

/// Renders one picture by all ranks of a communicator. All call it with the same scene and
/// settings; threads, devices and tiles may differ. Rank 0 gets the picture, with the bytes of
/// render(), all others nothing. MPI must allow threads (MPI_THREAD_FUNNELED or more), the calling
/// one must be that which may call MPI. `monitor` may be null. For several pictures of one scene
/// use a PictureTeam over RankPeers.
/// @throws Error as render(), on all ranks when one of them fails; as RankPeers.
[[nodiscard]] std::optional<RenderResult> render_on_ranks(MPI_Comm ranks, const Scene& scene,
                                                          const RenderSettings& settings,
                                                          Monitor* monitor = nullptr);

}  // namespace mir::mpi
