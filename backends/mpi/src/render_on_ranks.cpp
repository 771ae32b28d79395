// SPDX-License-Identifier: MIT
#include "mir/mpi/render_on_ranks.hpp"

#include "mir/mpi/rank_peers.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/picture_team.hpp"

namespace mir::mpi {
namespace {

/// The renderer that the settings ask for. The team knows when there is none.
Registry::Choice choice_of(const RenderSettings& settings, PictureTeam& team) {
    try {
        Registry registry;
        add_all_to(registry);
        return registry.make_for(settings);
    } catch (const Error& e) {
        team.fail(e);
        throw;
    }
}

}  // namespace

std::optional<RenderResult> render_on_ranks(MPI_Comm ranks, const Scene& scene,
                                            const RenderSettings& settings, Monitor* monitor) {
    RankPeers peers(ranks);
    PictureTeam team(peers);
    const Registry::Choice choice = choice_of(settings, team);
    if (!team.is_lead()) {
        team.work(*choice.renderer, scene, settings, monitor);
        return std::nullopt;
    }
    RenderResult result = team.render(*choice.renderer, scene, settings, monitor);
    result.warnings.insert(result.warnings.begin(), choice.remarks.begin(), choice.remarks.end());
    return result;
}

}  // namespace mir::mpi
