// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/picture_team.hpp"

#include <memory>
#include <utility>

namespace mirtool {

/// A renderer that renders with the others of a team, at the lead.
class TeamRenderer final : public mir::Renderer {
 public:
    /// `team` must outlive it.
    TeamRenderer(mir::PictureTeam& team, std::unique_ptr<mir::Renderer> own)
        : team_(team), own_(std::move(own)) {}
    /// PictureTeam::render().
    mir::RenderResult render(const mir::Scene& scene, const mir::RenderSettings& settings,
                             mir::Monitor* monitor) const override {
        return team_.render(*own_, scene, settings, monitor);
    }

 private:
    mir::PictureTeam& team_;
    std::unique_ptr<mir::Renderer> own_;
};

}  // namespace mirtool
